#include <pfaff/python/src/called_method.hpp>

#include <map>

#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/python/src/objects.hpp>
#include <pfaff/python/src/offered_formulas.hpp>
#include <pfaff/python/src/scalars.hpp>

namespace py = pybind11;

namespace pfaff::python {

namespace {
// The formulas of a problem, for Python; empty once the stepper is gone.
template <class P>
struct Formulas {
  const P* problem = nullptr;
  std::map<Formula, Evaluator<Scalar<P>>> parts;  // of formulas that the problem has no members for
  py::array operator()(const std::string& name, const py::object& time, const py::object& arguments);
};

// Evaluates the formula of a row by the problem's member of its name, which counts it; false where there is
// none, as of formulas that are parts of facets.
template <class P, class T>
bool evaluated(const P& p, Formula formula, const T& t, In<T> x, Out<T> out) {
  switch (formula) {
#define PFAFF_DERIVED(name, ...)                                                   \
  case Formula::name:                                                              \
    if constexpr (requires { p.name(t, x, out); }) return p.name(t, x, out), true; \
    break;
#define PFAFF_BRACKET(name, ...) PFAFF_DERIVED(name)
#define PFAFF_FORMULA(name, result, ...)                 \
  case Formula::name:                                    \
    if constexpr (requires {                             \
                    { p.name(t, x) } -> std::same_as<T>; \
                  })                                     \
      return out[0] = p.name(t, x), true;                \
    else if constexpr (requires { p.name(t, x, out); })  \
      return p.name(t, x, out), true;                    \
    break;
#include <pfaff/core/facets/formula_rows.hpp>
    default:
      break;
  }
  return false;
}

template <class P>
py::array Formulas<P>::operator()(const std::string& name, const py::object& time,
                                  const py::object& arguments) {
  using T = Scalar<P>;
  if (problem == nullptr)
    throw InputError("problem: its integration has ended; expected that it is not kept");
  const Model& model = *problem->model();
  if (name == "damping") {
    const T rate(model.damping());
    return array_of(std::span<const T>(&rate, 1));
  }
  const FormulaRow& row = offered_formula(model, name);
  const auto tape = model.tape(row.formula);
  std::vector<T> x(static_cast<std::size_t>(tape->inputs)), out(tape->outputs.size());
  write_numbers(arguments, std::span<T>(x), name.c_str());
  const T t = scalar_from<T>(time, ("time of " + name).c_str());
  if (!evaluated(*problem, row.formula, t, In<T>(x), Out<T>(out))) {
    Evaluator<T>& own = parts[row.formula];
    if (own.call == nullptr) own = make_evaluator<T>(problem->model(), row.formula);
    own.call(own.context, t, x.data(), out.data());
  }
  return array_of(std::span<const T>(out));
}

// The method as the loop over steps sees it.
struct CalledStep {
  SharedObject function;
  std::string name;

  template <class P>
  struct Work {
    std::shared_ptr<Formulas<P>> formulas = std::make_shared<Formulas<P>>();
    SharedObject evaluate, memory, model;
    Continuation<P> continuation;

    Work(const CalledStep& /*method*/, const P& p) : continuation(p) {
      formulas->problem = &p;
      const py::gil_scoped_acquire lock;
      evaluate =
          SharedObject(py::cpp_function([f = formulas](const std::string& name, const py::object& t,
                                                       const py::object& x) { return (*f)(name, t, x); }));
      memory = SharedObject(py::dict());
      model = SharedObject(py::cast(PySystem{p.model()}));
    }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    ~Work() { formulas->problem = nullptr; }
  };

  template <class P>
  Status step(const P& /*p*/, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const bool goes_on = w.continuation.holds(t, h, z);
    Status status = Status::converged;
    with_lock([&] {
      if (!goes_on) w.memory.get().attr("clear")();
      try {
        const py::object made =
            function.get()(w.evaluate.get(), w.model.get(), t, h,
                           array_of(std::span<const T>(z.data(), z.size())), w.memory.get());
        std::vector<T> next(z.size());
        write_numbers(made, std::span<T>(next),
                      ("state that the step of method " + name + " returned").c_str());
        std::copy(next.begin(), next.end(), z.begin());
      } catch (py::error_already_set& error) {
        const py::module_ errors = py::module_::import("pfaff._errors");
        if (error.matches(errors.attr("NotConverged"))) {
          status = Status::not_converged;
          return;
        }
        // Not an error of the function, which may be meant for floats alone: what asks for more goes without
        // it.
        if (error.matches(errors.attr("TraceError")))
          throw RunError("method " + name + ": " + py::str(error.value()).cast<std::string>());
        throw;
      } catch (const InputError& error) {
        const py::object kind = py::module_::import("pfaff._errors").attr("InputError");
        PyErr_SetString(kind.ptr(), error.what());
        throw py::error_already_set();
      }
    });
    if (status == Status::converged)
      w.continuation.remember(t + h, h, z);
    else
      w.continuation.forget();
    return status;
  }
};
}  // namespace

template <class T>
StepperPointer<T> CalledMethod::made(std::shared_ptr<const Model> model) const {
  return std::make_unique<detail::SteppingOn<CalledStep, Problem<T>>>(CalledStep{step_, descriptor_.name},
                                                                      std::move(model));
}

template StepperPointer<double> CalledMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<Quad> CalledMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<StepDual<double>> CalledMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<StepDual<Quad>> CalledMethod::made(std::shared_ptr<const Model>) const;

}  // namespace pfaff::python
