// How many degrees beyond m variant S keeps where it is not told.
//
// The nodes of a scheme of order m give degrees beyond m as well. These make the error smaller by a constant
// factor, so that longer steps do, and each psi dearer. From order 12 on the shorter time of the steps no
// longer makes up for that of psi, and at orders 2 and 4 the nodes are too few for the error to fall enough.
// In between stands what costs least at equal error, measured in time and in evaluations of the field on
// three systems (docs/generating-functions.md, section 8).
#pragma once

namespace pfaff {

/// The degrees beyond `order` with which variant S costs least.
constexpr int cheapest_extra_degrees(int order) {
  if (order == 8) return 4;
  return order == 6 || order == 10 ? 2 : 0;
}

}  // namespace pfaff
