#include <pfaff/papers/pitanga_rodrigues/rows.hpp>

std::vector<pfaff::PartOfPaper> pfaff::pitanga_rodrigues_parts() {
  using namespace pitanga_rodrigues;
  return {{"projectors", riemannian_rows}, {"transverse", foliation_rows}, {"transverse", transverse_rows},
          {"sleigh", principle_rows},      {"sleigh", sleigh_rows},        {"contact", contact_rows},
          {"contact", phase_space_rows}};
}
