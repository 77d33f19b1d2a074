// Integrations: `_pfaff.Integration`.
#include <pybind11/stl.h>

#include <pfaff/python/src/arrays.hpp>
#include <pfaff/python/src/asked_stepping.hpp>
#include <pfaff/python/src/bindings.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/stepping.hpp>
#include <pfaff/runs/support/counter_fields.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
std::unique_ptr<Stepping> stepping_of(const PySystem& system, const PyMethod& method, const py::dict& asked) {
  return make_stepping(asked_stepping(system, method, asked));
}

py::dict counters_of(const Stepping& run) {
  const Counters c = run.counters();
  py::dict counts;
  counts["steps"] = c.steps;
  for (const CounterField& field : counter_fields) counts[py::str(std::string(field.name))] = c.*field.count;
  return counts;
}

py::tuple taken_of(Stepping& run) {
  StepsTaken taken = run.taken();
  const auto rows = static_cast<py::ssize_t>(taken.t.size()),
             n = static_cast<py::ssize_t>(run.model()->dimension());
  return py::make_tuple(taken.reached, taken.status, taken.message, taken.steps,
                        array_owning(std::move(taken.t), {rows}),
                        array_owning(std::move(taken.y), {rows, n}));
}

py::array_t<double> array_of_state(const std::vector<double>& z) {
  return array_of_numbers(z, {static_cast<py::ssize_t>(z.size())});
}
}  // namespace

void bind_integrations(py::module_& module) {
  py::class_<Stepping>(module, "Integration", "A motion, a method, a state and the time it has reached.")
      .def(py::init(&stepping_of))
      .def("steps", &Stepping::steps)
      .def("to",
           [](Stepping& r, const std::string& t, std::int64_t every) { r.to(number_of(t, "t"), every); })
      .def_property("allowed", &Stepping::allowed, &Stepping::allow)
      .def("taken", &taken_of)
      .def_property_readonly("time", &Stepping::time)
      .def_property_readonly("step", &Stepping::step)
      .def_property_readonly("steps_taken", &Stepping::steps_taken)
      .def_property_readonly("state", [](const Stepping& r) { return array_of_state(r.state()); })
      .def_property_readonly("texts", &Stepping::state_as_texts)
      .def_property_readonly("counters", &counters_of)
      .def_property_readonly("model", [](const Stepping& r) { return PySystem{r.model()}; })
      .def("beside", [](const Stepping& r,
                        const std::vector<std::string>& z) { return r.beside(numbers_of(z, "state")); })
      .def("reversed", &Stepping::reversed)
      .def("turn", &Stepping::turn)
      .def("forget", &Stepping::forget)
      .def("go_on_from",
           [](Stepping& r, const std::vector<std::string>& z, const std::string& t0, const std::string& h) {
             const auto given = [](const std::string& text, const char* what) {
               return text.empty() ? std::nullopt : std::optional(number_of(text, what));
             };
             r.go_on_from(numbers_of(z, "state"), given(t0, "t0"), given(h, "step"));
           })
      .def("watch", [](Stepping& r, py::object callback,
                       std::int64_t every) { return r.watch(SharedObject(std::move(callback)), every); })
      .def("unwatch", &Stepping::unwatch)
      .def("jacobian", [](const Stepping& r, std::int64_t count) {
        const auto [end, rows] = r.jacobian(count);
        const auto n = static_cast<py::ssize_t>(end.size());
        return py::make_tuple(array_of_numbers(end, {n}), array_of_numbers(rows, {n, n}));
      });
}

}  // namespace pfaff::python
