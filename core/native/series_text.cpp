#include <pfaff/core/native/series_text.hpp>

#include <pfaff/core/emit/language.hpp>
#include <pfaff/core/tape/online_series.hpp>
#include <pfaff/core/tape/operands.hpp>

namespace pfaff::native {

namespace {
constexpr std::size_t longest_tape = 300;
// Products of coefficients that are written without loops, which the compiler's time grows with.
constexpr std::size_t most_products = 2000;

// Numbers side by side, before the text of the recurrences: P is one double or a vector of them.
constexpr const char* numbers = R"(
#define INLINE __attribute__((always_inline)) static inline
template <int n> struct Level { constexpr operator int() const { return n; } };
typedef double pack1;
typedef double pack2 __attribute__((vector_size(16)));
typedef double pack4 __attribute__((vector_size(32), aligned(16)));
template <class F> INLINE double each(double a, F f) { return f(a); }
template <class P, class F> INLINE P each(const P& a, F f) {
  P r;
  for (unsigned lane = 0; lane < sizeof(P) / sizeof(double); ++lane) r[lane] = f(a[lane]);
  return r;
}
INLINE double combined(const double* columns, const double& x) { return columns[0] * x; }
template <class P> INLINE P combined(const P* columns, const P& x) {
  P next = columns[0] * x[0];
  for (unsigned lane = 1; lane < sizeof(P) / sizeof(double); ++lane) next = next + columns[lane] * x[lane];
  return next;
}
INLINE double total(double x) { return x; }
template <class P> INLINE double total(const P& x) {
  double sum = x[0];
  for (unsigned lane = 1; lane < sizeof(P) / sizeof(double); ++lane) sum += x[lane];
  return sum;
}
INLINE bool nothing(double x) { return x == 0.0; }
template <class P> INLINE bool nothing(const P& x) {
  bool all = true;
  for (unsigned lane = 0; lane < sizeof(P) / sizeof(double); ++lane) all = all && x[lane] == 0.0;
  return all;
}
)";

// One coefficient of each operation from the coefficients of its operands below and at level l. L is an int,
// or a Level, with which the loops have known lengths.
constexpr const char* operations = R"(
using namespace pfaff::recurrences;
INLINE double number_power(double x, double e) {
  const int n = e > -17.0 && e < 17.0 ? static_cast<int>(2.0 * e) : 0;
  return n % 2 != 0 && n == 2.0 * e ? half_power(x, n) : pow(x, e);
}
template <class P, class L> INLINE P constant(double c, L l) { return P{} + (l == 0 ? c : 0.0); }
template <class P, class L> INLINE P shifted(double c, const P* a, L l) { return l == 0 ? c + a[0] : a[l]; }
template <class P, class L> INLINE P reflected(double c, const P* a, L l) { return l == 0 ? c - a[0] : -a[l]; }
template <class P, class L> INLINE P root(const P* a, const P* r, L l) {
  return l == 0 ? each(a[0], [](double x) { return sqrt(x); }) : square_root(a, r, l);
}
template <class P, class F, class L> INLINE P special(const P* a, const P* slope, F f, L l) {
  return l == 0 ? each(a[0], f) : from_slope(a, slope, l, l);
}
template <class P, class L> INLINE P exponential(const P* a, const P* r, L l) {
  return special(a, r, [](double x) { return exp(x); }, l);
}
template <class P, class L> INLINE P log_of(const P* a, const P* r, L l) {
  return l == 0 ? each(a[0], [](double x) { return log(x); }) : logarithm(a, r, l);
}
template <class P, class L> INLINE P power_of(const P* a, double e, const P* r, L l) {
  return l == 0 ? each(a[0], [e](double x) { return number_power(x, e); }) : power(a, e, r, l);
}
template <class P, class L> INLINE void circle(const P* a, P* s, P* c, L l) {
  if (l == 0) {
    s[0] = each(a[0], [](double x) { return sin(x); });
    c[0] = each(a[0], [](double x) { return cos(x); });
  } else {
    sine_cosine(a, s, c, l, l);
  }
}
)";

std::string capacity_times(int slot) { return std::to_string(slot * series_capacity); }

class SeriesWriter {
 public:
  explicit SeriesWriter(const Tape& tape)
      : tape_(tape), slot_(tape.code.size(), -1), next_(tape.inputs + 1) {}

  SeriesText write() {
    SeriesText result;
    std::vector<char> is_result(tape_.code.size(), 0);
    for (const int slot : tape_.outputs) is_result[at(slot)] = 1;
    std::string timed, state;
    for (std::size_t k = 0; k < tape_.code.size(); ++k) {
      const bool of_time = k < at(tape_.state_begin);
      if (!place(k, is_result[k] != 0)) return {};
      const std::string line = statement(k);
      (of_time && tape_.code[k].operation != Operation::constant ? timed : state) += line;
    }
    for (const int slot : tape_.outputs) result.outputs.push_back(slot_[at(slot)]);
    result.slots = next_;
    result.timed = !timed.empty();
    result.text = std::string(numbers) + recurrences_text() + operations;
    result.text += "template <class P, class L> INLINE void timed(P* s, L l) {\n" + timed + "}\n";
    result.text += "template <class P, class L> INLINE void level(P* s, L l) {\n" + state + "}\n";
    result.text += advance(result.outputs);
    for (const int lanes : {1, 2, 4}) result.text += functions(lanes);
    return result;
  }

 private:
  static std::size_t at(int slot) { return static_cast<std::size_t>(slot); }
  [[nodiscard]] bool is_constant(int slot) const {
    return tape_.code[at(slot)].operation == Operation::constant;
  }
  [[nodiscard]] std::string value(int constant) const {
    return "(" + emit::double_text(tape_.constants[at(constant)]) + ")";
  }
  [[nodiscard]] std::string value_of(int slot) const { return value(tape_.code[at(slot)].a); }
  [[nodiscard]] std::string series(int slot) const { return "s + " + capacity_times(slot_[at(slot)]); }
  [[nodiscard]] std::string coefficient(int slot) const {
    return is_constant(slot) ? "constant<P>(" + value_of(slot) + ", l)"
                             : "s[" + capacity_times(slot_[at(slot)]) + " + l]";
  }

  // Gives instruction k its slot; false where series of the tape are not written.
  bool place(std::size_t k, bool is_result) {
    const Instruction& i = tape_.code[k];
    switch (i.operation) {
      case Operation::input:
        slot_[k] = i.a;
        return true;
      case Operation::time:
        slot_[k] = tape_.inputs;
        return true;
      case Operation::constant:
        if (const double x = tape_.constants[at(i.a)].value(); x - x != 0) return false;
        if (is_result) slot_[k] = next_++;
        return true;
      case Operation::solve:
      case Operation::solve_next:
        return false;
      default:
        break;
    }
    bool constant = true;
    operands(i, tape_.solves, [&](int slot) { constant = constant && is_constant(slot); });
    slot_[k] = next_++;
    return !constant;
  }

  [[nodiscard]] std::string statement(std::size_t k) const {
    const Instruction& i = tape_.code[k];
    if (slot_[k] < 0) return {};
    const auto result = static_cast<int>(k);
    switch (i.operation) {
      case Operation::input:
      case Operation::time:
      case Operation::cosine:
        return {};
      case Operation::sine:
        return "  circle(" + series(i.a) + ", " + series(result) + ", s + " + capacity_times(slot_[k] + 1) +
               ", l);\n";
      case Operation::constant:
        return "  s[" + capacity_times(slot_[k]) + " + l] = constant<P>(" + value(i.a) + ", l);\n";
      default:
        return "  " + coefficient(result) + " = " + expression(i, result) + ";\n";
    }
  }

  [[nodiscard]] std::string expression(const Instruction& i, int result) const {
    const std::string of_result = ", " + series(result) + ", l)";
    switch (i.operation) {
      case Operation::negate:
        return "-" + coefficient(i.a);
      case Operation::add:
        if (is_constant(i.a)) return "shifted(" + value_of(i.a) + ", " + series(i.b) + ", l)";
        if (is_constant(i.b)) return "shifted(" + value_of(i.b) + ", " + series(i.a) + ", l)";
        return coefficient(i.a) + " + " + coefficient(i.b);
      case Operation::subtract:
        if (is_constant(i.a)) return "reflected(" + value_of(i.a) + ", " + series(i.b) + ", l)";
        if (is_constant(i.b)) return "shifted(-" + value_of(i.b) + ", " + series(i.a) + ", l)";
        return coefficient(i.a) + " - " + coefficient(i.b);
      case Operation::multiply:
        if (is_constant(i.a)) return value_of(i.a) + " * " + coefficient(i.b);
        if (is_constant(i.b)) return value_of(i.b) + " * " + coefficient(i.a);
        if (i.a == i.b) return "square(" + series(i.a) + ", l)";
        return "product(" + series(i.a) + ", " + series(i.b) + ", l)";
      case Operation::divide:
        if (is_constant(i.b)) return coefficient(i.a) + " / " + value_of(i.b);
        return "quotient<P>(" + coefficient(i.a) + ", " + series(i.b) + of_result;
      case Operation::square_root:
        return "root(" + series(i.a) + of_result;
      case Operation::exponential:
        return "exponential(" + series(i.a) + of_result;
      case Operation::logarithm:
        return "log_of(" + series(i.a) + of_result;
      case Operation::power:
        return "power_of(" + series(i.a) + ", " + value(i.b) + of_result;
      case Operation::special:
        return "special(" + series(i.a) + ", " + series(i.b) + ", [](double x) { return " +
               std::string(emit::usual_name(i)) + "(x); }, l)";
      default:  // select
        return "s[" + capacity_times(slot_[at(i.a)]) + "] > 0.0 ? " + coefficient(i.b) + " : " +
               coefficient(i.c);
    }
  }

  // One level of the field, its part of the sums and the next level of the inputs.
  [[nodiscard]] std::string advance(const std::vector<int>& outputs) const {
    std::string text =
        "template <class P, class L>\nINLINE void advance(P* s, const P* columns, P weight, bool symmetric, "
        "L l, "
        "bool last, P* sum) {\n  level(s, l);\n  columns += l * (sizeof(P) / sizeof(double));\n  "
        "P x;\n";
    for (std::size_t k = 0; k < outputs.size(); ++k)
      text += "  x = s[" + capacity_times(outputs[k]) + " + l];\n  if (!symmetric || l % 2 == 0) sum[" +
              std::to_string(k) + "] = sum[" + std::to_string(k) + "] + weight * x;\n  if (!last) s[" +
              capacity_times(static_cast<int>(k)) + " + l + 1] = combined(columns, x);\n";
    return text + "}\n";
  }

  [[nodiscard]] std::string functions(int lanes) const {
    const std::string w = std::to_string(lanes), pack = "pack" + w, n = std::to_string(tape_.inputs);
    std::string text = "extern \"C\" void pfaff_level_" + w + "(" + pack + "* s, int l) { level(s, l); }\n";
    text += "extern \"C\" void pfaff_time_" + w + "(" + pack +
            "* s, int levels) {\n  for (int l = 0; l < levels; ++l) timed(s, l);\n}\n";
    const auto levels = static_cast<std::size_t>(known_levels(lanes));
    if (tape_.code.size() * levels * levels / 2 > most_products) return text;
    text += "extern \"C\" void pfaff_collocate_" + w + "(" + pack + "* s, const " + pack +
            "* columns, const " + pack +
            "* weight, bool symmetric, int levels, const double* w, double* result) {\n  " + pack + " sum[" +
            n + "];\n";
    text += "  for (int k = 0; k < " + n + "; ++k) {\n    s[k * " + std::to_string(series_capacity) +
            "] = " + pack + "{} + w[k];\n    sum[k] = " + pack + "{};\n  }\n";
    text += "  do {\n";
    for (int l = 0; l < known_levels(lanes); ++l) {
      const std::string last = "levels == " + std::to_string(l + 1);
      text += "    advance(s, columns, *weight, symmetric, Level<" + std::to_string(l) + ">(), " + last +
              ", sum);\n    if (" + last + ") break;\n";
    }
    return text + "  } while (false);\n  for (int k = 0; k < " + n + "; ++k) result[k] = total(sum[k]);\n}\n";
  }

  const Tape& tape_;
  std::vector<int> slot_;  // of every instruction; -1 for constants, which stand in the expressions
  int next_;
};
}  // namespace

SeriesText series_text(const Tape& tape) {
  return tape.code.size() > longest_tape ? SeriesText{} : SeriesWriter(tape).write();
}

}  // namespace pfaff::native
