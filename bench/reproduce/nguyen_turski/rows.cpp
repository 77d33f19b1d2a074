#include <pfaff/bench/reproduce/nguyen_turski/rows.hpp>

namespace pfaff {

std::vector<ReproducedRow> reproduce_nguyen_turski() {
  Rows brackets("brackets");
  nguyen_turski::reduction_rows(brackets);
  nguyen_turski::determinant_rows(brackets);
  nguyen_turski::recursion_rows(brackets);
  nguyen_turski::jacobi_rows(brackets);
  nguyen_turski::one_pair_rows(brackets);
  return brackets.take();
}

}  // namespace pfaff
