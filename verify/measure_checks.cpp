// Measures where their answers are known, and faults that they have to see (MeasureControl).
#include <cmath>
#include <limits>
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
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (const auto* number = std::get_if<double>(&table.lines.back().cells[k]);
        table.columns[k].name == column && number != nullptr) {
      if (!std::isfinite(*number))
        throw InputError("the last number of its column '" + column + "' is not finite");
      return *number;
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

Check judged(const MeasurePlugin& plugin, const MeasureControl& control) {
  const auto made = plugin.make(control.settings);
  const MeasureInstance& measure = *made;
  Check check;
  check.plugin = measure.descriptor().name;
  check.parameters = measure.parameters();
  check.claim = "measure";
  check.scope = control.column + " by " + control.method + ", " + std::to_string(control.steps) +
                " steps of " + control.step;
  check.system = control.system;
  check.precision = "double";
  check.tolerance = control.allowed;  // of how far the number is from the one that is stated
  check.control = control.fault;
  const std::string run_of = check.scope + ": ";
  double number = 0;
  try {
    const auto run = integrate(control.system, control.system_parameters, control.method,
                               control.method_parameters, {.step = control.step, .initial = control.initial});
    if (const std::string reason = measure.refuses(*run.model(), run.method()); !reason.empty())
      throw InputError(reason);
    number = last_number(measured(run, control.steps, {&measure}).front(), control.column);
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
}  // namespace

std::vector<Check> check_measure(const MeasurePlugin& plugin) {
  std::vector<Check> checks;
  int answers = 0, faults = 0;
  for (const MeasureControl& control : plugin.controls()) {
    checks.push_back(judged(plugin, control));
    (control.fault ? faults : answers) += 1;
  }
  Check stated;
  stated.plugin = plugin.name();
  stated.claim = "measure";
  stated.scope = "two answers and a fault stated";
  stated.result = CheckResult::pass;
  if (answers < 2 || faults < 1)
    stated = not_measured(std::move(stated), "controls() states " + std::to_string(answers) +
                                                 " answers and " + std::to_string(faults) +
                                                 " faults; expected two answers at least and a fault");
  checks.push_back(stated);
  return checks;
}

}  // namespace pfaff
