// The order in which the recursion, nguyen-turski (3.15), takes the constraints, two at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/derive/derivation/symbolic_formulas.hpp>

namespace pfaff {

/// The places of the named constraints in Model::constraint_names(); empty for no names. InputError for names
/// that are not all of these, each once, and for an order in which a pivot {a, b}_D vanishes at a generic
/// point, and so everywhere; the message has an order that works.
std::vector<std::size_t> elimination_order(const std::shared_ptr<const HolonomicTapes>& tapes,
                                           const SymbolicFormulas& source, const Model& model,
                                           const std::vector<std::string>& names);

}  // namespace pfaff
