// Quantities that a model follows besides those that its author states.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// One result of a tape, of the state or of its first coordinates alone.
struct FollowedQuantity {
  Invariant invariant;
  std::shared_ptr<const Tape> tape;
  std::size_t output;
};

/// Puts them behind the invariants that `source` has.
inline void follow(ModelSource& source, const std::vector<FollowedQuantity>& quantities) {
  if (quantities.empty()) return;
  for (const FollowedQuantity& one : quantities) source.invariants.push_back(one.invariant);
  std::shared_ptr<const Tape>& values = source.given[index(Formula::invariants)];
  values = std::make_shared<const Tape>(record(
      source.dimension, static_cast<int>(source.invariants.size()),
      [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        std::size_t k = 0;
        if (values != nullptr)
          for (const Recorded& x : evaluate(*values, t, z)) out[k++] = x;
        for (const FollowedQuantity& one : quantities)
          out[k++] = evaluate(*one.tape, t, z.first(static_cast<std::size_t>(one.tape->inputs)))[one.output];
      }));
}

}  // namespace pfaff
