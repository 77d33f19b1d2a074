#include <pfaff/papers/others/rows.hpp>

std::vector<pfaff::PartOfPaper> pfaff::others_parts() {
  return {
      {"solutions", others::solution_rows}, {"methods", others::method_rows}, {"books", others::book_rows}};
}
