// Measures where their answers are known, and faults that they have to see (MeasureControl).
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/measuring.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {

namespace {
// The number in the last row of a column. InputError where there is none, which says why.
double last_number(const MeasuredTable& table, const std::string& column) {
  if (!table.ended.empty()) throw InputError("its table ends early: " + table.ended);
  if (table.lines.empty()) throw InputError("its table has no rows");
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const Cell& cell = table.lines.back().cells[k];
    if (table.columns[k].name != column || std::holds_alternative<std::string>(cell)) continue;
    const auto* quad = std::get_if<Quad>(&cell);
    const double number = quad != nullptr ? static_cast<double>(*quad) : std::get<double>(cell);
    if (!std::isfinite(number))
      throw InputError("the last number of its column '" + column + "' is not finite");
    return number;
  }
  throw InputError("its table has no column of numbers '" + column + "'");
}

// A check that fails without a number.
Check not_measured(Check check, std::string reason) {
  check.measured = std::numeric_limits<double>::quiet_NaN();
  check.result = CheckResult::fail;
  check.reason = std::move(reason);
  return check;
}

// The number that a control asks for, in the precision T.
template <class T>
double number_of(const MeasureInstance& measure, const MeasureControl& control) {
  if (!std::isfinite(control.expected) || !(control.allowed >= 0) || !std::isfinite(control.allowed) ||
      control.steps < 1)
    throw InputError("it states no number with an error that is allowed, after a step or more");
  const auto run =
      integrate<T>(control.system, control.system_parameters, control.method, control.method_parameters,
                   {.step = control.step, .initial = control.initial});
  if (const std::string reason = measure.refuses(*run.model(), run.method()); !reason.empty())
    throw InputError(reason);
  return last_number(measured(run, control.steps, {&measure}).front(), control.column);
}

// `number`: what is found, for whoever compares the controls with each other.
template <class T>
Check judged(const MeasurePlugin& plugin, const MeasureControl& control, double& number) {
  const auto made = plugin.make(control.settings);
  const MeasureInstance& measure = *made;
  Check check;
  check.plugin = measure.descriptor().name;
  check.parameters = measure.parameters();
  check.claim = "measure";
  check.scope = control.column + " by " + control.method + ", " + std::to_string(control.steps) +
                " steps of " + control.step;
  check.system = control.system;
  check.precision = std::is_same_v<T, Quad> ? "quad" : "double";
  check.tolerance = control.allowed;  // of how far the number is from the one that is stated
  check.control = control.fault;
  const std::string run_of = check.scope + ": ";
  try {
    number = number_of<T>(measure, control);
  } catch (const InputError& error) {
    return not_measured(std::move(check), run_of + error.what());
  }
  check.measured = std::abs(number - control.expected);
  const bool as_stated = check.measured <= control.allowed;
  check.result = control.fault ? as_stated ? CheckResult::fail : CheckResult::rejected
                 : as_stated   ? CheckResult::pass
                               : CheckResult::fail;
  if (check.result == CheckResult::fail)
    check.reason = run_of + "it gives " + formatted("%.10g", number) +
                   (control.fault ? " as if the method kept it" : ", expected ") +
                   (control.fault ? "" : formatted("%.10g", control.expected));
  return check;
}

// Whether two controls ask for the same number.
bool same(const MeasureControl& a, const MeasureControl& b) {
  const auto parts = [](const MeasureControl& c) {
    return std::tie(c.system, c.system_parameters, c.method, c.method_parameters, c.settings, c.initial,
                    c.step, c.steps, c.column);
  };
  return parts(a) == parts(b);
}

// What is wrong with the controls together: answers that say the same, or numbers that are one whatever is
// measured, as those of a measure that looks at nothing; empty where nothing is.
std::string objection(const std::vector<MeasureControl>& controls, const std::vector<double>& numbers) {
  int answers = 0, faults = 0;
  for (auto one = controls.begin(); one != controls.end(); ++one) {
    const auto is_before = [&](const MeasureControl& other) { return !other.fault && same(other, *one); };
    if (one->fault) {
      ++faults;
    } else if (std::none_of(controls.begin(), one, is_before)) {
      ++answers;
    }
  }
  if (answers < 2 || faults < 1)
    return "controls() states " + std::to_string(answers) + " different answers and " +
           std::to_string(faults) + " faults; expected two answers at least and a fault";
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  for (const MeasureControl& control : controls)
    if (!(*high - *low > control.allowed))
      return "all of its numbers are within " + formatted("%.3g", control.allowed) +
             ", which is allowed of " + control.column + " by " + control.method +
             "; expected runs of which the measure says different things";
  return {};
}
}  // namespace

std::vector<Check> check_measure(const MeasurePlugin& plugin) {
  std::vector<Check> checks;
  const std::vector<MeasureControl> controls = plugin.controls();
  std::vector<double> numbers;
  for (const MeasureControl& control : controls) {
    double number = std::numeric_limits<double>::quiet_NaN();
    checks.push_back(judged<double>(plugin, control, number));
    if (std::isfinite(number)) numbers.push_back(number);
    if (good(checks.back()) && !control.fault) checks.push_back(judged<Quad>(plugin, control, number));
  }
  Check stated;
  stated.plugin = plugin.name();
  stated.claim = "measure";
  stated.scope = "two answers and a fault stated";
  stated.result = CheckResult::pass;
  if (std::string reason = objection(controls, numbers); !reason.empty())
    stated = not_measured(std::move(stated), std::move(reason));
  checks.push_back(stated);
  return checks;
}

}  // namespace pfaff
