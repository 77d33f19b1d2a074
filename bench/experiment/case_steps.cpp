#include <pfaff/bench/experiment/case_steps.hpp>

#include <algorithm>

#include <pfaff/bench/runner/expressions.hpp>
#include <pfaff/core/numbers/real.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
constexpr const char* automatic = "auto";
constexpr double fewest_evaluations = 100, most_evaluations = 1e12;

double evaluations_in(const std::string& text) {
  const auto number = Real::parse(text);
  if (!number || !(number->value() >= fewest_evaluations) || !(number->value() <= most_evaluations))
    throw InputError("expected a number in 100 .. 1e12, got '" + text + "'");
  return number->value();
}
}  // namespace

void read_steps(Keys& keys, ExperimentCase& one) {
  if (const auto text = keys.text_alone("steps")) {
    if (*text != automatic)
      keys.refuse("steps", "expected a list of steps, or \"auto\", got '" + *text + "'");
    one.automatic = true;
    one.steps.clear();
  } else {
    one.steps = keys.some("steps", one.steps);
    if (one.automatic && !one.steps.empty()) {  // a list with --quick in the place of automatic steps
      one.automatic = false;
      one.evaluations.reset();
    }
  }
  if (const std::string text = keys.text("evaluations", ""); !text.empty())
    one.evaluations = keys.read("evaluations", text, evaluations_in);
}

std::string without_sign(const std::string& step) { return step.substr(step.starts_with('-') ? 1 : 0); }

std::string as_decimal(const std::string& number) {
  const auto value = number.find('/') == std::string::npos ? std::nullopt : Real::parse(number);
  return value ? to_string(Real(value->quad())) : number;
}

void evaluate_numbers(ExperimentCase& one, const std::string& where) {
  std::vector<std::pair<std::string*, const char*>> numbers{{&one.time, "time"}};
  for (std::string& step : one.steps) numbers.emplace_back(&step, "steps");
  for (std::string& x : one.initial) numbers.emplace_back(&x, "initial");
  for (std::string& x : one.initial_velocities) numbers.emplace_back(&x, "initial_velocities");
  // Making a system takes time, and most cases have numbers alone.
  if (!std::all_of(numbers.begin(), numbers.end(), [](const auto& n) { return Real::parse(*n.first); })) {
    const SystemPlugin& system = system_asked_for(one.system);
    const Assignments parameters =
        system.make(split_settings(system, nullptr, nullptr, one.set).system)->parameters();
    for (const auto& [text, key] : numbers)
      *text = evaluated(*text, where + ": key '" + key + "'", parameters);
  }
  for (std::string& step : one.steps) step = as_decimal(step);
  if (!one.time.starts_with('-')) return;
  for (std::string& step : one.steps) step = without_sign(step);
}

void check_steps(const ExperimentCase& one, const std::string& where) {
  if (!one.automatic && one.steps.empty()) throw InputError(where + ": key 'steps' is missing");
  if (!one.automatic && one.evaluations)
    throw InputError(where + ": key 'evaluations': expected steps = \"auto\" beside it");
  if (one.automatic && !one.reference && one.error.empty())
    throw InputError(
        where +
        ": steps = \"auto\" chooses by the distance from a solution or by the error of a conserved quantity; "
        "expected a list of steps, error = \"NAME\", or no reference = \"none\"");
}

}  // namespace pfaff
