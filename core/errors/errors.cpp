#include <pfaff/core/errors/errors.hpp>

#include <cxxabi.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <numeric>

#include <pfaff/core/errors/notices.hpp>

namespace pfaff {

namespace {
// How many letters are to be changed, left out, added or exchanged with the next one.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row[b.size()];
}

std::atomic<void (*)(const std::string&)> say_notice{
    [](const std::string& text) { std::cerr << "pfaff: " << text << '\n'; }};
}  // namespace

void notice(const std::string& text) { say_notice.load()(text); }

void say_notices_by(void (*say)(const std::string& text)) { say_notice = say; }

std::string on_one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return line;
}

std::string words_of_current_exception() {
  try {
    throw;
  } catch (const std::exception& error) {
    return on_one_line(error.what());
  } catch (const std::string& text) {
    return on_one_line(text);
  } catch (const char* text) {
    return text == nullptr ? "an exception without words" : on_one_line(text);
  } catch (...) {
    const std::type_info* type = abi::__cxa_current_exception_type();
    if (type == nullptr) return "an exception of another language";
    int status = 0;
    const std::unique_ptr<char, decltype(&std::free)> name(
        abi::__cxa_demangle(type->name(), nullptr, nullptr, &status), &std::free);
    return std::string("an exception of type ") + (status == 0 ? name.get() : type->name());
  }
}

namespace {
// The length of the longest text that stands in both.
std::size_t shared_length(std::string_view a, std::string_view b) {
  std::size_t longest = 0;
  std::vector<std::size_t> ending(b.size() + 1);
  for (const char one : a)
    for (std::size_t j = b.size(); j-- > 0;) {
      ending[j + 1] = one == b[j] ? ending[j] + 1 : 0;
      longest = std::max(longest, ending[j + 1]);
    }
  return longest;
}

// The three candidates that share the longest text with the name, those that are a part of it first.
std::vector<std::string> most_alike(std::string_view name, std::vector<std::string> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
    const auto likeness = [&](const std::string& candidate) {
      return std::pair(name.find(candidate) != std::string_view::npos, shared_length(name, candidate));
    };
    return likeness(a) > likeness(b);
  });
  candidates.resize(3);
  return candidates;
}
}  // namespace

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  // A third of the name may be wrong, of short ones one letter: 'h' is not near 'nu', and '--scheme' not near
  // '--help'.
  const std::string_view bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::size_t distance = std::max<std::size_t>(1, bare.size() / 3);
  for (const std::string& candidate : candidates) {
    // A name typed short is near to what it begins.
    const bool prefix = bare.size() >= 3 && candidate.starts_with(name);
    const std::size_t d = prefix ? 1 : edit_distance(name, candidate);
    if (d <= distance && (best.empty() || d < distance)) {
      best = candidate;
      distance = d;
    }
  }
  return best;
}

std::string unknown_name(std::string_view kind, std::string_view name,
                         const std::vector<std::string>& candidates) {
  std::string text = "unknown " + std::string(kind) + " '" + std::string(name) + "'";
  if (const std::string near = nearest(name, candidates); !near.empty())
    return text + "; did you mean '" + near + "'?";
  if (candidates.empty()) return text + "; there is none to choose from";
  constexpr std::size_t most_listed = 16;
  const bool few = candidates.size() <= most_listed;
  text +=
      few ? "; expected one of: " : "; expected one of " + std::to_string(candidates.size()) + ", such as ";
  const std::vector<std::string> named = few ? candidates : most_alike(name, candidates);
  for (std::size_t k = 0; k < named.size(); ++k) text += (k == 0 ? "" : ", ") + named[k];
  return text;
}

}  // namespace pfaff
