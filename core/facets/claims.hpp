// Claims: what a method may say that it keeps, each with its meaning and with the systems it speaks of. The
// rows are in claim_rows.hpp; a claim's check and its control are in verify/claim_checks.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// What a method may claim to keep. `none` is an explicit "no structure claimed" and has no row.
enum class Claim {
  none,
#define PFAFF_CLAIM(claim, ...) claim,
#include <pfaff/core/facets/claim_rows.hpp>
};

/// One row of the list.
struct ClaimRow {
  Claim claim;
  std::string_view name;     // kebab-case
  std::string_view meaning;  // a sentence
  std::string_view scope;    // the systems it speaks of, in words
};

namespace detail {
// The part of a row that follows its predicate.
struct ClaimTexts {
  std::string_view meaning, scope;
};
constexpr ClaimRow claim_row_of(Claim claim, std::string_view name, ClaimTexts texts) {
  return {claim, name, texts.meaning, texts.scope};
}
}  // namespace detail

/// Every claim but `none`, in the order of the list.
inline constexpr std::array claim_table{
#define PFAFF_CLAIM(claim, name, speaks_of, ...) \
  detail::claim_row_of(Claim::claim, name, detail::ClaimTexts{__VA_ARGS__}),
#include <pfaff/core/facets/claim_rows.hpp>
};

/// The row of a claim other than `none`.
constexpr const ClaimRow& claim_row(Claim claim) { return claim_table[static_cast<std::size_t>(claim) - 1]; }

/// The claim's name: "K-symplectic"; "none" for Claim::none.
constexpr std::string_view to_string(Claim claim) {
  return claim == Claim::none ? "none" : claim_row(claim).name;
}

/// True where the claim speaks of this model; never for Claim::none.
bool in_scope(Claim claim, const Model& model);

/// The claims that speak of this model; Claim::none alone where none of them does.
std::vector<Claim> claims_in_scope(const std::vector<Claim>& claims, const Model& model);

/// True where the system is canonical and the invariant of this index is conserved and has the form
/// p^T (D q + d) with constant D and d.
bool momentum_map(const Model& model, std::size_t invariant);

/// True where the system has velocity constraints and the invariant is a momentum map along directions that
/// they allow, A(q, t) (D q + d) = 0.
bool allowed_momentum_map(const Model& model, std::size_t invariant);

}  // namespace pfaff
