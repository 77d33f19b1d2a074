// The part of an evaluation that is about constraints of velocities: the forces that keep them, the projector
// P of their virtual displacements, and the nonholonomic bracket with its rank, Casimirs and Jacobiator.
#include <pfaff/bench/evaluation/evaluation_parts.hpp>
#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>

namespace pfaff::evaluation_parts {

namespace {

// Up to so many positions: the Jacobiator costs the fourth power of their number.
constexpr std::size_t most_positions = 40;

// The largest component of Pibar grad H - (rate of the state), both on the constraints.
template <class T>
json flow_difference(const Point<T>& at, const NonholonomicBracket& bracket, const Matrix<T>& tensor) {
  if (!at.model->moves() || at.model->forced())
    return nullptr;  // the bracket's field is that of an energy alone
  Point<T> there{at.model, at.t, bracket.projected(at.t, at.z), true, true, {}};
  const std::vector<T> flow = tensor * there.values(at.model->tape(Formula::hamiltonian_gradient)),
                       rate = there.values(at.model, Formula::field);
  T worst(0);
  for (std::size_t k = 0; k < rate.size(); ++k) {
    const T difference = abs(flow[k] - rate[k]);
    if (!(difference <= worst)) worst = difference;
  }
  return number(worst);
}

template <class T>
json bracket_of(const Point<T>& at, const NonholonomicBracket& bracket) {
  const Model& model = *at.model;
  const NonholonomicPoint<T> point = nonholonomic_point(model, at.t, at.z);
  json names = json::array();
  for (const std::size_t k : point.jacobiator.coordinates) names.push_back(model.coordinates()[k].name);
  return {{"P", rows(point.admissible.matrix())},
          {"bracket", rows(point.tensor)},
          {"rank", point.rank},
          {"casimirs", model.constraint_names()},
          {"casimir_residual", number(point.casimirs)},
          {"one_form_residual", number(point.one_forms)},
          {"jacobiator", {{"value", number(point.jacobiator.value)}, {"of", names}}},
          {"flow_difference", flow_difference(at, bracket, point.tensor)}};
}

}  // namespace

template <class T>
void add_nonholonomic_bracket(Point<T>& at, json& j) {
  const Model& model = *at.model;
  j["nonholonomic"] = nullptr;
  if (!at.finite || !at.regular || model.dimension() > static_cast<int>(2 * most_positions)) return;
  std::unique_ptr<const NonholonomicBracket> bracket;
  try {
    bracket = std::make_unique<const NonholonomicBracket>(model);
  } catch (const InputError&) {
    return;  // an H that is not quadratic in p: there is a motion, and no metric to project with
  }
  try {
    j["nonholonomic"] = bracket_of(at, *bracket);
  } catch (const InputError& error) {  // constraints that depend on each other here, by name
    at.regular = false;
    at.reason = error.what();
  }
}

template void add_nonholonomic_bracket(Point<double>&, json&);
template void add_nonholonomic_bracket(Point<Quad>&, json&);

}  // namespace pfaff::evaluation_parts
