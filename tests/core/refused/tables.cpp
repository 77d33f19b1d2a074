// Tables of facets, formulas and claims with an omission, which the compiler must refuse. Each comment
// `refused:` is the beginning of a message it must give.
#include <pfaff/core/facets/complete_tables.hpp>

namespace {
using namespace pfaff;

// The table with one change.
template <class Rows, class Change>
constexpr Rows changed(Rows rows, Change change) {
  change(rows);
  return rows;
}
// Without its last row.
template <class Row, std::size_t count>
constexpr std::array<Row, count - 1> without_last(const std::array<Row, count>& rows) {
  std::array<Row, count - 1> fewer{};
  for (std::size_t k = 0; k + 1 < count; ++k) fewer[k] = rows[k];
  return fewer;
}

// refused: facets: expected one row for each
constexpr auto one_facet_less = without_last(facet_table);
// refused: facets: expected a name of its own for each
constexpr auto same_facets = changed(facet_table, [](auto& rows) { rows[1].name = rows[0].name; });
// refused: facets: expected a meaning for each
constexpr auto facet_without_meaning = changed(facet_table, [](auto& rows) { rows.back().meaning = {}; });

// refused: formulas: expected one row for each, in the order of the enumerators
constexpr auto one_formula_less = without_last(formula_table);
constexpr auto formulas_out_of_order = changed(formula_table, [](auto& rows) {
  const FormulaRow first = rows[0];
  rows[0] = rows[1];
  rows[1] = first;
});
// refused: formulas: expected a name of its own for each
constexpr auto formula_without_name = changed(formula_table, [](auto& rows) { rows[2].name = {}; });
// refused: formulas: expected the sizes of what each reads and writes
constexpr auto formula_without_size = changed(formula_table, [](auto& rows) { rows[0].writes = {}; });
// refused: formulas: expected the author's member for each that is not always derived
constexpr auto formula_without_member = changed(formula_table, [](auto& rows) { rows[0].written = {}; });
// refused: formulas: expected .offered_by or .part_of for each
constexpr auto formula_of_no_facet = changed(formula_table, [](auto& rows) { rows[0].traits = {}; });
// refused: formulas: expected one at least for each facet
constexpr auto facet_of_no_formula = changed(formula_table, [](auto& rows) {
  for (FormulaRow& row : rows) row.traits.part_of = row.traits.part_of.without(Facet::metriplectic);
});

// refused: claims: expected one row for each, in the order of the enumerators
constexpr auto one_claim_less = without_last(claim_table);
// refused: claims: expected a name of its own for each
constexpr auto same_claims = changed(claim_table, [](auto& rows) { rows[1].name = rows[0].name; });
// refused: claims: expected .meaning for each
constexpr auto claim_without_meaning = changed(claim_table, [](auto& rows) { rows[3].meaning = {}; });
// refused: claims: expected .scope for each
constexpr auto claim_without_scope = changed(claim_table, [](auto& rows) { rows[3].scope = {}; });
}  // namespace

template struct pfaff::CompleteFacets<one_facet_less>;
template struct pfaff::CompleteFacets<same_facets>;
template struct pfaff::CompleteFacets<facet_without_meaning>;
template struct pfaff::CompleteFormulas<one_formula_less>;
template struct pfaff::CompleteFormulas<formulas_out_of_order>;
template struct pfaff::CompleteFormulas<formula_without_name>;
template struct pfaff::CompleteFormulas<formula_without_size>;
template struct pfaff::CompleteFormulas<formula_without_member>;
template struct pfaff::CompleteFormulas<formula_of_no_facet>;
template struct pfaff::CompleteFormulas<facet_of_no_formula>;
template struct pfaff::CompleteClaims<one_claim_less>;
template struct pfaff::CompleteClaims<same_claims>;
template struct pfaff::CompleteClaims<claim_without_meaning>;
template struct pfaff::CompleteClaims<claim_without_scope>;
