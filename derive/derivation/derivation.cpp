#include <pfaff/derive/derivation/derivation.hpp>

#include <algorithm>
#include <functional>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/derive/derivation/elimination_order.hpp>
#include <pfaff/derive/derivation/engines.hpp>
#include <pfaff/derive/derivation/explicit_solves.hpp>
#include <pfaff/derive/derivation/generating_coefficients.hpp>
#include <pfaff/derive/derivation/redundancy.hpp>
#include <pfaff/derive/derivation/scaled.hpp>
#include <pfaff/derive/derivation/symbolic_formulas.hpp>
#include <pfaff/formulations/ideal_reactions.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<Recorded>;
/// The rates of (q, p) of recorded constraints, by one method.
using Engine =
    std::function<void(HolonomicConstraints<Recorded>&, const Recorded& t, In<Recorded> z,
                       Out<Recorded> rates, FrictionForm form, const std::vector<std::size_t>& order)>;

template <class Rates>
void by_formulation(HolonomicConstraints<Recorded>& constraints, const Recorded& t, In<Recorded> z,
                    Out<Recorded> rates, FrictionForm form, const std::vector<std::size_t>& /*order*/) {
  const std::size_t n = constraints.degrees();
  (void)Rates(form, constraints)(constraints, t, z.first(n), z.subspan(n), rates.first(n), rates.subspan(n));
}
template <class Solver>
void by_solver(HolonomicConstraints<Recorded>& constraints, const Recorded& t, In<Recorded> z,
               Out<Recorded> rates, FrictionForm /*form*/, const std::vector<std::size_t>& order) {
  const std::size_t n = constraints.degrees();
  (void)BracketRates<Solver, Recorded>(constraints, order)(t, z.first(n), z.subspan(n), rates);
}

struct Row {
  DerivationMethod method;
  FrictionForm friction = FrictionForm::none;
  Engine engine = {};      // empty for the methods without holonomic constraints
  bool recursion = false;  // eliminates constraint by constraint
};
Row row_for(const DerivationMethod& method) {
  using enum FrictionForm;
  switch (method.way) {
    case DerivationWay::ldl:
    case DerivationWay::minors:
      return {method, metriplectic, by_formulation<HamiltonianReactions<Recorded>>};
    case DerivationWay::simplified:
      return {method, metriplectic, by_formulation<IdealReactions<Recorded>>};
    case DerivationWay::lmm:
      return {method, stokes, by_formulation<IdealReactions<Recorded>>};
    case DerivationWay::recursion:
      return {method, metriplectic, by_solver<RecursiveVectorsDirac>, true};
    case DerivationWay::recursion_literal:
      return {method, metriplectic, by_solver<RecursiveLiteralDirac>, true};
    case DerivationWay::bivector:
      return {method, metriplectic, by_solver<RecursiveTensorDirac>, true};
    case DerivationWay::nonholonomic:
    case DerivationWay::birkhoffian:
    case DerivationWay::generating_function:
      break;
  }
  return {method};
}
const std::vector<Row>& rows() {
  static const std::vector<Row> list = [] {
    std::vector<Row> made;
    for (const DerivationMethod& method : derivation_methods()) made.push_back(row_for(method));
    return made;
  }();
  return list;
}
const Row& row_of(const std::string& name) {
  const DerivationWay way = derivation_method(name).way;
  return *std::find_if(rows().begin(), rows().end(), [&](const Row& row) { return row.method.way == way; });
}

bool chain(const Model& model) {
  return ConstraintsByMinors<Recorded>::fits(model.holonomic_constraints<double>()->pattern());
}

std::string misfit(const Model& model, const Row& row) {
  const std::string& method = row.method.name;
  const std::string who = "method " + method + " needs ";
  if (row.method.way == DerivationWay::nonholonomic) {
    if (!model.nonholonomic()) return who + "velocity constraints; " + model.name() + " has none";
    if (std::string refused = formulations().get("nonholonomic", "formulation").refuses(model);
        !refused.empty())
      return refused;
    std::vector<Quad> z;
    for (const Real& x : model.initial()) z.push_back(x.quad());
    const std::string reason = dependent_velocity_constraints(model, Quad(0), z);
    return reason.empty() ? "" : "initial state of " + model.name() + ": " + reason;
  }
  if (row.method.way == DerivationWay::birkhoffian) {
    const bool structured = model.facets().has(Facet::structure) || model.facets().has(Facet::hamiltonian);
    if (structured && (model.canonical() || model.facets().has(Facet::structure))) return {};
    return who + "a structure K(z, t) and no constraints; " + model.name() + " offers " +
           to_string(model.facets());
  }
  if (row.method.way == DerivationWay::generating_function) {
    if (has_chart_hamiltonian(model)) return {};
    return who + "a Hamiltonian in Darboux coordinates and no constraints; " + model.name() + " offers " +
           to_string(model.facets());
  }
  if (!model.holonomic())
    return who + "holonomic constraints; " + model.name() + " offers " + to_string(model.facets());
  if (row.method.way == DerivationWay::minors && !chain(model))
    return who + "one chain of constraints; S of " + model.name() + " is none";
  if (row.recursion && !model.tape(Formula::holonomic)->autonomous())
    return who + "constraints that do not depend on time; those of " + model.name() + " do";
  return {};
}

void derive_holonomic(const Model& model, const Row& row, FrictionForm form,
                      const std::vector<std::string>& elimination, Equations& equations) {
  const SymbolicFormulas source = symbolic_formulas(model, form != FrictionForm::none);
  const auto tapes = std::make_shared<const HolonomicTapes>(record_holonomic(source.formulas));
  refuse_redundant(tapes, source, model, row.recursion);
  const std::vector<std::size_t> order = elimination_order(tapes, source, model, elimination);
  equations.parameters = source.parameters;
  equations.parameter_values = source.values;
  const std::size_t n = 2 * source.formulas.degrees;
  Recorder recorder(static_cast<int>(n + source.parameters.size()));
  const Numbers inputs = recorder.inputs();
  const Numbers parameters(inputs.begin() + static_cast<std::ptrdiff_t>(n), inputs.end());
  Numbers rates(n);
  const auto record_with = [&](auto&& constraints) {
    row.engine(constraints, recorder.time(), In<Recorded>(inputs).first(n), rates, form, order);
  };
  if (row.method.way == DerivationWay::minors) {
    record_with(ConstraintsByMinors<Recorded>(tapes, parameters));
  } else {
    record_with(TapedConstraints<Recorded>(tapes, parameters));
  }
  equations.tape = recorder.finish(rates);
}

}  // namespace

Equations keep_used(Equations equations) {
  const std::size_t coordinates = equations.coordinates.size();
  std::vector<int> place(equations.parameters.size(), -1);  // of the parameters that are kept
  const auto place_of = [&](const Instruction& i) -> int* {
    const auto input = static_cast<std::size_t>(i.a);
    return i.operation == Operation::input && input >= coordinates ? &place[input - coordinates] : nullptr;
  };
  for (const Instruction& i : equations.tape.code)
    if (int* kept = place_of(i)) *kept = 0;
  std::vector<Symbol> names;
  std::vector<Real> values;
  for (std::size_t k = 0; k < place.size(); ++k) {
    if (place[k] < 0) continue;
    place[k] = static_cast<int>(coordinates + names.size());
    names.push_back(std::move(equations.parameters[k]));
    values.push_back(equations.parameter_values[k]);
  }
  for (Instruction& i : equations.tape.code)
    if (const int* kept = place_of(i)) i.a = *kept;
  equations.tape.inputs = static_cast<int>(coordinates + names.size());
  equations.parameters = std::move(names);
  equations.parameter_values = std::move(values);
  return equations;
}

std::string derivation_misfit(const Model& model, const std::string& method) {
  return misfit(model, row_of(method));
}

Equations derive(const Model& model, const std::string& method, FrictionForm friction) {
  return derive(model, method, DerivationOptions{.friction = friction});
}

Equations derive(const Model& model, const std::string& method, const DerivationOptions& options) {
  const Row& row = row_of(method);
  if (const std::string reason = misfit(model, row); !reason.empty()) {
    std::string others;
    for (const Row& other : rows())
      if (misfit(model, other).empty()) others += (others.empty() ? "" : ", ") + other.method.name;
    throw InputError(reason + "; methods that fit: " + (others.empty() ? "none" : others));
  }
  const FrictionForm form = options.friction.value_or(row.friction);
  if (!row.recursion && !options.elimination.empty())
    throw InputError("method " + method + " has no order of elimination; those that have one: recursion, " +
                     "recursion-literal, bivector");
  if (row.recursion && form == FrictionForm::stokes)
    throw InputError("method " + method + " has no friction-form stokes; expected metriplectic or none");
  Equations equations;
  equations.system = model.name();
  equations.method = method;
  for (const Coordinate& c : model.coordinates()) equations.coordinates.push_back({c.name, c.unit});
  if (row.engine) {
    derive_holonomic(model, row, form, options.elimination, equations);
  } else if (row.method.way == DerivationWay::nonholonomic) {
    // The motion shares the formulas of the model, which outlives it.
    const std::shared_ptr<const Model> borrowed(std::shared_ptr<const Model>(), &model);
    const auto motion = formulations().get("nonholonomic", "formulation").apply(borrowed, {});
    equations.tape = *motion->tape(Formula::field);
  } else if (row.method.way == DerivationWay::generating_function) {
    expand_generating_function(model, options.degree, equations);
  } else {
    equations.tape =
        *(model.given(Formula::field) ? model.derived(Formula::field) : model.tape(Formula::field));
  }
  equations.tape = simplified(explicit_solves(equations.tape, "system " + model.name()));
  return keep_used(std::move(equations));
}

}  // namespace pfaff
