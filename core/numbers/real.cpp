#include <pfaff/core/numbers/real.hpp>

#include <charconv>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace pfaff {

namespace {
__extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using)

Wide greatest_common_divisor(Wide a, Wide b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) {
    const Wide r = a % b;
    a = b;
    b = r;
  }
  return a;
}

// A decimal text as digits * 10^exponent, where the digits fit in 64 bits.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
};

std::optional<Decimal> as_decimal(std::string_view text) {
  Decimal d;
  bool negative = false;
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) negative = text[i++] == '-';
  bool point = false;
  int count = 0;
  for (; i < text.size() && ((text[i] >= '0' && text[i] <= '9') || text[i] == '.'); ++i) {
    if (text[i] == '.') {
      if (point) return std::nullopt;
      point = true;
      continue;
    }
    if (d.digits > (std::numeric_limits<std::int64_t>::max() - 9) / 10) return std::nullopt;
    d.digits = d.digits * 10 + (text[i] - '0');
    ++count;
    if (point) --d.exponent;
  }
  if (count == 0) return std::nullopt;
  if (i < text.size()) {
    if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
    ++i;
    if (i < text.size() && text[i] == '+') ++i;
    if (i < text.size() && text[i] == '-' && text[i - 1] == '+') return std::nullopt;
    int e = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), e);
    if (error != std::errc() || end != text.data() + text.size() || e > 100000 || e < -100000)
      return std::nullopt;
    d.exponent += e;
  }
  if (negative) d.digits = -d.digits;
  return d;
}
}  // namespace

// The sum, difference, product or quotient of two Reals: the fraction when it fits, else its quad value.
Real Real::fold(const Real& a, const Real& b, Quad value, Wide numerator, Wide denominator) {
  constexpr Wide limit = std::numeric_limits<std::int64_t>::max() / 2;  // sums of products stay in 128 bits
  if (a.is_fraction() && b.is_fraction() && denominator != 0) {
    const Wide g = greatest_common_divisor(numerator, denominator);
    if (g != 0) {
      numerator /= g;
      denominator /= g;
    }
    if (denominator < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    if (numerator <= limit && numerator >= -limit && denominator <= limit)
      return Real::fraction(static_cast<std::int64_t>(numerator), static_cast<std::int64_t>(denominator));
  }
  return Real(value);
}

Real Real::fraction(std::int64_t numerator, std::int64_t denominator) {
  Real r;
  const std::int64_t g = std::gcd(numerator, denominator);
  if (g > 1) {
    numerator /= g;
    denominator /= g;
  }
  r.numerator_ = numerator;
  r.denominator_ = denominator;
  r.quad_ = Quad(static_cast<long>(numerator)) / Quad(static_cast<long>(denominator));
  r.rounded_ = static_cast<double>(r.quad_);
  return r;
}

std::optional<Real> Real::parse(std::string_view text) {
  if (const auto slash = text.find('/'); slash != std::string_view::npos) {
    if (text.find('/', slash + 1) != std::string_view::npos) return std::nullopt;
    const auto a = parse(text.substr(0, slash));
    const auto b = parse(text.substr(slash + 1));
    if (!a || !b || b->is(0)) return std::nullopt;
    return *a / *b;
  }
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return std::nullopt;
  Real result{Quad(0)};
  if (const auto decimal = as_decimal(text); decimal && decimal->exponent <= 18 && decimal->exponent >= -18) {
    std::int64_t power = 1;
    for (int k = 0; k < std::abs(decimal->exponent); ++k) power *= 10;
    const Wide numerator = decimal->exponent > 0 ? static_cast<Wide>(decimal->digits) * power
                                                 : static_cast<Wide>(decimal->digits);
    result = Real::fold(Real(0), Real(0), Quad(0), numerator, decimal->exponent < 0 ? power : 1);
  }
  if (!result.is_fraction()) {  // whose quad is not at hand
    Quad value;
    if (!pfaff::parse(text, value) || !isfinite(value)) return std::nullopt;
    result = Real(value);
  }
  // The double nearest to the text itself, not to its quad rounding.
  double nearest = 0;
  const std::string_view digits = text.front() == '+' ? text.substr(1) : text;
  if (std::from_chars(digits.data(), digits.data() + digits.size(), nearest).ec == std::errc())
    result.rounded_ = nearest;
  return result;
}

Real operator-(const Real& a) {
  Real r = a;
  r.rounded_ = -r.rounded_;
  r.quad_ = -r.quad_;
  r.numerator_ = -r.numerator_;
  return r;
}
Real operator+(const Real& a, const Real& b) {
  const Wide an = a.numerator_, ad = a.denominator_, bn = b.numerator_, bd = b.denominator_;
  return Real::fold(a, b, a.quad_ + b.quad_, an * bd + bn * ad, ad * bd);
}
Real operator-(const Real& a, const Real& b) { return a + (-b); }
Real operator*(const Real& a, const Real& b) {
  const Wide an = a.numerator_, ad = a.denominator_, bn = b.numerator_, bd = b.denominator_;
  return Real::fold(a, b, a.quad_ * b.quad_, an * bn, ad * bd);
}
Real operator/(const Real& a, const Real& b) {
  const Wide an = a.numerator_, ad = a.denominator_, bn = b.numerator_, bd = b.denominator_;
  return Real::fold(a, b, a.quad_ / b.quad_, an * bd, ad * bn);
}

namespace {
// A function value is a fraction only where it is a small integer exactly (sin 0, cos 0, exp 0, sqrt 4).
Real of_function(Quad value) {
  const auto approximate = static_cast<double>(value);
  if (approximate > -1e6 && approximate < 1e6)
    if (const int whole = static_cast<int>(approximate); value == Quad(whole)) return Real(whole);
  return Real(value);
}
}  // namespace

Real sqrt(const Real& x) { return of_function(sqrt(x.quad())); }
Real exp(const Real& x) { return of_function(exp(x.quad())); }
Real log(const Real& x) { return of_function(log(x.quad())); }
Real sin(const Real& x) { return of_function(sin(x.quad())); }
Real cos(const Real& x) { return of_function(cos(x.quad())); }
Real pow(const Real& x, const Real& y) { return of_function(pow(x.quad(), y.quad())); }

namespace {
// A decimal as a person writes it: 10, 0.3, -1250000, 0.0005; a power of ten only where more than six zeros
// would be filled in behind the digits or more than three in front of them: 1e9, 2.5e-6. `scientific` has the
// form -d.ddde-dd.
std::string plainly(const std::string& scientific) {
  const std::string sign = scientific.front() == '-' ? "-" : "";
  const std::size_t e = scientific.find('e');
  std::string digits;
  for (const char c : scientific.substr(0, e))
    if (c >= '0' && c <= '9') digits += c;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.empty()) return sign + "0";
  int exponent = 0;
  const std::size_t first = e + (scientific[e + 1] == '+' ? 2 : 1);
  std::from_chars(scientific.data() + first, scientific.data() + scientific.size(), exponent);
  const int count = static_cast<int>(digits.size()), behind = exponent + 1 - count, before = -exponent - 1;
  if (behind > 6 || before > 3)
    return sign + digits.substr(0, 1) + (count > 1 ? "." + digits.substr(1) : "") + "e" +
           std::to_string(exponent);
  if (before >= 0) return sign + "0." + std::string(static_cast<std::size_t>(before), '0') + digits;
  if (behind >= 0) return sign + digits + std::string(static_cast<std::size_t>(behind), '0');
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  return sign + digits.substr(0, whole) + "." + digits.substr(whole);
}

// The shortest decimal of at least `from` and at most `to` digits that is the constant; empty when none is.
std::string shortest_decimal(const Real& x, int from, int to) {
  for (int digits = from; digits <= to; ++digits) {
    std::string text = to_scientific(x.quad(), digits);
    Quad back;
    if (parse(text, back) && back == x.quad()) return plainly(text);
  }
  return {};
}
}  // namespace

std::string to_string(const Real& x) {
  if (!isfinite(x.quad())) return to_string(x.quad());
  if (std::string text = shortest_decimal(x, 1, 17); !text.empty()) return text;
  if (x.is_fraction()) return std::to_string(x.numerator()) + "/" + std::to_string(x.denominator());
  return shortest_decimal(x, 18, 36);
}

inline namespace literals {
Real operator""_r(const char* text) { return *Real::parse(text); }
}  // namespace literals

}  // namespace pfaff

template class std::vector<pfaff::Real>;
