#include <pfaff/runs/state_checks.hpp>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff {

template <class T>
void check_domain(const std::shared_ptr<const Model>& model, const T& t, const std::vector<T>& state) {
  const Problem<T> problem(model);
  std::vector<T> rate(state.size()), values(model->invariants().size());
  const auto expect_finite = [&](const T& x, const std::string& what) {
    if (!isfinite(x))
      throw InputError("initial state of " + model->name() + ": " + what + " is not finite there");
  };
  if (model->moves()) {
    problem.field(t, state, rate);
    for (const T& x : rate) expect_finite(x, "the vector field");
  }
  if (values.empty()) return;
  problem.invariants(t, state, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    expect_finite(values[i], "the invariant " + model->invariants()[i].name);
}
template void check_domain(const std::shared_ptr<const Model>&, const double&, const std::vector<double>&);
template void check_domain(const std::shared_ptr<const Model>&, const Quad&, const std::vector<Quad>&);

Consistency consistency_of(const Model& model, const Quad& t, std::vector<Quad>& state) {
  Consistency found{project_onto_constraints(model, t, state), {}};
  const ProjectionOntoConstraints& projection = found.projection;
  found.where = "initial state of " + model.name() + ": constraint " + projection.worst + " is off by " +
                formatted("%.2g", projection.worst_residual);
  if (projection.status != Status::converged)
    throw InputError(found.where + " and the state cannot be moved onto the constraints (" +
                     std::string(to_string(projection.status)) + ")");
  return found;
}

}  // namespace pfaff
