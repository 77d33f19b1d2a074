// Factoring and solving allocate no memory, on any structure, in any of the scalars that steps are computed
// with.
#include <gtest/gtest.h>

#include <pfaff/core/facets/scalars.hpp>

#include "../counted_allocations.hpp"
#include "structured_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

template <class T>
void nothing_is_allocated() {
  std::mt19937_64 random(81);
  for (const Sample& sample : samples(random)) {
    StructuredLDLT<T> symmetric(sample.pattern);
    StructuredLU<T> matrix(sample.pattern);
    const Entries e = Entries::positive(*sample.pattern, random);
    std::vector<T> x(sample.pattern->rows(), T(1)), y = x;
    Status status = Status::converged;
    const auto check = [&](Status s) {
      if (s != Status::converged) status = s;
    };
    EXPECT_EQ(allocations_of([&] {
                e.fill(symmetric);
                e.fill(matrix);
                check(symmetric.factor());
                symmetric.solve(x.data(), x.data());
                symmetric.solve(x.data(), x.data(), y.data(), y.data());
                check(symmetric.factor_semidefinite());
                check(symmetric.factor_and_solve(x.data(), x.data()));
                check(matrix.factor());
                matrix.solve(x.data(), x.data(), y.data(), y.data());
                check(matrix.factor_and_solve(x.data(), x.data()));
              }),
              0)
        << sample.name;
    EXPECT_EQ(status, Status::converged);
  }
  // Control: making one does.
  const auto pattern = std::make_shared<const SymmetricPattern>(SymmetricPattern::path(4));
  EXPECT_GT(allocations_of([&] { const StructuredLDLT<T> made(pattern); }), 0);
}
TEST(StructuredAllocation, NoneInDouble) { nothing_is_allocated<double>(); }
TEST(StructuredAllocation, NoneInQuad) { nothing_is_allocated<Quad>(); }
TEST(StructuredAllocation, NoneInDualsOrPacks) {
  nothing_is_allocated<StepDual<double>>();
  nothing_is_allocated<StepDual<Quad>>();
  nothing_is_allocated<Pack<4>>();
}

}  // namespace
