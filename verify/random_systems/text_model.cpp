// Writes a polynomial system as a text model.
#include <algorithm>

#include <pfaff/verify/random_systems/polynomial_system.hpp>

namespace pfaff {

namespace {

using Names = std::vector<std::string>;

// A formula with one result is an expression, one with several a list, a bracket a list of rows.
enum class Form { expression, list, rows };

// letter1 ... lettern, or the letter alone where there is one.
Names numbered_or_alone(const std::string& letter, std::size_t count) {
  return count == 1 ? Names{letter} : numbered(letter, count);
}

// q1, ..., p1, ... of systems whose variables are positions and momenta, z1, ... of others.
Names coordinates_of(const PolynomialSystem& system) {
  if (!system.canonical && !system.damping) return numbered_or_alone("z", system.dimension);
  Names names = numbered_or_alone("q", system.dimension / 2);
  for (std::string& name : numbered_or_alone("p", system.dimension / 2)) names.push_back(std::move(name));
  return names;
}

// What a formula reads.
Names arguments_of(Formula formula, const PolynomialSystem& system, const Names& coordinates) {
  const auto half = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
  switch (formula) {
    case Formula::kinetic:
      return {half, coordinates.end()};
    case Formula::potential:
    case Formula::holonomic:
    case Formula::velocity_constraints:
      return {coordinates.begin(), half};
    case Formula::chart_inverse: {
      Names chart;
      for (std::size_t k = 1; k <= system.dimension; ++k) chart.push_back("y[" + std::to_string(k) + "]");
      return chart;
    }
    case Formula::alpha: {
      Names both;
      for (const char* value : {"new_", "old_"})
        for (const std::string& name : coordinates) both.push_back(value + name);
      both.emplace_back("t0");
      return both;
    }
    default:
      return coordinates;
  }
}

// A function as a factor of a product.
std::string text_of(Function function, const std::string& x) {
  switch (function) {
    case Function::sine:
      return "sin(" + x + ")";
    case Function::exponential:
      return "exp(" + x + ")";
    case Function::root:
      return "sqrt(1 + " + x + "^2)";
    case Function::bell:
      break;
  }
  return "(1/(1 + " + x + "^2))";
}

// In quotes; what is longer than a line is broken at spaces.
std::string in_quotes(const std::string& expression) {
  constexpr std::size_t most = 100;
  if (expression.size() <= most) return '"' + expression + '"';
  std::string text = "\"\"\"\n    ";
  std::size_t column = 0;
  for (std::size_t begin = 0; begin < expression.size();) {
    std::size_t end = expression.find(' ', begin);
    if (end == std::string::npos) end = expression.size();
    if (column > 0 && column + end - begin > most) {
      text += "\n    ";
      column = 0;
    }
    text += (column > 0 ? " " : "") + expression.substr(begin, end - begin);
    column += end - begin + 1;
    begin = end + 1;
  }
  return text + "\"\"\"";
}

// [a, b, ...], on lines of their own where one would be too long.
std::string listed(const Names& items) {
  std::size_t length = 0;
  for (const std::string& item : items) length += item.size() + 2;
  const bool one_line = length <= 90;
  std::string text = "[";
  for (std::size_t k = 0; k < items.size(); ++k)
    text += (k == 0 ? "" : ",") + std::string(one_line ? (k == 0 ? "" : " ") : "\n  ") + items[k];
  return text + (one_line ? "]" : "\n]");
}

// A number as an item of a list.
std::string number(const Real& value) {
  const std::string text = to_string(value);
  return value.is_fraction() && value.denominator() == 1 ? text : '"' + text + '"';
}

class Writer {
 public:
  explicit Writer(const PolynomialSystem& system) : s_(system), coordinates_(coordinates_of(system)) {}

  [[nodiscard]] std::string text() const {
    Names initial, names;
    for (const Real& x : s_.initial) initial.push_back(number(x));
    for (const std::string& name : coordinates_) names.push_back('"' + name + '"');
    std::string text = "name = \"" + s_.name + "\"\ntitle = \"" + s_.title + "\"\n";
    text += "coordinates = " + listed(names) + "\ninitial = " + listed(initial) + "\n";
    if (s_.damping) text += "damping = \"" + to_string(*s_.damping) + "\"\n";
    for (const auto& [formula, form] : {std::pair{Formula::field, Form::list},
                                        {Formula::kinetic, Form::expression},
                                        {Formula::potential, Form::expression},
                                        {Formula::hamiltonian, Form::expression},
                                        {Formula::birkhoffian, Form::expression},
                                        {Formula::one_form, Form::list},
                                        {Formula::chart, Form::list},
                                        {Formula::chart_inverse, Form::list},
                                        {Formula::poisson_tensor, Form::rows},
                                        {Formula::casimirs, Form::list},
                                        {Formula::symmetric_tensor, Form::rows},
                                        {Formula::entropy, Form::expression},
                                        {Formula::holonomic, Form::list},
                                        {Formula::constraints, Form::list},
                                        {Formula::reversal, Form::list}})
      if (s_.formulas.contains(formula)) text += key_of(formula) + " = " + value(formula, form) + "\n";
    if (s_.formulas.contains(Formula::velocity_constraints)) text += velocity_constraints();
    return text + alpha() + invariants();
  }

 private:
  static std::string key_of(Formula formula) {
    if (formula == Formula::poisson_tensor) return "bracket";
    if (formula == Formula::symmetric_tensor) return "symmetric_bracket";
    return std::string(to_string(formula));
  }

  // The results of a formula in quotes, with the functions that stand in it as variables written out.
  [[nodiscard]] Names results(Formula formula) const {
    Names read = arguments_of(formula, s_, coordinates_);
    if (const auto found = s_.applied.find(formula); found != s_.applied.end())
      for (const AppliedFunction& f : found->second) read.push_back(text_of(f.function, read[f.variable]));
    read.emplace_back("t");
    const auto name = [&](std::size_t k) { return read[k]; };
    const Polynomials& made_of = s_.formulas.at(formula);
    Names texts;
    for (std::size_t k = 0; k < made_of.size(); ++k) {
      std::string text = made_of[k].text(name);
      if (formula == Formula::chart_inverse && !s_.chart_divisors.empty() &&
          s_.chart_divisors[k].degree() > 0)
        text = "(" + text + ")/(" + s_.chart_divisors[k].text(name) + ")";
      texts.push_back(in_quotes(text));
    }
    return texts;
  }

  [[nodiscard]] std::string value(Formula formula, Form form) const {
    const Names texts = results(formula);
    if (form == Form::expression) return texts.front();
    return listed(form == Form::list ? texts : rows(texts, s_.dimension));
  }

  // So many texts after the other as one row.
  static Names rows(const Names& texts, std::size_t columns) {
    Names list;
    for (auto row = texts.begin(); row != texts.end(); row += static_cast<std::ptrdiff_t>(columns))
      list.push_back(listed({row, row + static_cast<std::ptrdiff_t>(columns)}));
    return list;
  }

  [[nodiscard]] std::string velocity_constraints() const {
    Names list;
    for (const std::string& row : rows(results(Formula::velocity_constraints), s_.dimension / 2))
      list.push_back("{ row = " + row + " }");
    return "velocity_constraints = " + listed(list) + "\n";
  }

  // The first half of the results is w_hat.
  [[nodiscard]] std::string alpha() const {
    if (!s_.formulas.contains(Formula::alpha)) return "";
    const Names list = rows(results(Formula::alpha), s_.dimension);
    return "\n[alpha]\nw_hat = " + list[0] + "\nw = " + list[1] + "\n";
  }

  [[nodiscard]] std::string invariants() const {
    if (s_.invariants.empty()) return "";
    const Names texts = results(Formula::invariants);
    std::string text = "\n[invariants]\n";
    for (std::size_t k = 0; k < texts.size(); ++k) {
      const Invariant& i = s_.invariants[k];
      const bool plain = i.behaviour == Behaviour::conserved && !i.quadratic;
      text += i.name + " = " + (plain ? texts[k] : "{ of = " + texts[k]);
      if (i.quadratic) text += ", quadratic = true";
      if (i.behaviour != Behaviour::conserved)
        text += ", behaviour = \"" + std::string(to_string(i.behaviour)) + "\"";
      text += plain ? "\n" : " }\n";
    }
    return text;
  }

  const PolynomialSystem& s_;
  Names coordinates_;
};

}  // namespace

std::string text_model(const PolynomialSystem& system, const std::vector<std::string>& comment) {
  std::string text;
  for (const std::string& line : comment) text += line.empty() ? "#\n" : "# " + line + "\n";
  return text + Writer(system).text();
}

}  // namespace pfaff
