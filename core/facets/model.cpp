#include <pfaff/core/facets/model.hpp>

#include <stdexcept>

#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/core/facets/joined_velocity_constraints.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/facets/taped_velocity_constraints.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

std::string to_string(FacetSet set) {
  std::string text;
  for (unsigned k = 0; k < static_cast<unsigned>(Facet::count); ++k)
    if (set.has(static_cast<Facet>(k)))
      text += (text.empty() ? "" : ", ") + std::string(to_string(static_cast<Facet>(k)));
  return text;
}

FacetSet Model::content_of_formulas() const {
  const FormulaMembers has = members_of(source_);
  const bool energy = has.energy(), canonical = source_.canonical && energy;
  FacetSet content;
  const auto offer = [&](bool made, Facet facet) {
    if (made) content = content.with(facet);
  };
  offer(energy, Facet::hamiltonian);
  offer(has.separable(), Facet::separable);
  offer(has.conformal(), Facet::conformal);
  offer(has.form(), Facet::structure);
  offer(has.birkhoffian, Facet::birkhoffian);
  offer(has.field || energy || has.conformal() || has.form(), Facet::vector_field);
  offer(has.chart || canonical, Facet::darboux_chart);
  offer(has.alpha && (has.form() || source_.canonical), Facet::generating_map);
  offer(energy && has.symmetric_bracket, Facet::metriplectic);
  offer(canonical && has.holonomic, Facet::holonomic);
  offer(energy && (has.holonomic || has.constraints), Facet::constraints);
  offer(canonical && has.velocity_constraints, Facet::velocity_constraints);
  offer(!source_.invariants.empty(), Facet::invariants);
  offer(has.exact_solution, Facet::exact_solution);
  offer(has.part_flow, Facet::exact_flows);
  return content;
}

ModelSource::ModelSource() = default;
ModelSource::ModelSource(const ModelSource&) = default;
ModelSource::ModelSource(ModelSource&&) noexcept = default;
ModelSource& ModelSource::operator=(const ModelSource&) = default;
ModelSource& ModelSource::operator=(ModelSource&&) noexcept = default;
ModelSource::~ModelSource() = default;

Model::Model(ModelSource source) : source_(std::move(source)) {
  check_source(source_);
  content_ = content_of_formulas();
  if (content_.has(Facet::structure) && !content_.has(Facet::darboux_chart)) {
    pivots_ = pivots_of_structure();
    if (!pivots_.empty()) content_ = content_.with(Facet::darboux_chart);
  }
  facets_ = content_;
  const auto keep = [&](std::initializer_list<Facet> kept) {
    facets_ = {};
    for (const Facet f : kept)
      if (content_.has(f)) facets_ = facets_.with(f);
  };
  // Where a second bracket, applied forces or constraints take part, the energy and its bracket alone do not
  // make the motion: facets that speak of them are not offered, though content() has them.
  if (forced())
    keep({Facet::vector_field, Facet::holonomic, Facet::constraints, Facet::velocity_constraints,
          Facet::invariants, Facet::exact_solution, Facet::exact_flows});
  if (content_.has(Facet::metriplectic))
    keep({Facet::vector_field, Facet::metriplectic, Facet::invariants, Facet::exact_solution});
  if (content_.has(Facet::constraints))
    keep({Facet::holonomic, Facet::constraints, Facet::invariants, Facet::exact_solution});
  if (content_.has(Facet::velocity_constraints))
    keep({Facet::velocity_constraints, Facet::invariants, Facet::exact_solution});
  if (!source_.formulation.empty()) facets_ = facets_.with(Facet::vector_field);
}

bool Model::autonomous() const {
  if (source_.autonomous) return *source_.autonomous;
  if (restricted() && !tape(Formula::constraints)->autonomous()) return false;
  return tape(Formula::field)->autonomous();
}

bool Model::frictionless() const { return !given(Formula::friction) || tape(Formula::friction)->zero(); }

std::vector<std::string> Model::constraint_names() const {
  std::vector<std::string> names;
  for (const std::string& name : source_.constraint_names) {
    names.push_back(name);
    if (content_.has(Facet::holonomic)) names.push_back(name + "~");
  }
  for (const std::string& name : source_.velocity_constraint_names) names.push_back(name);
  return names;
}

const HolonomicFactory& Model::holonomic_factory() const {
  if (!content_.has(Facet::holonomic))
    throw std::logic_error("system " + name() + " has no holonomic constraints");
  if (source_.holonomic != nullptr) return *source_.holonomic;
  const std::lock_guard lock(mutex_);
  if (holonomic_ == nullptr)
    holonomic_ = std::make_shared<const TapedHolonomicFactory>(record_holonomic(*this));
  return *holonomic_;
}

const VelocityFactory& Model::velocity_factory() const {
  if (!content_.has(Facet::velocity_constraints))
    throw std::logic_error("system " + name() + " has no velocity constraints");
  const std::lock_guard lock(mutex_);
  if (velocity_ == nullptr && source_.holonomic != nullptr)
    velocity_ = std::make_shared<const JoinedVelocityFactory>(source_.holonomic, record_joined(*this));
  if (velocity_ == nullptr) velocity_ = std::make_shared<const TapedVelocityFactory>(record_velocity(*this));
  return *velocity_;
}

const ExactFlowsFactory& Model::flows_factory() const {
  if (source_.flows == nullptr) throw std::logic_error("system " + name() + " has no parts with exact flows");
  return *source_.flows;
}

PivotPairs Model::pivots_of_structure() const {
  const auto structure = tape(Formula::structure);
  if (!structure->state_independent()) return {};
  std::vector<double> k(structure->outputs.size());
  const std::vector<double> z(static_cast<std::size_t>(dimension()));  // K does not depend on it
  Replay<double> replay(structure);
  replay(0, z.data(), k.data());
  return choose_pivot_pairs(k, z.size());
}

std::string Model::advice(FacetSet needs) const {
  if (facets_.has(Facet::velocity_constraints) && !moves() && needs.has(Facet::vector_field))
    return "; a formulation of its velocity constraints makes a motion of them";
  if (forced() && !facets_.includes(needs))
    return "; its applied forces have no potential: methods for vector fields take them" +
           std::string(moves() ? "" : ", beside a formulation of its constraints");
  if (needs.has(Facet::generating_map) && !facets_.has(Facet::generating_map))
    return facets_.has(Facet::structure) || source_.canonical ? "; write alpha(t, t0, new_z, old_z, w_hat, w)"
                                                              : "";
  if (!needs.has(Facet::darboux_chart) || facets_.has(Facet::darboux_chart)) return {};
  if (!facets_.has(Facet::structure)) return {};
  return tape(Formula::structure)->state_independent()
             ? "; its structure K is degenerate at t = 0"
             : "; its structure K depends on the state: write chart and chart_inverse";
}

std::shared_ptr<const Tape> Model::tape(Formula formula) const {
  const std::lock_guard lock(mutex_);
  auto& slot = tapes_[index(formula)];
  if (slot == nullptr && program(formula) != nullptr)
    slot = std::make_shared<const Tape>(program(formula)->record());
  if (slot == nullptr) slot = given(formula) ? source_.given[index(formula)] : derived(formula);
  if (slot == nullptr) throw std::logic_error("system " + name() + " does not give this formula");
  return slot;
}

void require_offered(const Model& model, Formula formula) {
  const FormulaTraits& traits = row_of(formula).traits;
  const FacetSet of{traits.offered_by.bits | traits.part_of.bits};
  const bool of_another_motion = model.content().meets(of) || model.restricted();
  if (of.bits == 0 || model.facets().meets(of) || !of_another_motion) return;
  throw InputError("a step evaluates " + std::string(row_of(formula).name) + ", which " + model.name() +
                   " does not offer for its motion; expected a method that needs " + to_string(of) +
                   ", as the concept in the signature of its step says");
}

}  // namespace pfaff

template class std::vector<pfaff::Coordinate>;
template class std::vector<pfaff::Invariant>;
