#include <pfaff/systems/text/model.hpp>

#include <algorithm>

#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/core/facets/momenta_of_velocities.hpp>
#include <pfaff/core/facets/redundant_constraints.hpp>
#include <pfaff/core/facets/taped_flows.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/systems/text/arguments.hpp>
#include <pfaff/systems/text/followed_quantities.hpp>
#include <pfaff/systems/text/kepler_parts.hpp>
#include <pfaff/systems/text/legendre.hpp>

namespace pfaff::text {

namespace {
using Tapes = std::shared_ptr<const Tape>;

class Builder {
 public:
  Builder(const TextDeclaration& declaration, const std::vector<Real>& values)
      : d_(declaration), names_(declaration, values), n_(names_.dimension()) {
    source_.name = d_.name;
    source_.dimension = static_cast<int>(n_);
    source_.time_unit = d_.time_unit;
    source_.coordinates = names_.coordinates();
    for (std::size_t k = 0; k < values.size(); ++k)
      source_.parameters.emplace_back(d_.parameters[k].name, to_string(values[k]));
  }

  ModelSource build() && {
    names_.check_definitions(d_);
    if (d_.initial_velocities) require_pairs();
    if (d_.initial) source_.initial = constants(*d_.initial, "initial", d_.initial_velocities ? n_ / 2 : n_);
    if (d_.damping) source_.damping = constants(*d_.damping, "damping", 1).front();
    for (std::size_t k = 0; k < formula_count; ++k)
      if (d_.formulas[k]) take(static_cast<Formula>(k), *d_.formulas[k]);
    if (d_.lagrangian) {
      take_lagrangian();
      if (d_.has(Formula::applied_force)) insert_velocities();
    }
    if (d_.bracket) take_bracket(*d_.bracket, Formula::poisson_tensor);
    if (d_.symmetric_bracket) take_bracket(*d_.symmetric_bracket, Formula::symmetric_tensor);
    if (!d_.velocity_constraints.empty()) take_velocity_constraints();
    if (!d_.parts.empty()) take_parts();
    if (d_.kepler_parts) take_kepler_parts();
    if (!d_.invariants.empty()) take_invariants();
    source_.canonical = members_of(source_).canonical();
    if (source_.canonical || d_.damping) require_pairs();
    if (d_.initial_velocities) take_initial_velocities();
    leave_out_redundant(source_);
    leave_out_zero_offsets(source_);
    add_followed_quantities(source_);
    return std::move(source_);
  }

 private:
  // Numbers, as many as `expected`.
  std::vector<Real> constants(const TextFormula& formula, const std::string& what,
                              std::size_t expected) const {
    Scope scope = names_.scope(Arguments::none, what, {}, {});
    std::vector<Recorded> values;
    for (const Expression& e : formula.results) scope.append(e, values);
    std::vector<Real> numbers;
    for (const Recorded& x : values) numbers.push_back(x.constant());
    if (numbers.size() != expected)
      refuse(formula.place, 0,
             what + ": expected " +
                 (expected == 1 ? "one number"
                                : std::to_string(expected) + " numbers, one for each " +
                                      (expected == n_ ? "coordinate" : "position")) +
                 ", got " + std::to_string(numbers.size()));
    return numbers;
  }

  // Positions and momenta come in pairs.
  void require_pairs() const {
    if (n_ % 2 == 0) return;
    refuse(d_.coordinates.front().place, 0,
           (n_ == 1 ? "there is 1 coordinate" : "there are " + std::to_string(n_) + " coordinates") +
               std::string("; expected an even number, first all positions and then their momenta"));
  }

  // The tape of expressions. `expected` is how many results there must be, 0 where any number will do.
  Tapes recorded(const std::vector<Expression>& expressions, Arguments arguments, const std::string& what,
                 std::size_t expected, const Source& place) const {
    if (arguments == Arguments::positions || arguments == Arguments::momenta) require_pairs();
    Recorder recorder(static_cast<int>(names_.inputs(arguments)));
    Scope scope = names_.scope(arguments, what, recorder.time(), recorder.inputs());
    std::vector<Recorded> results;
    for (const Expression& e : expressions) scope.append(e, results);
    if (expected == 0 ? results.empty() : results.size() != expected)
      refuse(place, 0,
             what + ": expected " + (expected == 0 ? "at least one" : std::to_string(expected)) +
                 (expected <= 1 ? " expression, got " : " expressions, got ") +
                 std::to_string(results.size()));
    return std::make_shared<const Tape>(recorder.finish(results));
  }

  // How many results a formula has; 0 where its author decides.
  [[nodiscard]] std::size_t results_of(Formula formula) const {
    switch (formula) {
      case Formula::hamiltonian:
      case Formula::kinetic:
      case Formula::potential:
      case Formula::birkhoffian:
      case Formula::chart_hamiltonian:
      case Formula::entropy:
        return 1;
      case Formula::force:
      case Formula::velocity:
      case Formula::friction:
      case Formula::applied_force:
        return n_ / 2;
      case Formula::structure:
        return n_ * n_;
      case Formula::alpha:
        return 2 * n_;
      case Formula::holonomic:
      case Formula::constraints:
      case Formula::casimirs:
        return 0;
      default:
        return n_;
    }
  }

  void take(Formula formula, const TextFormula& written) {
    const std::string what(to_string(formula));
    const bool moving = formula == Formula::applied_force && d_.lagrangian;
    auto tape = recorded(written.results, moving ? Arguments::motion : arguments_of(formula), what,
                         results_of(formula), written.place);
    if (formula == Formula::holonomic || formula == Formula::constraints) {
      source_.constraint_names = written.names;
      if (written.names.empty() || written.names.size() != tape->outputs.size()) {
        source_.constraint_names.clear();
        for (std::size_t k = 1; k <= tape->outputs.size(); ++k)
          source_.constraint_names.push_back("phi" + std::to_string(k));
      }
    }
    source_.given[index(formula)] = std::move(tape);
  }

  [[nodiscard]] Tapes lagrangian() const {
    return recorded(d_.lagrangian->results, Arguments::velocities, "lagrangian", 1, d_.lagrangian->place);
  }

  // Momenta follow the positions in the initial state.
  void take_initial_velocities() {
    const TextFormula& written = *d_.initial_velocities;
    const std::vector<Real> v = constants(written, "initial_velocities", n_ / 2), q = source_.initial;
    const auto given = [&](Formula f) { return source_.given[index(f)]; };
    try {
      const std::vector<Real> p =
          d_.lagrangian ? momenta_of_lagrangian(*lagrangian(), q, v)
                        : momenta_of_velocities(
                              given(Formula::kinetic) ? given(Formula::kinetic) : given(Formula::hamiltonian),
                              Real(0), q, v);
      source_.initial.insert(source_.initial.end(), p.begin(), p.end());
    } catch (const InputError& error) {
      refuse(written.place, 0, "initial_velocities: " + std::string(error.what()));
    }
  }

  void take_lagrangian() {
    require_pairs();
    const auto tape = lagrangian();
    std::vector<Real> q(n_ / 2);
    for (std::size_t k = 0; k < q.size(); ++k)  // without an initial state any positions will do
      q[k] = source_.initial.empty() ? Real::fraction(static_cast<std::int64_t>(2 * k + 3), 7)
                                     : source_.initial[k];
    LegendreTransform made = legendre_transform(*tape, q);
    if (!made.refused.empty())
      refuse(d_.lagrangian->results.front().source(), 0, "lagrangian: " + made.refused);
    source_.given[index(Formula::hamiltonian)] = std::move(made.hamiltonian);
    source_.given[index(Formula::kinetic)] = std::move(made.kinetic);
    source_.given[index(Formula::potential)] = std::move(made.potential);
  }

  // Applied forces beside a lagrangian are written as functions of (q, p, v); they become functions of (q,
  // p), with v = H_p.
  void insert_velocities() {
    Tapes& force = source_.given[index(Formula::applied_force)];
    const Tapes kinetic = source_.given[index(Formula::kinetic)],
                energy = kinetic ? kinetic : source_.given[index(Formula::hamiltonian)];
    const std::size_t m = n_ / 2;
    force = std::make_shared<const Tape>(record(
        static_cast<int>(n_), static_cast<int>(m), [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
          const std::vector<Recorded> one{Recorded(1)},
              slope = gradient(*energy, t, kinetic ? z.subspan(m) : z, one);
          std::vector<Recorded> motion(z.begin(), z.end());
          motion.insert(motion.end(), slope.end() - static_cast<std::ptrdiff_t>(m), slope.end());
          const std::vector<Recorded> values = evaluate(*force, t, motion);
          std::copy(values.begin(), values.end(), out.begin());
        }));
  }

  // The tensor of a bracket, column by column from the sharp map of a plug-in, or as its rows are written.
  void take_bracket(const GivenBracket& bracket, Formula formula) {
    const std::string what = formula == Formula::poisson_tensor ? "bracket" : "symmetric_bracket";
    if (bracket.chosen.plugin == nullptr) {
      source_.given[index(formula)] =
          recorded(bracket.rows, Arguments::state, "rows of " + what, n_ * n_, bracket.place);
      return;
    }
    const BracketInstance& made = bracket.chosen.instance;
    if (const std::string reason = tensor_refused(made, n_); !reason.empty())
      refuse(bracket.place, 0, what + ": " + reason);
    source_.given[index(formula)] = recorded_tensor(made);
    if (formula == Formula::poisson_tensor) source_.given[index(Formula::casimirs)] = made.casimirs;
  }

  void take_velocity_constraints() {
    std::vector<Expression> rows, offsets;
    bool any_offset = false;
    for (const TextVelocityConstraint& c : d_.velocity_constraints) {
      // Each row by itself, so that the wrong one is named.
      (void)recorded(c.row, Arguments::positions, "row of " + c.name, n_ / 2,
                     c.row.empty() ? Source{{}, d_.path} : c.row.front().source());
      rows.insert(rows.end(), c.row.begin(), c.row.end());
      offsets.push_back(c.offset ? *c.offset : Expression(Source{"0", d_.path}));
      any_offset = any_offset || c.offset.has_value();
      source_.velocity_constraint_names.push_back(c.name);
    }
    const Source place{{}, d_.path};
    source_.given[index(Formula::velocity_constraints)] =
        recorded(rows, Arguments::positions, "velocity_constraints",
                 rows.empty() ? 0 : d_.velocity_constraints.size() * (n_ / 2), place);
    if (any_offset)
      source_.given[index(Formula::velocity_offsets)] =
          recorded(offsets, Arguments::positions, "b of velocity_constraints", offsets.size(), place);
  }

  void take_parts() {
    std::vector<Tapes> changes;
    for (const TextPart& part : d_.parts) {
      if (part.small) source_.small_part = changes.size();
      changes.push_back(recorded(part.change.results, Arguments::flow, "change of '" + part.name + "'", n_,
                                 part.change.place));
      source_.part_names.push_back(part.name);
    }
    source_.flows = std::make_shared<const TapedFlowsFactory>(std::move(changes));
  }

  void take_kepler_parts() {
    const auto given = [&](Formula f) { return source_.given[index(f)]; };
    try {
      if (given(Formula::kinetic) == nullptr)
        throw InputError("lagrangian: expected a mass matrix that does not depend on positions");
      source_.flows = std::make_shared<const PlanetaryFlowsFactory>(std::make_shared<const PlanetaryBodies>(
          attracting_bodies(*given(Formula::kinetic), *given(Formula::potential), source_.initial)));
    } catch (const InputError& error) {
      refuse(*d_.kepler_parts, 0, "parts: " + std::string(error.what()));
    }
    source_.part_names = planetary::part_names();
    source_.small_part = planetary::interaction;
  }

  void take_invariants() {
    std::vector<Expression> values;
    for (const TextInvariant& i : d_.invariants) {
      values.push_back(i.of);
      source_.invariants.push_back(i.invariant);
    }
    source_.given[index(Formula::invariants)] =
        recorded(values, Arguments::state, "invariants", values.size(), Source{{}, d_.path});
  }

  const TextDeclaration& d_;
  TextNames names_;
  std::size_t n_;
  ModelSource source_;
};
}  // namespace

ModelSource model_source(const TextDeclaration& declaration, const std::vector<Real>& values) {
  return Builder(declaration, values).build();
}

}  // namespace pfaff::text
