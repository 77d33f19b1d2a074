// The facets, what a system may offer and what a method may need, and the formulas behind them.
//
// Both are made of the rows in core/facets/formula_rows.hpp, the only list: a facet or a formula is added
// there. Whoever runs through all of them (`describe`, messages, checks) uses facet_table and formula_table.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace pfaff {

enum class Facet : unsigned {
#define PFAFF_FACET(name, ...) name,
#include <pfaff/core/facets/formula_rows.hpp>
  count
};

/// A facet's name in the program's output, what it says of a system, and the member of an author's struct
/// that belongs to it and is no formula, where there is one.
struct FacetRow {
  std::string_view name, meaning, operation{};
};

inline constexpr std::array<FacetRow, static_cast<std::size_t>(Facet::count)> facet_table{{
#define PFAFF_FACET(name, ...) {__VA_ARGS__},
#include <pfaff/core/facets/formula_rows.hpp>
}};

constexpr std::string_view to_string(Facet facet) {
  return facet_table[static_cast<std::size_t>(facet)].name;
}

/// A set of facets; usable as a template argument.
struct FacetSet {
  unsigned bits = 0;

  static constexpr FacetSet all() { return {(1U << static_cast<unsigned>(Facet::count)) - 1U}; }
  [[nodiscard]] constexpr bool has(Facet f) const { return (bits >> static_cast<unsigned>(f) & 1U) != 0; }
  [[nodiscard]] constexpr FacetSet with(Facet f) const { return {bits | 1U << static_cast<unsigned>(f)}; }
  [[nodiscard]] constexpr FacetSet without(Facet f) const {
    return {bits & ~(1U << static_cast<unsigned>(f))};
  }
  [[nodiscard]] constexpr bool includes(FacetSet other) const { return (bits & other.bits) == other.bits; }
  /// True where one facet at least is in both.
  [[nodiscard]] constexpr bool meets(FacetSet other) const { return (bits & other.bits) != 0; }
  friend constexpr bool operator==(FacetSet, FacetSet) = default;
};

/// The set of these facets.
template <class... F>
constexpr FacetSet facets(F... each) {
  return {((1U << static_cast<unsigned>(each)) | ... | 0U)};
}

/// The facets' names joined by ", ".
std::string to_string(FacetSet set);

/// The formulas behind the facets. Each is a map (t, arguments) -> results.
enum class Formula : unsigned {
#define PFAFF_FORMULA(name, ...) name,
#define PFAFF_BRACKET(name, ...) name,
#define PFAFF_DERIVED(name, ...) name,
#include <pfaff/core/facets/formula_rows.hpp>
  count
};

constexpr std::size_t formula_count = static_cast<std::size_t>(Formula::count);
constexpr std::size_t index(Formula formula) { return static_cast<std::size_t>(formula); }

/// What an evaluation of a formula counts as in the work of a method.
enum class Counts { nothing, field, jacobian };

/// What is true of a formula beside its signature.
struct FormulaTraits {
  bool compiled = false;        // also kept compiled for doubles; its sizes must be made of n alone
  bool in_lanes = false;        // and for packs, in which the stages of a step are evaluated together
  bool may_skip_zeros = false;  // results that are zero need not be written
  bool listed = false;          // one result for each entry of the descriptor's list; written if it has any
  bool unique = true;           // what is written must equal what is derived
  FacetSet offered_by{};        // a problem has a member of this name where it offers one of these facets
  FacetSet part_of{};           // further facets that the formula belongs to, without such a member
  Counts counts = Counts::nothing;
};

/// Where a formula comes from, if it is not derived: a member of the author's struct, the object that one of
/// its members returns, or nowhere.
enum class Origin { member, bracket, none };

/// One formula. `written` is the author's member with its arguments, "field(t, z, rate)" or "bracket()";
/// empty for what is always derived. Sizes are text, made of n, invariants, casimirs and counts.
struct FormulaRow {
  Formula formula;
  Origin origin;
  std::string_view name, written, reads, writes;
  FormulaTraits traits;
};

inline constexpr std::array<FormulaRow, formula_count> formula_table{{
#define PFAFF_FORMULA(name, result, signature, call, reads, writes, ...) \
  {Formula::name, Origin::member, #name, #name #call, #reads, #writes, FormulaTraits{__VA_ARGS__}},
#define PFAFF_BRACKET(name, member, part, writes, ...) \
  {Formula::name, Origin::bracket, #name, #member "()", "n", #writes, FormulaTraits{__VA_ARGS__}},
#define PFAFF_DERIVED(name, reads, writes, ...) \
  {Formula::name, Origin::none, #name, "", #reads, #writes, FormulaTraits{__VA_ARGS__}},
#include <pfaff/core/facets/formula_rows.hpp>
}};

constexpr const FormulaRow& row_of(Formula formula) { return formula_table[index(formula)]; }
constexpr std::string_view to_string(Formula formula) { return row_of(formula).name; }

}  // namespace pfaff
