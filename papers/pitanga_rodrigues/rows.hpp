// How the rows of Pitanga & Rodrigues are made, section by section.
#pragma once

#include <pfaff/papers/exact.hpp>
#include <pfaff/papers/rows.hpp>

namespace pfaff::pitanga_rodrigues {

void riemannian_rows(Rows& rows);   // section 2, exact in rationals
void foliation_rows(Rows& rows);    // section 3.1, exact in rationals
void transverse_rows(Rows& rows);   // section 3.2, exact in rationals
void principle_rows(Rows& rows);    // section 4.1, (18)-(26)
void sleigh_rows(Rows& rows);       // section 4.1, (27)-(35)
void contact_rows(Rows& rows);      // section 4.2, up to (38)
void phase_space_rows(Rows& rows);  // section 4.2, (39)-(41)

}  // namespace pfaff::pitanga_rodrigues
