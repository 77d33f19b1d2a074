#include <pfaff/python/src/words.hpp>

#include <string_view>

namespace pfaff::python {

namespace {
bool small_letter(char c) { return c >= 'a' && c <= 'z'; }

// Whether an option begins there: not inside of a word, such as the name of a file.
bool option_at(const std::string& text, std::size_t k) {
  constexpr std::string_view before = " ('";
  return text.compare(k, 2, "--") == 0 && k + 2 < text.size() && small_letter(text[k + 2]) &&
         (k == 0 || before.find(text[k - 1]) != std::string_view::npos);
}
}  // namespace

std::string in_words_of_python(const std::string& message) {
  std::string text = message;
  // The state file of the program has the initial time, and runs of Python have no bound of their steps.
  constexpr std::string_view time = "initial time: ", bound = " (--max-steps)";
  if (text.starts_with(time)) text.replace(0, time.size(), "t0: ");
  if (const auto found = text.find(bound); found != std::string::npos) text.erase(found, bound.size());
  std::string words;
  for (std::size_t k = 0; k < text.size();) {
    if (!option_at(text, k)) {
      words += text[k++];
      continue;
    }
    k += 2;
    if (text.compare(k, 4, "set ") == 0) {
      k += 4;
      continue;
    }
    for (; k < text.size() && (small_letter(text[k]) || text[k] == '-'); ++k)
      words += text[k] == '-' ? '_' : text[k];
  }
  return words;
}

}  // namespace pfaff::python
