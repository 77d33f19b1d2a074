// What the compiler demands of the tables of facets, formulas and claims: one row for each enumerator, in
// their order, under a name of its own, and with nothing left out that its readers need. Rows and enumerators
// come from one list, but what a row leaves out is empty and not an error, and a new kind of row may be read
// by one of them alone.
//
// The tables themselves are checked in core/facets/claims.cpp.
#pragma once

#include <cstddef>
#include <string_view>

#include <pfaff/core/facets/claims.hpp>

namespace pfaff {

namespace detail {
template <class Rows>
constexpr bool named_apart(const Rows& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].name.empty()) return false;
    for (std::size_t j = 0; j < k; ++j)
      if (rows[j].name == rows[k].name) return false;
  }
  return true;
}
// Row k is that of enumerator k + first.
template <class Rows, class Enumerator>
constexpr bool in_order(const Rows& rows, Enumerator Rows::value_type::*member, std::size_t first) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (static_cast<std::size_t>(rows[k].*member) != k + first) return false;
  return true;
}
template <class Rows>
constexpr bool tell(const Rows& rows, std::string_view Rows::value_type::*text) {
  for (const auto& row : rows)
    if ((row.*text).empty()) return false;
  return true;
}
// The author's member is said of all formulas but those that are always derived.
template <class Rows>
constexpr bool tell_what_is_written(const Rows& rows) {
  for (const FormulaRow& row : rows)
    if (row.written.empty() != (row.origin == Origin::none)) return false;
  return true;
}
// Every formula serves a facet, but `reversal`, which is a symmetry of any motion.
template <class Rows>
constexpr bool serve_facets(const Rows& rows) {
  for (const FormulaRow& row : rows)
    if (row.formula != Formula::reversal && row.traits.offered_by.bits == 0 && row.traits.part_of.bits == 0)
      return false;
  return true;
}
// A facet with neither a formula nor an operation could neither be offered nor asked for.
template <class Rows>
constexpr bool serve_every_facet(const Rows& rows) {
  unsigned served = 0;
  for (const FormulaRow& row : rows) served |= row.traits.offered_by.bits | row.traits.part_of.bits;
  for (std::size_t k = 0; k < facet_table.size(); ++k)
    if (!facet_table[k].operation.empty()) served |= 1U << k;
  return served == FacetSet::all().bits;
}
}  // namespace detail

/// Does not compile for an incomplete table of facets.
template <const auto& rows>
struct CompleteFacets {
  static_assert(rows.size() == static_cast<std::size_t>(Facet::count), "facets: expected one row for each");
  static_assert(detail::named_apart(rows), "facets: expected a name of its own for each");
  static_assert(detail::tell(rows, &FacetRow::meaning), "facets: expected a meaning for each");
};

/// Does not compile for an incomplete table of formulas.
template <const auto& rows>
struct CompleteFormulas {
  static_assert(rows.size() == formula_count && detail::in_order(rows, &FormulaRow::formula, 0),
                "formulas: expected one row for each, in the order of the enumerators");
  static_assert(detail::named_apart(rows), "formulas: expected a name of its own for each");
  static_assert(detail::tell(rows, &FormulaRow::reads) && detail::tell(rows, &FormulaRow::writes),
                "formulas: expected the sizes of what each reads and writes");
  static_assert(detail::tell_what_is_written(rows),
                "formulas: expected the author's member for each that is not always derived");
  static_assert(detail::serve_facets(rows), "formulas: expected .offered_by or .part_of for each");
  static_assert(detail::serve_every_facet(rows), "formulas: expected one at least for each facet");
};

/// Does not compile for an incomplete table of claims, all but Claim::none.
template <const auto& rows>
struct CompleteClaims {
  static_assert(rows.size() == claim_table.size() && detail::in_order(rows, &ClaimRow::claim, 1),
                "claims: expected one row for each, in the order of the enumerators");
  static_assert(detail::named_apart(rows), "claims: expected a name of its own for each");
  static_assert(detail::tell(rows, &ClaimRow::meaning), "claims: expected .meaning for each");
  static_assert(detail::tell(rows, &ClaimRow::scope), "claims: expected .scope for each");
};

}  // namespace pfaff
