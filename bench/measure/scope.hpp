// The scope of a claim: the systems it speaks of. Outside it nothing is claimed, whatever the method says of
// itself.
#pragma once

#include <vector>

#include <pfaff/core/integrator.hpp>

namespace pfaff {

/// Does the claim speak of this model? `symmetric` of every one; `symplectic` of those whose own structure is
/// the canonical one; `K-symplectic` of those with a Darboux chart or an alpha; `quadratic-invariants` of
/// those that have one; `constrained-symplectic` and `constraints` of those with holonomic constraints;
/// `momentum-maps` of those with a momentum map.
bool in_scope(Claim claim, const Model& model);

/// Is the invariant of this index linear in p and in q, p^T (D q + d), and the system canonical?
bool momentum_map(const Model& model, std::size_t invariant);

/// What the method claims on this model; `none` where that is nothing.
std::vector<Claim> claims_in_scope(const MethodInstance& method, const Model& model);

}  // namespace pfaff
