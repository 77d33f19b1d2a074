#include <pfaff/core/numbers/formatted.hpp>

#include <cstdarg>
#include <cstdio>

namespace pfaff {

ClassicLocale::ClassicLocale() {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  before_ = uselocale(classic);
}

std::string formatted(const char* format, ...) {
  const ClassicLocale locale;
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  std::string text(static_cast<std::size_t>(length < 0 ? 0 : length), '\0');
  if (length > 0) std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  return text;
}

}  // namespace pfaff
