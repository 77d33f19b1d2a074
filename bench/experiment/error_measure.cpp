#include <pfaff/bench/experiment/error_measure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/runs/support/term_magnitudes.hpp>

namespace pfaff {

namespace {
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
// A quantity that is so small beside its terms is zero but for what they round off, and errors relative to it
// say nothing: of 1e-16 of the terms they would make 1e-8.
constexpr double least_part = 1e-8;

// A number of summary.json, which has those of runs in quad as text.
double number_in(const nlohmann::json& value) {
  if (value.is_number()) return value.get<double>();
  const auto number = value.is_string() ? Real::parse(value.get<std::string>()) : std::nullopt;
  return number ? number->value() : not_known;
}
}  // namespace

double error_of(const ExperimentCase& one, const nlohmann::json& summary) {
  if (one.error.empty() && summary["error_max"].is_number()) return summary["error_max"].get<double>();
  // A drift takes the place of an error where none was asked for, not where the reference solution ended.
  if (one.error.empty() && summary.contains("reference")) return not_known;
  const std::string& name = one.error.empty() ? one.conserved : one.error;
  for (const nlohmann::json& invariant : summary["invariants"]) {
    if (invariant["name"] != name || !invariant.contains("max") || !invariant["max"].is_number()) continue;
    const double largest = invariant["max"].get<double>();
    return one.error.empty() ? largest : largest / std::abs(number_in(invariant["initial"]));
  }
  return not_known;
}

double error_of(const ExperimentCase& one, const ResolvedRun& run, const RunRecord& record) {
  if (one.error.empty()) return record.error_max.value_or(not_known);
  const std::vector<Invariant>& invariants = run.model->invariants();
  for (std::size_t k = 0; k < invariants.size() && record.sample_count > 0; ++k)
    if (invariants[k].name == one.error)
      return record.invariants().drift[k].maximum / std::abs(static_cast<double>(record.first_invariants[k]));
  return not_known;
}

std::string error_refused(const ExperimentCase& one, const ResolvedRun& run) {
  if (one.error.empty()) return {};
  const std::vector<Invariant>& invariants = run.model->invariants();
  const auto found = std::find_if(invariants.begin(), invariants.end(),
                                  [&](const Invariant& i) { return i.name == one.error; });
  if (found == invariants.end()) {
    std::vector<std::string> names{"solution"};
    for (const Invariant& i : invariants)
      if (i.behaviour == Behaviour::conserved) names.push_back(i.name);
    throw InputError(unknown_name("error", one.error, names));
  }
  if (found->behaviour != Behaviour::conserved)
    return "expected a conserved quantity, and '" + one.error + "' is listed as " +
           std::string(to_string(found->behaviour));
  const auto which = static_cast<std::size_t>(found - invariants.begin());
  const std::shared_ptr<const Tape> tape = run.model->tape(Formula::invariants);
  std::vector<double> z, values(invariants.size());
  for (const Real& x : run.initial) z.push_back(x.value());
  Replay<double> replay(tape);
  replay(run.t0.value(), z.data(), values.data());
  TermMagnitudes magnitudes(tape);
  magnitudes.add(run.t0.value(), std::vector<Pack<8>>(z.begin(), z.end()).data());
  if (std::abs(values[which]) > least_part * magnitudes.largest()[which]) return {};
  return "expected a quantity that is not zero at the start, where errors are relative to it, and '" +
         one.error + "' is";
}

}  // namespace pfaff
