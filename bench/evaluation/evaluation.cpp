#include <pfaff/bench/evaluation/evaluation.hpp>

#include <pfaff/bench/evaluation/evaluation_parts.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using namespace evaluation_parts;
using MapArguments = std::span<const Recorded>;
using MapResults = std::span<Recorded>;

// The energy: H, or T + V where friction is linear and there is no H; null where there is neither.
std::shared_ptr<const Tape> energy_of(const Model& model) {
  if (model.has_energy()) return model.tape(Formula::hamiltonian);
  if (!model.facets().has(Facet::conformal)) return nullptr;
  const auto kinetic = model.tape(Formula::kinetic), potential = model.tape(Formula::potential);
  const auto half = static_cast<std::size_t>(model.dimension() / 2);
  return std::make_shared<const Tape>(
      record(model.dimension(), 1, [&](const Recorded& t, MapArguments z, MapResults out) {
        out[0] = evaluate(*kinetic, t, z.subspan(half))[0] + evaluate(*potential, t, z.first(half))[0];
      }));
}

// The time derivative of a function of (z, t) where the state moves at `rate`.
template <class T>
T rate_of(const Point<T>& at, const Tape& function, const std::vector<T>& rate) {
  const auto slopes = at.values(std::make_shared<const Tape>(
      record(function.inputs, function.inputs + 1, [&](const Recorded& t, MapArguments z, MapResults out) {
        const std::vector<Recorded> one{Recorded(1)}, slope = gradient(function, t, z, one);
        std::copy(slope.begin(), slope.end(), out.begin());
        out[slope.size()] = time_derivative(function, t, z)[0];
      })));
  T sum = slopes.back();
  for (std::size_t k = 0; k < rate.size(); ++k) sum = sum + slopes[k] * rate[k];
  return sum;
}

template <class T>
void evaluate_in(const EvaluationSettings& settings, json& j) {
  Point<T> at{settings.at.model, T(settings.at.t), numbers<T>(settings.at.state), true, true, {}};
  const Model& model = *at.model;
  j["t"] = number(at.t);
  j["state"] = list(at.z);
  if (model.facets().has(Facet::structure)) {
    std::optional<std::vector<Real>> centre = settings.centre;
    if (!centre && !model.facets().has(Facet::birkhoffian))
      centre = model.initial().size() == at.z.size() ? model.initial() : settings.at.state;
    add_birkhoffian(at, centre, j);
  }
  if (model.restricted()) add_constraints(at, j);
  if (model.nonholonomic()) add_nonholonomic_bracket(at, j);
  if (at.regular && !model.moves()) {
    at.regular = false;
    at.reason =
        "system " + model.name() + " offers no vector field; expected a formulation of its constraints";
  }
  const bool moves = at.regular && at.finite;
  std::vector<T> rate;
  if (at.regular) rate = at.seen(at.values(at.model, Formula::field));
  j["rhs"] = at.regular ? list(rate) : json(nullptr);
  if (model.restricted() && moves && at.finite) {
    add_constrained_motion(at, rate, j);
    add_dirac_bracket(at, j);
  }
  j["energy"] = j["energy_rate"] = nullptr;
  if (const auto energy = energy_of(model)) {
    j["energy"] = number(at.seen(at.values(energy)).front());
    if (at.regular) j["energy_rate"] = number(at.seen({rate_of(at, *energy, rate)}).front());
  }
  j["status"] = to_string(!at.finite    ? Status::non_finite
                          : !at.regular ? Status::singular
                                        : Status::converged);
  if (!at.reason.empty()) j["reason"] = at.reason;
}
}  // namespace

nlohmann::json evaluation(const EvaluationSettings& settings) {
  const Model& model = *settings.at.model;
  if (settings.centre && !model.facets().has(Facet::structure))
    throw InputError("--centre: system " + model.name() +
                     " has no structure K; expected one written with birkhoffian and one_form, or structure "
                     "and covector");
  json j{{"schema", 1},
         {"system", model.name()},
         {"parameters", json::object()},
         {"precision", to_string(settings.precision)},
         {"coordinates", json::array()}};
  for (const auto& [key, value] : model.parameters()) j["parameters"][key] = value;
  if (model.restricted() || !model.source().formulation.empty()) {
    j["formulation"] = model.source().formulation;
    for (const auto& [key, value] : model.source().formulation_parameters)
      j["parameters"]["formulation." + key] = value;
  }
  for (const Coordinate& c : model.coordinates()) j["coordinates"].push_back(c.name);
  if (settings.precision == Precision::quad) {
    evaluate_in<Quad>(settings, j);
  } else {
    evaluate_in<double>(settings, j);
  }
  return j;
}

}  // namespace pfaff
