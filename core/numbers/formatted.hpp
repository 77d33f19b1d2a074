// Numbers as text, the same whatever the locale of the process is: a program that Pfaff is a library of, or a
// plug-in, may have set one in which decimals have a comma and thousands a point.
#pragma once

#include <clocale>
#include <locale>
#include <sstream>
#include <string>

namespace pfaff {

/// As long as it lives, this thread reads and writes numbers as the C standard has them.
class ClassicLocale {
 public:
  ClassicLocale();
  ~ClassicLocale() { uselocale(before_); }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  locale_t before_;
};

/// What printf would print in the classic locale.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// A stream that collects text in the classic locale.
class TextStream : public std::ostringstream {
 public:
  TextStream() { imbue(std::locale::classic()); }
};

}  // namespace pfaff
