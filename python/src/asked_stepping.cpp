#include <pfaff/python/src/asked_stepping.hpp>

#include <pybind11/stl.h>

#include <limits>

#include <pfaff/python/src/interruption.hpp>
#include <pfaff/python/src/stepping.hpp>

namespace py = pybind11;

namespace pfaff::python {

std::vector<Real> numbers_of(const std::vector<std::string>& texts, const std::string& what) {
  std::vector<Real> numbers;
  for (const std::string& text : texts) numbers.push_back(number_of(text, what));
  return numbers;
}

AskedStepping asked_stepping(const PySystem& system, const PyMethod& method, const py::dict& asked) {
  const auto text = [&](const char* key) { return asked[key].cast<std::string>(); };
  const auto texts = [&](const char* key) { return asked[key].cast<std::vector<std::string>>(); };
  AskedStepping start;
  start.method = method.method;
  start.model = without_lock([&, formulation = text("formulation")] {
    return model_for(*method.method, system.model, formulation);
  });
  start.quad = asked["quad"].cast<bool>();
  start.state = numbers_of(texts("initial"), "initial");
  start.h = number_of(text("step"), "step");
  start.t0 = number_of(text("t0"), "t0");
  if (const std::string tolerance = text("tolerance"); !tolerance.empty()) {
    start.tolerance = number_of(tolerance, "tolerance");
    const Quad round_off =
        start.quad ? std::numeric_limits<Quad>::epsilon() : Quad(std::numeric_limits<double>::epsilon());
    if (start.tolerance.quad() > 0 && start.tolerance.quad() < round_off)
      throw InputError("tolerance: " + tolerance + " is below round-off, which is " +
                       to_string(round_off, 3) + "; expected at least that");
    check_tolerances(*start.method, *start.model, start.tolerance.quad(), {},
                     {.got = ", got " + tolerance});  // where it is 0, too
  }
  start.absolute = numbers_of(texts("absolute"), "absolute");
  start.tolerance_forgets = text("scales") == "step";
  return start;
}

template <class T>
Start<T> start_in(const AskedStepping& asked) {
  Start<T> start{asked.model, asked.method, {}, T(asked.h), T(asked.t0), T(asked.tolerance)};
  for (const Real& x : asked.state) start.state.push_back(T(x));
  for (const Real& x : asked.absolute) start.absolute.push_back(T(x));
  start.tolerance_forgets = asked.tolerance_forgets;
  return start;
}

template Start<double> start_in(const AskedStepping&);
template Start<Quad> start_in(const AskedStepping&);

}  // namespace pfaff::python
