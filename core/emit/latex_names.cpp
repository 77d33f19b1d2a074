#include <pfaff/core/emit/latex_names.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace pfaff::emit {

namespace {
constexpr std::array<std::string_view, 35> greek{
    "alpha",   "beta",   "gamma", "delta",   "epsilon", "zeta",  "eta",   "theta", "iota",
    "kappa",   "lambda", "mu",    "nu",      "xi",      "pi",    "rho",   "sigma", "tau",
    "upsilon", "phi",    "chi",   "psi",     "omega",   "Gamma", "Delta", "Theta", "Lambda",
    "Xi",      "Pi",     "Sigma", "Upsilon", "Phi",     "Psi",   "Omega", "varphi"};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// The words of a name: runs of letters and runs of digits.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  char before = ' ';
  for (const char c : name) {
    const bool goes_on = (is_letter(c) && is_letter(before)) || (is_digit(c) && is_digit(before));
    if ((is_letter(c) || is_digit(c)) && !goes_on) words.emplace_back();
    if (is_letter(c) || is_digit(c)) words.back() += c;
    before = c;
  }
  return words;
}

std::string written(const std::string& word, const std::string& font) {
  if (word.size() == 1 || is_digit(word.front())) return word;
  if (std::find(greek.begin(), greek.end(), word) != greek.end()) return "\\" + word;
  return font + "{" + word + "}";
}
}  // namespace

LatexName LatexNames::operator()(std::string_view wanted) {
  std::vector<std::string> words = words_of(wanted);
  if (words.empty() || is_digit(words.front().front())) words.insert(words.begin(), "x");
  LatexName name{written(words.front(), "\\mathit"), ""};
  for (std::size_t k = 1; k < words.size(); ++k)
    name.subscript += (k == 1 ? "" : ",") + written(words[k], "\\mathrm");
  const std::string subscript = name.subscript;
  for (int k = 2; taken_.count(name.text()) > 0; ++k)
    name.subscript = (subscript.empty() ? "" : subscript + ",") + "(" + std::to_string(k) + ")";
  taken_.insert(name.text());
  return name;
}

std::string latex_words(std::string_view text) {
  std::string words;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '^' && k + 1 < text.size()) {
      std::size_t end = k + 1;
      if (text[end] == '-') ++end;
      while (end < text.size() && is_digit(text[end])) ++end;
      words += "$^{" + std::string(text.substr(k + 1, end - k - 1)) + "}$";
      k = end - 1;
    } else if (std::string_view("_&%#${}").find(c) != std::string_view::npos) {
      words += std::string("\\") + c;
    } else if (is_letter(c) || is_digit(c) ||
               std::string_view(" -.,:;()[]/+=*'").find(c) != std::string_view::npos) {
      words += c;
    } else {
      words += ' ';
    }
  }
  return words;
}

}  // namespace pfaff::emit
