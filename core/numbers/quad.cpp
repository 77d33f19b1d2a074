#include <pfaff/core/numbers/quad.hpp>

#include <array>
#include <cctype>

#include <pfaff/core/numbers/formatted.hpp>

extern "C" {
int quadmath_snprintf(char*, std::size_t, const char*, ...) noexcept;  // NOLINT: libquadmath's own signature
__float128 strtoflt128(const char*, char**) noexcept;
}

namespace pfaff {

bool parse(std::string_view text, Quad& result) {
  if (text.empty() || std::isspace(static_cast<unsigned char>(text.front())) != 0) return false;
  const ClassicLocale locale;
  const std::string buffer(text);
  char* end = nullptr;
  const __float128 value = strtoflt128(buffer.c_str(), &end);
  if (end != buffer.c_str() + buffer.size()) return false;
  result = Quad(value);
  return true;
}

namespace {
std::string with_digits(const char* format, int digits, Quad x) {
  const ClassicLocale locale;
  std::array<char, 128> buffer{};
  quadmath_snprintf(buffer.data(), buffer.size(), format, digits, x.native());
  return buffer.data();
}
}  // namespace

std::string to_string(Quad x, int digits) { return with_digits("%.*Qg", digits, x); }
std::string to_scientific(Quad x, int digits) { return with_digits("%.*Qe", digits - 1, x); }

}  // namespace pfaff
