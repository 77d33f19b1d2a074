#include <pfaff/papers/nguyen_turski/rows.hpp>

namespace pfaff {

std::vector<ReproducedRow> reproduce_nguyen_turski() {
  Rows brackets("brackets");
  nguyen_turski::reduction_rows(brackets);
  nguyen_turski::determinant_rows(brackets);
  nguyen_turski::recursion_rows(brackets);
  nguyen_turski::jacobi_rows(brackets);
  Rows formulations("formulations");
  nguyen_turski::motion_rows(formulations);
  nguyen_turski::table_rows(formulations);
  nguyen_turski::tridiagonal_rows(formulations);
  nguyen_turski::figure_2_rows(formulations);
  nguyen_turski::symbolic_rows(formulations);
  std::vector<ReproducedRow> rows = brackets.take(), more = formulations.take();
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace pfaff
