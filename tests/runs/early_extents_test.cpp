// The extents of the first tenth of a run, which is known only when the run has ended, against those of
// samples that are kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <pfaff/runs/support/early_extents.hpp>

namespace {
using pfaff::EarlyExtents;

// Two coordinates, one of which grows at every sample and one that comes back.
std::vector<double> state(std::size_t k) {
  return {-0.5 - static_cast<double>(k), std::sin(0.01 * static_cast<double>(k))};
}

std::vector<double> extents_of_first(std::size_t samples) {
  std::vector<double> extents(2);
  for (std::size_t k = 0; k < samples; ++k)
    for (std::size_t i = 0; i < 2; ++i) extents[i] = std::max(extents[i], std::abs(state(k)[i]));
  return extents;
}
std::vector<double> found(std::size_t planned, std::size_t samples) {
  EarlyExtents extents(planned);
  for (std::size_t k = 0; k < samples; ++k) extents.add(state(k));
  return extents.first_tenth();
}

TEST(EarlyExtents, OfRunsThatGoToTheirEnd) {
  for (const std::size_t samples : {1, 5, 79, 80, 1001, 12345, 100001})
    EXPECT_EQ(found(samples, samples),
              extents_of_first(std::min(samples, std::max<std::size_t>(8, samples / 10))))
        << samples;
}

// Those of as many samples as there are in a tenth, or of up to a 64th less.
TEST(EarlyExtents, OfRunsThatEndBefore) {
  for (const std::size_t samples : {3, 40, 800, 1279})
    EXPECT_EQ(found(100000, samples),
              extents_of_first(std::min(samples, std::max<std::size_t>(8, samples / 10))))
        << samples;
  for (const std::size_t samples : {20000, 50000, 99999}) {
    const double tenth = extents_of_first(samples / 10)[0], one = found(100000, samples)[0];
    EXPECT_LE(one, tenth) << samples;
    EXPECT_GE(one, tenth * 63 / 64 - 1) << samples;
  }
}

}  // namespace
