// Whether a motion can begin at a state: in the domain of its formulas, and on its constraints.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff {

/// Refuses a state outside the domain of the formulas, or beyond the range of the scalar T, which would
/// otherwise show as NaN in a run: InputError where the vector field or an invariant is not finite there.
template <class T>
void check_domain(const std::shared_ptr<const Model>& model, const T& t, const std::vector<T>& state);

/// What moving a state onto the constraints of a restricted model takes. A decimal number rounds when it
/// becomes a double; residuals of that size are no inconsistency.
struct Consistency {
  ProjectionOntoConstraints projection;
  std::string where;  // "initial state of NAME: constraint C is off by 0.1"
  [[nodiscard]] bool on_constraints() const {
    return projection.status == Status::converged && projection.change <= 1e-13;
  }
};
/// `state` becomes the one on the constraints. InputError where none is found.
Consistency consistency_of(const Model& model, const Quad& t, std::vector<Quad>& state);

}  // namespace pfaff
