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

// The first sample alone, the others in blocks of whose rows every one or every third is a sample.
std::vector<double> found_in_blocks(std::size_t planned, std::size_t samples, std::size_t apart) {
  EarlyExtents extents(planned);
  extents.add(state(0));
  constexpr std::size_t most = 256;
  for (std::size_t done = 1; done < samples;) {
    const std::size_t count = std::min(samples - done, (most - done % 5 + apart - 1) / apart);
    pfaff::Tiles<double> states(2, most + 5);
    const pfaff::ChosenRows rows{done % 5, count, apart};
    for (std::size_t k = 0; k < count; ++k) states.put(rows[k], state(done + k).data());
    extents.add(states, rows);
    done += count;
  }
  return extents.first_tenth();
}

TEST(EarlyExtents, DoNotDependOnHowSamplesCome) {
  for (const std::size_t planned : {100, 5000, 100001})
    for (const std::size_t samples : {7, 90, 1300, 5000})
      for (const std::size_t apart : {1, 3})
        EXPECT_EQ(found_in_blocks(planned, samples, apart), found(planned, samples))
            << planned << ' ' << samples << ' ' << apart;
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
