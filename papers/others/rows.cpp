#include <pfaff/papers/others/rows.hpp>

namespace pfaff {

std::vector<ReproducedRow> reproduce_others() {
  Rows solutions("solutions"), methods("methods"), books("books");
  others::solution_rows(solutions);
  others::method_rows(methods);
  others::book_rows(books);
  std::vector<ReproducedRow> all;
  for (Rows* rows : {&solutions, &methods, &books}) {
    const std::vector<ReproducedRow> more = rows->take();
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace pfaff
