// Fields in Darboux charts, and the charts themselves where the structure depends on time alone.
#pragma once

#include <pfaff/core/linear/symplectic_basis.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// J v for the canonical bracket on (q, p): (v_p, -v_q).
void canonical_sharp(std::span<const Recorded> covector, std::span<Recorded> vector);

/// The field in the chart with the inverse z = zeta(y, t), from the action form F.dz - B dt.
Tape pulled_back_field(const Tape& one_form, const Tape& birkhoffian, const Tape& inverse);
/// The same from K zdot + D = 0.
Tape pulled_back_equations(const Tape& structure, const Tape& covector, const Tape& inverse);

/// The chart y = E^-1 z, z = E y of a structure K(t), which is K_c = E^T K E in y.
Tape linear_chart(const Tape& structure, const PivotPairs& pairs);
Tape linear_chart_inverse(const Tape& structure, const PivotPairs& pairs);

}  // namespace pfaff
