// All derivations in one list: the first of a formula that applies to a model is taken.
#include <algorithm>

#include <pfaff/core/facets/derivations/charts.hpp>
#include <pfaff/core/facets/derivations/constraints.hpp>
#include <pfaff/core/facets/derivations/energies.hpp>
#include <pfaff/core/facets/derivations/metriplectic.hpp>
#include <pfaff/core/facets/derivations/structures.hpp>

namespace pfaff {

namespace {
template <std::size_t... N>
constexpr auto joined_families(const std::array<Derivation, N>&... families) {
  std::array<Derivation, (N + ...)> all{};
  auto end = all.begin();
  ((end = std::copy(families.begin(), families.end(), end)), ...);
  return all;
}

// Where the field can be derived in several ways the order decides: two brackets come before one, an energy
// before a structure, a structure before friction.
constexpr auto in_order =
    joined_families(derivations::metriplectic, derivations::energies, derivations::structures,
                    derivations::damped_energies, derivations::charts, derivations::constraints);

// True where every formula that no author can write has a derivation.
constexpr bool complete() {
  return std::all_of(formula_table.begin(), formula_table.end(), [](const FormulaRow& row) {
    return row.origin != Origin::none ||
           std::any_of(in_order.begin(), in_order.end(),
                       [&](const Derivation& d) { return d.of == row.formula; });
  });
}
static_assert(complete(), "a formula that authors do not write, PFAFF_DERIVED, needs a derivation");
}  // namespace

const Derivation* derivation_of(Formula formula, const Model& model) {
  const auto* const found = std::find_if(in_order.begin(), in_order.end(), [&](const Derivation& d) {
    return d.of == formula && d.applies(model);
  });
  return found == in_order.end() ? nullptr : found;
}

std::shared_ptr<const Tape> Model::derived(Formula formula) const {
  const Derivation* way = derivation_of(formula, *this);
  return way == nullptr ? nullptr : way->make(*this);
}

Tape damped_field(const Model& model) { return *derivations::damped_field(model); }

}  // namespace pfaff
