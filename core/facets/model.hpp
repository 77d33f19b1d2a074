// Model: one instance of a system, its parameters fixed, as a set of formulas.
//
// A model is immutable and shared between threads. What the author wrote is recorded as tapes; everything
// else that a facet promises is derived from those on first use: forces, Jacobians, the Darboux chart of a
// structure K that is constant or depends on time alone, the field in that chart, and the field itself. The
// field follows from a Hamiltonian through its bracket, or from K zdot + D = 0 with, for a Birkhoffian
// system, K = dF and D = -(grad B + F_t) (su-qin (4), (5), (67)).
//
// A model with constraints is no vector field yet, and offers none: a formulation (core/formulation.hpp)
// makes one of it, another model.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/evaluator.hpp>
#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/core/facets/facet.hpp>
#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>
#include <pfaff/core/linear/symplectic_basis.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// What a named quantity does along exact solutions.
enum class Behaviour { conserved, decreasing, increasing, free };

constexpr std::string_view to_string(Behaviour behaviour) {
  constexpr std::array<std::string_view, 4> names{"conserved", "decreasing", "increasing", "free"};
  return names[static_cast<std::size_t>(behaviour)];
}

/// A named quantity I(z, t). `quadratic` marks those that are quadratic forms in z, with constant
/// coefficients.
struct Invariant {
  std::string name;
  std::string unit;
  Behaviour behaviour = Behaviour::conserved;
  bool quadratic = false;
};
inline Invariant conserved(std::string name, std::string unit) {
  return {std::move(name), std::move(unit), Behaviour::conserved, false};
}
inline Invariant conserved_quadratic(std::string name, std::string unit) {
  return {std::move(name), std::move(unit), Behaviour::conserved, true};
}
inline Invariant decreasing(std::string name, std::string unit) {
  return {std::move(name), std::move(unit), Behaviour::decreasing, false};
}

/// A state variable.
struct Coordinate {
  std::string name;
  std::string unit;
  /// Where what the system states of itself is meant to hold: verification draws states from all of it. A run
  /// may leave it.
  Range range = unbounded;
};

/// A formula that its author compiled for doubles: called with the system, t, arguments and results.
using CompiledFormula = void (*)(const void* system, const double& t, const double* arguments,
                                 double* results);

/// The same at W points side by side: each lane has the bits that its point would have alone.
template <int W>
using CompiledInLanes = void (*)(const void* system, const Pack<W>& t, const Pack<W>* arguments,
                                 Pack<W>* results);

/// What is compiled of a formula: its code for doubles and, with some formulas, for packs.
struct CompiledCode {
  CompiledFormula one = nullptr;
  CompiledInLanes<4> four = nullptr;
  CompiledInLanes<8> eight = nullptr;

  template <int W>
  [[nodiscard]] CompiledInLanes<W> in_lanes() const {
    if constexpr (W == 4)
      return four;
    else
      return eight;
  }
};

struct CompiledSeries;

/// What a system's author provides, before anything is derived.
struct ModelSource {
  // Written in model.cpp, since every plug-in would otherwise compile the copying of all that follows.
  ModelSource();
  ModelSource(const ModelSource&);
  ModelSource(ModelSource&&) noexcept;
  ModelSource& operator=(const ModelSource&);
  ModelSource& operator=(ModelSource&&) noexcept;
  ~ModelSource();

  std::string name;
  int dimension = 0;
  bool canonical = false;       // the bracket is the canonical one on (q, p)
  std::optional<Real> damping;  // the rate nu of friction, beside kinetic and potential energy
  std::vector<Coordinate> coordinates;
  std::vector<Invariant> invariants;
  std::vector<Real> initial;
  std::string time_unit = "s";
  std::vector<std::pair<std::string, std::string>> parameters;  // resolved: name, value
  std::array<std::shared_ptr<const Tape>, formula_count> given;
  std::array<CompiledCode, formula_count> compiled{};
  const CompiledSeries* chart_field_series = nullptr;
  std::array<std::shared_ptr<const FormulaProgram>, formula_count> programs;   // instead of given
  std::shared_ptr<const HolonomicFactory> holonomic;                           // null: from the tapes
  std::shared_ptr<const ExactFlowsFactory> flows;                              // null: no parts
  std::optional<std::size_t> small_part;                                       // a perturbation of the others
#define PFAFF_COUNT(name, member, names, ...) std::vector<std::string> names;  // in the author's order
#include <pfaff/core/facets/formula_rows.hpp>
  // Of the author's holonomic constraints those that follow from the others (redundant_constraints.hpp).
  std::vector<std::string> redundant_constraints;
  std::optional<bool> autonomous;  // said beforehand where the tapes are too long to be searched for the time
  std::string formulation;         // the formulation that made the field, or empty
  std::vector<std::pair<std::string, std::string>> formulation_parameters;
  std::shared_ptr<const void> system;  // keeps the author's object alive for compiled formulas
};

class Model {
 public:
  /// InputError, naming the system, where formulas of the source do not belong together.
  explicit Model(ModelSource source);

  [[nodiscard]] const std::string& name() const { return source_.name; }
  [[nodiscard]] int dimension() const { return source_.dimension; }
  [[nodiscard]] const std::vector<Coordinate>& coordinates() const { return source_.coordinates; }
  [[nodiscard]] const std::vector<Invariant>& invariants() const { return source_.invariants; }
  [[nodiscard]] const std::vector<Real>& initial() const { return source_.initial; }
  [[nodiscard]] const std::string& time_unit() const { return source_.time_unit; }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& parameters() const {
    return source_.parameters;
  }
  [[nodiscard]] FacetSet facets() const { return facets_; }
  /// The facets that the formulas make by themselves. facets() leaves out those that are not true of the
  /// motion where constraints or a second bracket take part in it; derivations rest on content().
  [[nodiscard]] FacetSet content() const { return content_; }
  /// The pivots, chosen at t = 0, by which the chart is derived from a structure that is constant or depends
  /// on time alone; empty where the chart is not derived in this way.
  [[nodiscard]] const PivotPairs& chart_pivots() const { return pivots_; }
  /// What the model was made of. A formulation copies and completes it, and makes another model of the copy.
  [[nodiscard]] const ModelSource& source() const { return source_; }
  // Questions by meaning. Callers ask these instead of testing facets, so that a new kind of constraint or of
  // motion changes the answers here and no code elsewhere.

  /// True where states must lie on a surface, whatever kind of constraints makes it and whether a formulation
  /// has made a motion of them or not. `constraint_names` are then the equations of the surface.
  [[nodiscard]] bool restricted() const {
    return content_.meets(pfaff::facets(Facet::constraints, Facet::velocity_constraints));
  }
  /// True where the model offers a vector field, dz/dt = X(z, t): of its own, or from a formulation.
  [[nodiscard]] bool moves() const { return facets_.has(Facet::vector_field); }
  /// True where the constraints are phi(q, t) = 0, of positions, each of which implies a hidden one for the
  /// momenta: holonomic_constraints<T>() gives them, and methods may keep them themselves.
  [[nodiscard]] bool holonomic() const { return facets_.has(Facet::holonomic); }
  /// True where the constraints phi(z, t) = 0, holonomic ones and their hidden ones included, have Poisson
  /// brackets among each other that Dirac's bracket can be made of: Formula::constraints and its gradients.
  [[nodiscard]] bool constrained() const { return facets_.has(Facet::constraints); }
  /// True where there is an energy H(z, t), tape(Formula::hamiltonian), whatever else takes part in the
  /// motion.
  [[nodiscard]] bool has_energy() const { return content_.has(Facet::hamiltonian); }
  /// True for an H = T(p, t) + V(q, t) in canonical coordinates, constrained or not.
  [[nodiscard]] bool separable_energy() const { return content_.has(Facet::separable); }
  /// True where forces are applied beside those of the energy, p' = -H_q + Q: Formula::applied_force.
  [[nodiscard]] bool forced() const { return given(Formula::applied_force); }
  /// True where no coefficient of friction can differ from zero.
  [[nodiscard]] bool frictionless() const;
  /// Names of all constraints, in the order of Formula::constraints: of holonomic ones, each is followed by
  /// the hidden one it implies.
  [[nodiscard]] std::vector<std::string> constraint_names() const;
  /// The holonomic constraints for one scalar; std::logic_error where there are none.
  template <class T>
  [[nodiscard]] std::unique_ptr<HolonomicConstraints<T>> holonomic_constraints() const {
    return holonomic_factory().make_for(std::type_identity<T>());
  }
  /// True where velocities are constrained, A(q, t) v + b(q, t) = 0: velocity_constraints<T>() gives the
  /// constraints, and methods may keep them themselves.
  [[nodiscard]] bool nonholonomic() const { return facets_.has(Facet::velocity_constraints); }
  /// All constraints at the level of velocities for one scalar; std::logic_error where the system has no
  /// velocity constraints.
  template <class T>
  [[nodiscard]] VelocityPointer<T> velocity_constraints() const {
    return velocity_factory().make_for(std::type_identity<T>());
  }
  /// The parts of the field that are solved exactly, by their names; empty where there are none.
  [[nodiscard]] const std::vector<std::string>& part_names() const { return source_.part_names; }
  /// The part that is a small perturbation of the others, counted from zero; nullopt where its author names
  /// none.
  [[nodiscard]] std::optional<std::size_t> small_part() const { return source_.small_part; }
  /// The flows of the parts for one scalar; std::logic_error where there are none.
  template <class T>
  [[nodiscard]] ExactFlowsPointer<T> exact_flows() const {
    return flows_factory().make_for(std::type_identity<T>());
  }
  /// True when the canonical bracket on (q, p) is the system's own.
  [[nodiscard]] bool canonical() const { return source_.canonical; }

  /// The rate nu of the conformal facet, in 1/time_unit.
  [[nodiscard]] const Real& damping() const { return source_.damping.value(); }

  /// The tape of a formula, derived on first use. Throws std::logic_error when the facets do not give it.
  [[nodiscard]] std::shared_ptr<const Tape> tape(Formula formula) const;
  /// What the author can do about a missing facet of `needs`, as an addition to a message ("; its structure K
  /// depends on the state: ..."); empty when there is nothing to say.
  [[nodiscard]] std::string advice(FacetSet needs) const;
  /// The tape of a formula as it is derived from others, even where the author wrote it; null where it cannot
  /// be derived. (Charts are not unique: one that the author wrote is not derived again.)
  [[nodiscard]] std::shared_ptr<const Tape> derived(Formula formula) const;
  /// True where the author wrote the formula.
  [[nodiscard]] bool given(Formula formula) const {
    return source_.given[index(formula)] != nullptr || program(formula) != nullptr;
  }
  /// The formula compiled for every scalar; null where it is not.
  [[nodiscard]] const FormulaProgram* program(Formula formula) const {
    return source_.programs[index(formula)].get();
  }
  /// The author's code for doubles, to be called with system(); null when there is none. Canonical
  /// coordinates are Darboux coordinates already, so that the code of the field is also that of the field in
  /// the chart.
  [[nodiscard]] CompiledFormula compiled(Formula formula) const { return code_of(formula).one; }
  /// The same for packs; null where it is not compiled for them.
  template <int W>
  [[nodiscard]] CompiledInLanes<W> compiled_in_lanes(Formula formula) const {
    return code_of(formula).in_lanes<W>();
  }
  /// The author's field in the chart compiled for series; null when there is none.
  [[nodiscard]] const CompiledSeries* chart_field_series() const { return source_.chart_field_series; }
  [[nodiscard]] const void* system() const { return source_.system.get(); }

  /// True where the field does not depend on time explicitly; the next ones ask the same of the field in the
  /// chart and of the structure.
  [[nodiscard]] bool autonomous() const;
  [[nodiscard]] bool chart_autonomous() const { return tape(Formula::chart_field)->autonomous(); }

 private:
  [[nodiscard]] const CompiledCode& code_of(Formula formula) const {
    const bool same = formula == Formula::chart_field && source_.canonical && !given(Formula::chart);
    return source_.compiled[index(same ? Formula::field : formula)];
  }
  [[nodiscard]] PivotPairs pivots_of_structure() const;

  /// What content() is before a chart derived from the structure is added.
  [[nodiscard]] FacetSet content_of_formulas() const;
  [[nodiscard]] const HolonomicFactory& holonomic_factory() const;
  [[nodiscard]] const VelocityFactory& velocity_factory() const;
  [[nodiscard]] const ExactFlowsFactory& flows_factory() const;

  ModelSource source_;
  FacetSet content_, facets_;
  PivotPairs pivots_;  // empty unless the chart is derived from the structure
  mutable std::recursive_mutex mutex_;
  mutable std::array<std::shared_ptr<const Tape>, formula_count> tapes_;
  mutable std::shared_ptr<const HolonomicFactory> holonomic_;
  mutable std::shared_ptr<const VelocityFactory> velocity_;
};

/// How a formula follows from others (core/facets/derivations/derivation.hpp).
struct Derivation;
/// The way in which a model derives a formula; null where it cannot.
const Derivation* derivation_of(Formula formula, const Model& model);

/// The field (T_p, -V_q - nu p) that the conformal facet stands for.
Tape damped_field(const Model& model);

}  // namespace pfaff

// Vectors that every plug-in holds are compiled once.
extern template class std::vector<pfaff::Coordinate>;
extern template class std::vector<pfaff::Invariant>;
