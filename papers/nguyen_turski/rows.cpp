#include <pfaff/papers/nguyen_turski/rows.hpp>

std::vector<pfaff::PartOfPaper> pfaff::nguyen_turski_parts() {
  using namespace nguyen_turski;
  return {
      {"brackets", reduction_rows},       {"brackets", determinant_rows},  {"brackets", recursion_rows},
      {"brackets", jacobi_rows},          {"formulations", motion_rows},   {"formulations", table_rows},
      {"formulations", tridiagonal_rows}, {"formulations", figure_2_rows}, {"formulations", symbolic_rows}};
}
