// What the author of a system includes: the formula vocabulary and the registration object System<S>.
//
// S is a struct in an anonymous namespace with `dimension` (static constexpr int, or a member function), Real
// members for its parameters, and any of these templates over the scalar T (t: time, z: state):
//   field(t, z, rate)                        dz/dt
//   kinetic(t, p), potential(t, q)           canonical separable H = T + V; optional force(t, q, f),
//                                            velocity(t, p, v)
//   damping()                                beside those: a Real nu, the system is q' = T_p,
//                                            p' = -V_q - nu p instead
//   hamiltonian(t, z), bracket()             H and the bracket that makes the field (canonical without
//                                            bracket()); its Casimirs where it has casimir_count() and
//                                            casimirs(t, z, values)
//   birkhoffian(t, z), one_form(t, z, F)     the action form F.dz - B dt
//   structure(t, z, K), covector(t, z, D)    instead: K(z, t) zdot + D(z, t) = 0 with K row-major, n x n
//   chart(t, z, y), chart_inverse(t, y, z)   Darboux coordinates; optional chart_hamiltonian(t, y),
//                                            chart_field(t, y, rate). Derived where K is constant or
//                                            depends on t alone
//   holonomic(t, q, phi)                     constraints phi(q, t) = 0 of a canonical system; how many says
//                                            constraint_count, static constexpr int or member function;
//                                            optional friction(t, z, lambda), coefficients >= 0 of momenta;
//                                            constraint_evaluator<T>(), an object with the operations of
//                                            core/facets/holonomic.hpp, in place of derived ones
//   applied_force(t, z, Q)                   generalised forces that no potential gives, beside a canonical
//                                            energy, constrained or not: p' = -H_q + Q
//   velocity_constraints(t, q, rows)         A(q, t), row-major, of constraints A v + b = 0 of the
//                                            velocities of a canonical system; how many says
//                                            velocity_constraint_count; optional velocity_offsets(t, q, b)
//   constraints(t, z, phi)                   instead: constraints of the phase space, second class, beside
//                                            hamiltonian; optional constraint_gradients(t, z, rows)
//   symmetric_bracket(), entropy(t, z)       metriplectic: zdot = Pi dH + G dS; without entropy, Pi dH - G dH
//   alpha(t, t0, new_z, old_z, w_hat, w)     pairs of states to (w^, w), for generating functions without a
//                                            chart
//   invariants(t, z, values)                 in the order of the descriptor's list
//   exact_solution(elapsed, t0, z0, z)       the flow
//   part_flow(part, h, z, change)            the exact flow of one part of the field, dz/dt = sum X_k(z):
//                                            the change phi_h(z) - z, with a Status; how many parts says
//                                            part_count, a constant or a member function; optional
//                                            part_names(), small_part, the part that is a perturbation
//   reversal(t, z, reversed)                 the involution rho that reverses the motion, rho o flow_h =
//                                            flow_-h o rho
//   shared_model(descriptor, parameters)     the whole model, for families of systems that share one
//   prepared<T>(), fits_lanes()              of a batched system: an object with some of its formulas that
//                                            keeps what does not change, for each scalar and, where
//                                            fits_lanes(), for Pack<8>
//   initial(z)                               instead of the descriptor's list, when it depends on parameters
//   coordinates(), invariant_list(),         instead of the descriptor's lists, when they do
//   constraint_names(), velocity_constraint_names()
// Whatever is not written is derived; whatever could be derived but is written is checked against the
// derivation. A member of one of these names with another signature is refused by the compiler
// (core/facets/system_formulas.hpp), a formula that writes more or fewer results than it should when a model
// is made.
#pragma once

#include <memory>

#include <pfaff/core/facets/collector.hpp>
#include <pfaff/core/facets/redundant_constraints.hpp>
#include <pfaff/core/registry/optional_member.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>

namespace pfaff {

/// What is said about a system, once.
struct SystemDescriptor {
  std::string name;           // kebab-case
  std::string title;          // one line with the equation of motion
  std::string reference;      // bib key and equations
  std::string description{};  // two to four sentences: what it is, when to take it, where it ends
  std::vector<Coordinate> coordinates{};
  std::vector<Real> initial{};
  std::vector<Invariant> invariants{};
  std::string time_unit = "s";
};

/// A registered system.
class SystemPlugin : public Plugin {
 public:
  SystemPlugin(SystemDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
               const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const SystemDescriptor& descriptor() const { return descriptor_; }
  /// True for systems with constraints, of positions, velocities or the phase space, whose motion is a
  /// formulation's.
  [[nodiscard]] virtual bool constrained() const = 0;
  /// True for those of them that constrain velocities, alone or beside positions.
  [[nodiscard]] virtual bool constrains_velocities() const = 0;
  /// A model with these parameters; the rest keep their defaults. InputError for wrong assignments.
  [[nodiscard]] virtual std::shared_ptr<const Model> make(const Assignments& assignments) const = 0;
  /// The parameters the system's claims are verified with; `full` asks for more than a quick check needs.
  [[nodiscard]] virtual std::vector<Assignments> instances(bool full) const = 0;

 private:
  SystemDescriptor descriptor_;
};

/// A model of an author's object (what System<S>::make does, for objects made in a program). InputError,
/// naming the system, where a formula writes more or fewer results than it should.
template <class S>
std::shared_ptr<const Model> make_model(const SystemDescriptor& descriptor, const S& object,
                                        Assignments parameters) {
  auto system = std::make_shared<const S>(object);
  ModelSource source;
  source.name = descriptor.name;
  source.dimension = detail::dimension_of(*system);
  source.coordinates = descriptor.coordinates;
  if constexpr (requires { system->coordinates(); }) source.coordinates = system->coordinates();
  source.invariants = descriptor.invariants;
  if constexpr (requires { system->invariant_list(); }) source.invariants = system->invariant_list();
  source.initial = descriptor.initial;
  source.time_unit = descriptor.time_unit;
  source.parameters = std::move(parameters);
  detail::Collector<S>(system, source).collect();
  leave_out_redundant(source);
  return std::make_shared<const Model>(std::move(source));
}
/// The same with the parameters that S has.
template <class S>
std::shared_ptr<const Model> make_model(const SystemDescriptor& descriptor, const S& object) {
  return make_model(descriptor, object, resolved(parameters_of<S>(), &object));
}

namespace detail {
/// True where S makes its model itself, with what it has in common with other systems.
template <class S>
concept WritesModel = requires(const S& object, const SystemDescriptor& descriptor, Assignments parameters) {
  { object.shared_model(descriptor, parameters) } -> std::same_as<std::shared_ptr<const Model>>;
};

/// Leaves the code of a system in one of its two units (core/facets/scalar_units.hpp), as a static object.
template <class S>
struct CodeOfSystem {
  CodeOfSystem() {
    if constexpr (!WritesModel<S>) Collector<S>::leave_code();
  }
};
}  // namespace detail

namespace detail::system {
PFAFF_OPTIONAL_MEMBER(
    instances, "static std::vector<Assignments> instances(bool full)", (bool full) {
      { S::instances(full) } -> std::convertible_to<std::vector<Assignments>>;
    })
}  // namespace detail::system

/// The parameters that S is verified with: those of its static member instances(full), or the defaults.
template <class S>
std::vector<Assignments> instances_of(bool full) {
  detail::system::check_instances<S>();
  if constexpr (detail::system::writes_instances<S>) return S::instances(full);
  return {{}};
}

/// Registers S when the library that holds it is loaded.
template <class S, class Unit = detail::ThisUnit>
class System final : public SystemPlugin, private detail::CodeOfSystem<S> {
 public:
  explicit System(SystemDescriptor descriptor,
                  const std::source_location& where = std::source_location::current())
      : SystemPlugin(std::move(descriptor), parameters_of<S>(), typeid(S), where) {
    systems().add(this);
  }
  [[nodiscard]] bool constrained() const override {
    return detail::counts_constraints<S> || constrains_velocities();
  }
  [[nodiscard]] bool constrains_velocities() const override { return detail::counts_velocity_constraints<S>; }
  [[nodiscard]] std::shared_ptr<const Model> make(const Assignments& assignments) const override {
    return on_behalf_of("system " + name(), [&] {
      S object;
      assign_all(parameters(), &object, assignments, "system " + name());
      if constexpr (detail::WritesModel<S>) {
        return object.shared_model(descriptor(), resolved(parameters(), &object));
      } else {
        return make_model(descriptor(), object);
      }
    });
  }
  [[nodiscard]] std::vector<Assignments> instances(bool full) const override {
    return on_behalf_of("system " + name(), [&] { return instances_of<S>(full); });
  }
};

/// The registration in the unit that makes code in double (core/facets/scalar_units.hpp).
template <class S>
class System<S, detail::InDouble> : private detail::CodeOfSystem<S> {
 public:
  explicit System(const SystemDescriptor& /*descriptor*/) {}
};

}  // namespace pfaff
