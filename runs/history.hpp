// Whether a method remembers earlier steps, as linear multistep methods do.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// A multistep method of k states begins with k - 1 steps of another method, which remember nothing. The
/// longest in use have 14 states.
inline constexpr std::int64_t longest_beginning = 15;

/// True where a step of size h depends on more than the state it starts from: a step taken after three
/// others, or after the longest beginning, differs by more than round-off from one that is taken from the
/// same state by a stepper that has forgotten them. The steps begin at z and time t, in quad. False where one
/// of them does not converge, or throws: then it is for the run to say so.
bool keeps_history(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad t, Quad h,
                   const std::vector<Quad>& z);

}  // namespace pfaff
