// How the rows of Nguyen & Turski are made, part by part.
#pragma once

#include <pfaff/papers/exact.hpp>
#include <pfaff/papers/rows.hpp>

namespace pfaff::nguyen_turski {

// Section "brackets": sections 1 to 3.
void reduction_rows(Rows& rows);    // (1.1), (1.2), section 2
void determinant_rows(Rows& rows);  // (3.2)-(3.7), (3.18), (3.19)
void recursion_rows(Rows& rows);    // (3.8)-(3.17), Theorems 1 and 2, Example 3.1, break-downs
void jacobi_rows(Rows& rows);       // (3.20), (3.21), Propositions 2 and 6

// Section "formulations": section 4 and the appendices.
void motion_rows(Rows& rows);       // (4.1), (4.2), (4.7), appendix A
void table_rows(Rows& rows);        // (4.3)-(4.6), tables 1 and 2, appendix B, other numbers of section 4
void tridiagonal_rows(Rows& rows);  // (4.6), appendix C
void figure_2_rows(Rows& rows);
void symbolic_rows(Rows& rows);  // brackets, growth and cost of equations derived symbolically

}  // namespace pfaff::nguyen_turski
