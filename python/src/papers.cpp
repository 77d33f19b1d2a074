// Reproductions: what papers print beside what is computed here, as `pfaff reproduce` shows it.
#include <pybind11/stl.h>

#include <pfaff/papers/coverage/coverage.hpp>
#include <pfaff/papers/reproduce.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/json_value.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
py::dict reproduced(const std::string& paper, const std::string& section) {
  return python_value(without_lock([&] {
           const std::vector<PaperItem> items = items_of(paper);
           std::vector<ReproducedRow> rows = reproduce(paper, section);
           put_in_order(rows, items);
           return to_json(paper, rows);
         }))
      .cast<py::dict>();
}
}  // namespace

void bind_papers(py::module_& module) {
  module.def("papers", &papers);
  module.def("reproduce", &reproduced);
}

}  // namespace pfaff::python
