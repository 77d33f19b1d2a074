#include <pfaff/runs/integrate.hpp>

#include <type_traits>

#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/state_checks.hpp>

namespace pfaff {

template <class T>
Integration<T> begun(Start<T> start) {
  Integration<T> run(std::move(start));
  const std::vector<T> state(run.state().begin(), run.state().end());
  if (run.model()->restricted()) {
    std::vector<Quad> z(state.begin(), state.end());
    if (const Consistency found = consistency_of(*run.model(), Quad(run.time()), z); !found.on_constraints())
      throw InputError(found.where + "; expected a state on the constraints");
  }
  check_domain(run.model(), run.time(), state);
  if (std::is_same_v<T, Quad> && run.method().descriptor().double_coefficients)
    throw InputError(run.method().called() +
                     " has coefficients in double only; expected an integration in double");
  return run;
}
template Integration<double> begun(Start<double>);
template Integration<Quad> begun(Start<Quad>);

template <class T>
Integration<T> integrate(const std::string& system, const Assignments& system_parameters,
                         const std::string& method, const Assignments& method_parameters,
                         const AskedIntegration& asked) {
  const SystemPlugin& plugin = system_asked_for(system);
  const FormulationPlugin* const formulation = formulation_for(plugin, asked.formulation);
  Start<T> start;
  start.model = plugin.make(system_parameters);
  start.method = integrator_asked_for(method).make(method_parameters);
  if (formulation != nullptr && !start.method->refuses(*start.model).empty()) {
    start.model = formulation->apply(start.model, {});
  } else if (!asked.formulation.empty()) {
    throw InputError(start.method->called() + " steps on the constraints of " + plugin.name() +
                     " themselves; expected no formulation");
  }
  if (asked.initial.empty())
    for (const Real& x : start.model->initial()) start.state.push_back(T(x));
  for (const std::string& text : asked.initial) start.state.push_back(T(finite_number(text, "initial")));
  start.h = T(finite_number(asked.step, "step"));
  start.t0 = T(finite_number(asked.t0, "initial time"));
  if (!asked.tolerance.empty()) {
    start.tolerance = T(finite_number(asked.tolerance, "tolerance"));
    check_tolerances(*start.method, *start.model, Quad(start.tolerance), {});  // where it is 0, too
  }
  for (const std::string& text : asked.absolute)
    start.absolute.push_back(T(finite_number(text, "absolute tolerance")));
  start.block_rows = asked.block_rows;
  return begun(std::move(start));
}

template Integration<double> integrate(const std::string&, const Assignments&, const std::string&,
                                       const Assignments&, const AskedIntegration&);
template Integration<Quad> integrate(const std::string&, const Assignments&, const std::string&,
                                     const Assignments&, const AskedIntegration&);

}  // namespace pfaff
