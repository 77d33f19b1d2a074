// A matcher (Google Mock) with which the author of an evaluator of holonomic or velocity constraints tests
// it, in the tree or outside:
//
//   const auto constraints = model->holonomic_constraints<double>();
//   EXPECT_THAT(constraints.get(), pfaff::KeepsConstraintIdentities(model, pfaff::ConstraintSamples{}));
//
// with `model` a std::shared_ptr<const Model>. The matcher tries every operation at random points, always the
// same. A failure names the operations that do not do what they owe, and by how much.
#pragma once

#include <gmock/gmock.h>

#include <pfaff/core/facets/conformance/constraint_identities.hpp>
#include <pfaff/core/facets/conformance/velocity_identities.hpp>

namespace pfaff {

MATCHER_P2(KeepsConstraintIdentities, model, samples,
           negation ? "breaks an identity of constraints" : "keeps every identity of constraints") {
  bool kept = true;
  for (const ConstraintIdentity& identity : constraint_identities(*arg, *model, samples)) {
    if (identity.roundings <= samples.roundings) continue;
    *result_listener << (kept ? "" : "; ") << identity.operation << ": " << identity.roundings
                     << " units of round-off of its terms";
    kept = false;
  }
  return kept;
}

}  // namespace pfaff
