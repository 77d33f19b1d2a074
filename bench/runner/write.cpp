// The content of summary.json.
#include <boost/version.hpp>

#include <pfaff/bench/runner/record.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/counter_fields.hpp>
#include <pfaff/runs/support/links.hpp>
#include <pfaff/runs/support/plane.hpp>
#include <pfaff/runs/support/setback.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

namespace {
nlohmann::json optional(const std::optional<double>& x) {
  return x ? nlohmann::json(*x) : nlohmann::json(nullptr);
}
// The fields of a quantity, null where a number is not known.
void add_fields(const WatchedQuantity& quantity, nlohmann::json& entry) {
  const auto put = [](nlohmann::json& place, const auto& value) {
    if constexpr (!std::is_same_v<decltype(value), const std::monostate&>) place = value;
  };
  for (const QuantityField& field : quantity_fields())
    if (field.is_of(quantity.residual))
      std::visit([&](const auto& value) { put(entry[field.name], value); }, field.value(quantity));
}
// What the constraints join, for pictures: an end is the number of a point, or the coordinates of a place.
nlohmann::json links_in(const ResolvedRun& run) {
  std::vector<double> state;
  for (const Real& x : run.initial) state.push_back(x.value());
  nlohmann::json links = nlohmann::json::array();
  for (const Link& link : links_of(*run.model, run.t0.value(), state))
    links.push_back({link.from, link.to ? nlohmann::json(*link.to) : nlohmann::json(link.place)});
  return links;
}
std::string setback_key(const SetbackWords& words) { return "largest_" + std::string(words.move); }
}  // namespace

std::optional<SetbackInSummary> setback_in(const nlohmann::json& invariant) {
  for (const Behaviour behaviour : {Behaviour::decreasing, Behaviour::increasing})
    if (const auto words = setback_words(behaviour); invariant.contains(setback_key(*words)))
      return SetbackInSummary{std::string(words->move), std::string(words->expected),
                              invariant[setback_key(*words)]};
  return std::nullopt;
}

nlohmann::json versions() {
  return {{"pfaff", PFAFF_VERSION_TEXT},
          {"compiler", std::string("gcc ") + __VERSION__},
          {"standard", __cplusplus},
          {"flags", PFAFF_BUILD_FLAGS},
          {"boost", BOOST_LIB_VERSION}};
}

nlohmann::json summary(const ResolvedRun& run, const RunRecord& record) {
  nlohmann::json j;
  j["schema"] = schema_of_runs;
  j["system"] = run.model->name();
  j["integrator"] = run.settings.integrator;
  j["family"] = run.method->family();
  if (!run.settings.of_case.empty()) j["case"] = run.settings.of_case;
  if (!run.settings.of_method.empty()) j["method"] = run.settings.of_method;
  for (const auto& [key, value] : run.model->parameters()) j["parameters"]["system." + key] = value;
  for (const auto& [key, value] : run.method->parameters()) j["parameters"]["integrator." + key] = value;
  if (!run.settings.formulation.empty()) {
    j["formulation"] = run.settings.formulation;
    for (const auto& [key, value] : run.model->source().formulation_parameters)
      j["parameters"]["formulation." + key] = value;
  }
  if (run.settings.project_initial) j["projected_initial"] = run.projected;
  if (const auto& names = run.model->source().redundant_constraints; !names.empty())
    j["redundant_constraints"] = names;
  j["precision"] = to_string(run.settings.precision);
  j["time"] = to_string(run.time);
  if (run.adaptive()) {
    j["tolerance"] = to_string(run.tolerance);
    for (const Real& x : run.absolute) j["absolute"].push_back(to_string(x));
  } else {
    j["step"] = to_string(run.step);
    j["steps"] = run.steps;
    if (const std::string other = other_duration(run); !other.empty()) j["duration"] = other;
  }
  if (!run.not_conserved.empty()) j["not_conserved"] = run.not_conserved;
  j["completed"] = record.completed;
  j["status"] = record.interrupted ? "interrupted" : to_string(record.status);
  j["message"] = record.message;
  j["series"] = "series.csv";
  j["invariants"] = nlohmann::json::array();
  for (std::size_t i = 0; i < run.model->invariants().size(); ++i) {
    const Invariant& invariant = run.model->invariants()[i];
    nlohmann::json entry{
        {"name", invariant.name}, {"unit", invariant.unit}, {"expected", to_string(run.expected(invariant))}};
    if (record.sample_count > 0) {
      const Quad& initial = record.first_invariants[i];
      if (run.settings.precision == Precision::quad) {
        entry["initial"] = to_string(initial, 36);
      } else {
        entry["initial"] = static_cast<double>(initial);
      }
    }
    if (invariant.behaviour == Behaviour::conserved) {
      add_fields({.drift = record.invariants().drift[i], .round_off = record.invariants().round_off[i]},
                 entry);
    } else if (const auto words = setback_words(run.expected(invariant))) {
      entry[setback_key(*words)] = record.invariants().setback[i];
    }
    j["invariants"].push_back(entry);
  }
  if (const auto names = constraint_residual_names(*run.model); !names.empty()) {
    j["constraints"] = nlohmann::json::array();
    for (std::size_t i = 0; i < names.size(); ++i) {
      nlohmann::json entry{{"name", names[i]}};
      add_fields({.drift = record.constraints().drift[i],
                  .growth = record.constraints().growth[i],
                  .residual = true},
                 entry);
      j["constraints"].push_back(std::move(entry));
    }
  }
  if (nlohmann::json links = links_in(run); !links.empty()) j["links"] = std::move(links);
  if (const auto plane = plane_of(*run.model)) {
    const std::vector<Coordinate>& all = run.model->coordinates();
    j["plane"] = {all[plane->first].name, all[plane->second].name};
  }
  if (!record.reference.empty()) j["reference"] = record.reference;
  if (!record.reference_ended.empty()) j["reference_ended"] = record.reference_ended;
  if (record.error_max && record.error_rows < record.reached_rows)
    j["error_rows"] = {{"measured", record.error_rows}, {"of", record.reached_rows}};
  j["error_max"] = optional(record.error_max);
  j["error_final"] = optional(record.error_final);
  j["structure_residual"] = optional(record.structure_residual);
  if (record.structure_failures > 0) j["structure_failures"] = record.structure_failures;
  j["counts"]["steps"] = record.counters.steps;
  for (const CounterField& field : counter_fields) j["counts"][field.name] = record.counters.*field.count;
  j["versions"] = versions();
  return j;
}

}  // namespace pfaff
