#include <pfaff/bench/runner/evaluation.hpp>

#include <cmath>
#include <memory>

#include <pfaff/brackets/birkhoffian/birkhoffian_form.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
using nlohmann::json;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

json number(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }
json number(const Quad& x) { return isfinite(x) ? json(to_string(x)) : json(nullptr); }
template <class T>
json list(const std::vector<T>& values) {
  json j = json::array();
  for (const T& x : values) j.push_back(number(x));
  return j;
}
template <class T>
json rows(const Matrix<T>& matrix) {
  json j = json::array();
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    j.push_back(json::array());
    for (std::size_t k = 0; k < matrix.columns(); ++k) j.back().push_back(number(matrix(i, k)));
  }
  return j;
}
// The residual relative to the terms; 0 where all are.
template <class T>
json relative(const Residual<T>& r) {
  return number(r.scale == T(0) ? r.residual : T(r.residual / r.scale));
}

// H, or T + V where friction is linear; null without either.
std::shared_ptr<const Tape> energy_of(const Model& model) {
  if (model.facets().has(Facet::hamiltonian)) return model.tape(Formula::hamiltonian);
  if (!model.facets().has(Facet::conformal)) return nullptr;
  const auto kinetic = model.tape(Formula::kinetic), potential = model.tape(Formula::potential);
  const auto half = static_cast<std::size_t>(model.dimension() / 2);
  return std::make_shared<const Tape>(
      record(model.dimension(), 1, [&](const Recorded& t, Arguments z, Results out) {
        out[0] = evaluate(*kinetic, t, z.subspan(half))[0] + evaluate(*potential, t, z.first(half))[0];
      }));
}

template <class T>
std::vector<T> numbers(const std::vector<Real>& values) {
  std::vector<T> result;
  for (const Real& x : values) result.push_back(T(x));
  return result;
}

template <class T>
void evaluate_in(const EvaluationSettings& settings, json& j) {
  const Model& model = *settings.at.model;
  const T t(settings.at.t);
  const std::vector<T> z = numbers<T>(settings.at.state);
  const auto values = [&](const std::shared_ptr<const Tape>& tape) {
    std::vector<T> out(tape->outputs.size());
    Replay<T> replay(tape);
    replay(t, z.data(), out.data());
    return out;
  };
  bool finite = true, regular = true;
  const auto seen = [&](const std::vector<T>& x) {
    for (const T& value : x) finite = finite && isfinite(value);
    return x;
  };
  j["t"] = number(t);
  j["state"] = list(z);
  if (model.facets().has(Facet::structure)) {
    std::optional<std::vector<Real>> centre = settings.centre;
    if (!centre && !model.facets().has(Facet::birkhoffian))
      centre = model.initial().size() == z.size() ? model.initial() : settings.at.state;
    const BirkhoffianForm<T> form = birkhoffian_form<T>(model, centre, t, z);
    regular = form.degeneracy.regular;
    j["K"] = rows(form.structure);
    j["F_t"] = list(seen(form.one_form_rate));
    j["D"] = list(seen(form.covector));
    j["F"] = list(seen(form.one_form));
    j["B"] = number(seen({form.birkhoffian}).front());
    j["regular"] = regular;
    j["condition"] = number(form.degeneracy.condition);
    j["kernel"] = json::array();
    for (const auto& direction : form.degeneracy.kernel) j["kernel"].push_back(list(direction));
    j["class"] = to_string(birkhoffian_class(model));
    j["self_adjoint"] = {{"skew", relative(form.self_adjoint.skew)},
                         {"closed", relative(form.self_adjoint.closed)},
                         {"time", relative(form.self_adjoint.time)}};
    j["centre"] = centre ? list(numbers<T>(*centre)) : json(nullptr);
    seen(form.structure.entries());
  }
  const auto field = model.tape(Formula::field);
  j["rhs"] = regular ? list(seen(values(field))) : json(nullptr);
  j["energy"] = j["energy_rate"] = nullptr;
  if (const auto energy = energy_of(model)) {
    j["energy"] = number(seen(values(energy)).front());
    const auto rate = std::make_shared<const Tape>(
        record(model.dimension(), 1, [&](const Recorded& s, Arguments x, Results out) {
          const auto velocity = evaluate(*field, s, x);
          out[0] = directional_derivative(*energy, s, Recorded(1), x, velocity)[0];
        }));
    if (regular) j["energy_rate"] = number(seen(values(rate)).front());
  }
  j["status"] = to_string(!finite ? Status::non_finite : regular ? Status::converged : Status::singular);
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
  for (const Coordinate& c : model.coordinates()) j["coordinates"].push_back(c.name);
  if (settings.precision == Precision::quad) {
    evaluate_in<Quad>(settings, j);
  } else {
    evaluate_in<double>(settings, j);
  }
  return j;
}

}  // namespace pfaff
