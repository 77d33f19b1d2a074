// Runs of processed methods: they are looked at where states are kept, and pay for their processor there
// alone.
#include <gtest/gtest.h>

#include "run_settings.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::settings_of;

nlohmann::json run_of(const std::string& integrator, std::int64_t every) {
  RunSettings settings = settings_of("pendulum", "0.1", "100");
  settings.integrator = integrator;
  settings.every = every;
  const ResolvedRun run = resolve(settings);
  return summary(run, execute(run, nullptr));
}

TEST(ProcessedRuns, PayForTheProcessorWhereStatesAreKept) {
  const std::string table =
      std::string(PFAFF_GOLDEN) + "/../../examples/tables/verlet-as-processed-euler.toml";
  const auto forces = [](const nlohmann::json& j) {
    return j["counts"]["right_hand_sides"].get<std::int64_t>();
  };
  const nlohmann::json sparse = run_of(table, 50), dense = run_of(table, 1), verlet = run_of("verlet", 50);
  EXPECT_EQ(forces(sparse), 1000 + 20 * 2);
  EXPECT_EQ(forces(dense), 1000 * 3);
  EXPECT_EQ(forces(verlet), 1000);
  // The same map: the largest error among a thousand states and among twenty of them.
  const auto largest = [](const nlohmann::json& j) { return j["invariants"][0]["max"].get<double>(); };
  EXPECT_NEAR(largest(dense), largest(verlet), 1e-12);
  EXPECT_LE(largest(sparse), largest(dense) + 1e-12);
  EXPECT_GT(largest(sparse), 0);
}

}  // namespace
