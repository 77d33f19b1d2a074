// The operations that simplified expressions are left with, and how operations are counted.
#include <gtest/gtest.h>

#include <pfaff/derive/derivation/derivation.hpp>
#include <pfaff/derive/derivation/scaled.hpp>

namespace {

using namespace pfaff;

// What the scaled numbers take out of expressions, each in as many operations as are left.
TEST(Scaled, TakesFactorsOut) {
  const auto count = [](auto&& formula) {
    Recorder recorder(3);
    const std::vector<Recorded> z = recorder.inputs();
    return operations(simplified(recorder.finish(std::vector<Recorded>{formula(z[0], z[1], z[2])})));
  };
  const auto negated = [](const Recorded& x) { return Recorded(-1) * x; };
  EXPECT_EQ(count([&](auto& x, auto&, auto&) { return negated(negated(x)); }), 0U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return x * y + negated(x) * y; }), 0U);
  EXPECT_EQ(count([&](auto& x, auto&, auto&) { return x / 2 + x / 2; }), 0U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return negated(x) * negated(y); }), 1U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return x + negated(y); }), 1U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return (x - y) * (y - x); }), 3U);  // a square with its sign
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return y * (x * (Recorded(1) / x)); }), 0U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return x / y - x / y; }), 0U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto& z) { return (x + y) * z - (y + x) * z; }), 0U);
  EXPECT_EQ(count([&](auto& x, auto&, auto&) { return sin(negated(x)) + sin(x); }), 0U);
  EXPECT_EQ(count([&](auto& x, auto&, auto&) { return cos(negated(x)) - cos(x); }), 0U);
  EXPECT_EQ(count([&](auto& x, auto&, auto&) { return x - x; }), 0U);
  // What is not equal stays.
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return x * y + x / y; }), 3U);
  EXPECT_EQ(count([&](auto& x, auto& y, auto&) { return x - 3 * y; }), 2U);
}

// Without sharing, (x^2)^2 is seven products of eight leaves.
TEST(Counts, TreesShareNothing) {
  const Tape tape = record(1, 1, [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
    Recorded x = z[0];
    for (int k = 0; k < 3; ++k) x = x * x;
    out[0] = x;
  });
  EXPECT_EQ(operations(tape), 3U);
  EXPECT_EQ(tree_operations(tape), 7);
}

}  // namespace
