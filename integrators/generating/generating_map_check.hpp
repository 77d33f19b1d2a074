// What a model's alpha must satisfy before a scheme may be built on it, checked near the initial state.
#pragma once

#include <string>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The result of check_generating_map.
struct GeneratingMapCheck {
  bool holds = false;      // (34) with factor 1, and C + D regular for equal states and times
  double residual = 0;     // of (34), over the size of its terms
  bool symmetric = false;  // exchanging (z', t) and (z, t0) changes the sign of w^ and leaves w
  std::string message;     // one line on what fails; empty where nothing does
};

/// Evaluates su-qin (34), the regularity of C + D that (37) asks of the identity, and the symmetry of the
/// model's alpha in quad precision at pairs of states around the initial one, a tenth apart or less.
GeneratingMapCheck check_generating_map(const Model& model);

}  // namespace pfaff
