#include <pfaff/papers/pitanga_rodrigues/rows.hpp>

namespace pfaff {

std::vector<ReproducedRow> reproduce_pitanga_rodrigues() {
  using namespace pitanga_rodrigues;
  Rows projectors("projectors"), transverse("transverse"), sleigh("sleigh"), contact("contact");
  riemannian_rows(projectors);
  foliation_rows(transverse);
  transverse_rows(transverse);
  principle_rows(sleigh);
  sleigh_rows(sleigh);
  contact_rows(contact);
  phase_space_rows(contact);
  std::vector<ReproducedRow> all;
  for (Rows* rows : {&projectors, &transverse, &sleigh, &contact}) {
    const std::vector<ReproducedRow> more = rows->take();
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace pfaff
