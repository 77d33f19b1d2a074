// integrate: an Integration in one line, by the names of its system and its method.
#pragma once

#include <string>
#include <vector>

#include <pfaff/runs/integration.hpp>

namespace pfaff {

/// The integration that begins so. InputError for what Integration refuses, for a state off the constraints,
/// for one at which the vector field or an invariant is not finite, and for a method that has coefficients in
/// double where the integration is in quad.
template <class T>
[[nodiscard]] Integration<T> begun(Start<T> start);
extern template Integration<double> begun(Start<double>);
extern template Integration<Quad> begun(Start<Quad>);

/// What else belongs to an integration. Numbers are texts, so that each scalar reads every digit of them.
struct AskedIntegration {
  std::string step;                    // the step, of either sign; with a tolerance the time between looks
  std::vector<std::string> initial{};  // a number for each coordinate; none: the system's own state
  std::string t0 = "0";
  std::string tolerance{};              // the relative one, of a method that chooses its steps
  std::vector<std::string> absolute{};  // beside it: none, one for all coordinates, or one for each
  std::string formulation{};            // of a system with constraints, for methods that need a vector field
  std::size_t block_rows = 0;           // see Start
};

/// The integration of a system by a method, in the scalar T (double or Quad). The system is a name or the
/// file of a text model, the method a name or the file of a table of coefficients, each with its parameters.
/// A method that does not step on the constraints of a system has its motion in the named formulation, or in
/// that of formulation_for(). InputError for whatever does not fit.
template <class T = double>
[[nodiscard]] Integration<T> integrate(const std::string& system, const Assignments& system_parameters,
                                       const std::string& method, const Assignments& method_parameters,
                                       const AskedIntegration& asked);

extern template Integration<double> integrate(const std::string&, const Assignments&, const std::string&,
                                              const Assignments&, const AskedIntegration&);
extern template Integration<Quad> integrate(const std::string&, const Assignments&, const std::string&,
                                            const Assignments&, const AskedIntegration&);

/// The integration of a model by a method, from its own state at the time 0.
template <class T = double>
[[nodiscard]] Integration<T> integrate(const std::shared_ptr<const Model>& model,
                                       std::shared_ptr<const MethodInstance> method, const T& h) {
  Start<T> start{model, std::move(method), {}, h};
  if (model != nullptr)
    for (const Real& x : model->initial()) start.state.push_back(T(x));
  return begun(std::move(start));
}

}  // namespace pfaff
