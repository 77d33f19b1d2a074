// The scale of an invariant in a run: the size of its terms, which stays where they cancel.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/runner/record.hpp>

#include "kept_samples.hpp"

namespace pfaff {
namespace {

testing::RecordWithSamples executed_by_gauss(const std::string& system,
                                             const std::vector<std::string>& initial,
                                             Precision precision = Precision::double_precision) {
  RunSettings settings;
  settings.system = system;
  settings.integrator = "gauss";
  settings.step = "0.125";
  settings.time = "4";
  settings.every = 1;
  settings.initial = initial;
  settings.precision = precision;
  return testing::execute_and_keep(resolve(settings), nullptr);
}

// E = p^2/2 - cos q of the pendulum through q = 1 with E = 0, or nearly so: with exact numbers in its state E
// has the terms p^2/2 = cos q, whose sum the scale is, up to the rounding of these few operations.
TEST(InvariantScale, IsTheSizeOfTermsThatCancel) {
  const testing::RecordWithSamples record = executed_by_gauss("pendulum", {"1", "1.0395"});
  double largest_terms = 0, largest_energy = 0;
  for (const Sample<Quad>& sample : record.samples) {
    const auto q = static_cast<double>(sample.state[0]), p = static_cast<double>(sample.state[1]);
    largest_terms = std::max(largest_terms, p * p / 2 + std::abs(std::cos(q)));
    largest_energy = std::max(largest_energy, std::abs(static_cast<double>(sample.invariants[0])));
  }
  ASSERT_EQ(record.invariants().round_off.size(), record.samples.front().invariants.size());
  EXPECT_LT(largest_energy, 1e-3);
  EXPECT_NEAR(record.invariants().round_off[0].scale, largest_terms, 1e-14 * largest_terms);
}

// The energy of a harmonic oscillator is homogeneous of degree two, and multiplying its state by a power of
// two rounds nothing: the scale of the run is multiplied by exactly the square.
TEST(InvariantScale, HasTheUnitOfTheInvariant) {
  const testing::RecordWithSamples one = executed_by_gauss("harmonic-oscillator", {"1", "0.5"});
  const testing::RecordWithSamples small =
      executed_by_gauss("harmonic-oscillator", {"0.0009765625", "0.00048828125"});  // 2^-10
  ASSERT_GT(one.invariants().round_off.at(0).scale, 0);
  EXPECT_EQ(small.invariants().round_off.at(0).scale,
            std::ldexp(one.invariants().round_off.at(0).scale, -20));
}

// In quad the same run has the same scale, since it is in units of the precision's own round-off.
TEST(InvariantScale, IsTheSameInBothPrecisions) {
  for (const char* system : {"pendulum", "kepler", "henon-heiles"}) {
    const testing::RecordWithSamples in_double = executed_by_gauss(system, {}),
                                     in_quad = executed_by_gauss(system, {}, Precision::quad);
    ASSERT_FALSE(in_double.invariants().round_off.empty());
    for (std::size_t i = 0; i < in_double.invariants().round_off.size(); ++i)
      EXPECT_NEAR(in_double.invariants().round_off[i].scale / in_quad.invariants().round_off[i].scale, 1,
                  1e-10)
          << system << " " << i;
  }
}

}  // namespace
}  // namespace pfaff
