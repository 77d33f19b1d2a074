// Runs whose samples are kept, for tests that look at them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff::testing {

/// What a run leaves and its samples, in quad whatever the precision of the run is.
struct RecordWithSamples : RunRecord {
  std::vector<Sample<Quad>> samples;
};

class KeptSamples final : public SampleTaker {
 public:
  void begin(const MeasuredBeside& /*measured*/) override {}
  void take(const Sample<double>& sample) override {
    Sample<Quad>& kept = samples.emplace_back();
    kept.t = Quad(sample.t);
    kept.state.assign(sample.state.begin(), sample.state.end());
    kept.invariants.assign(sample.invariants.begin(), sample.invariants.end());
    kept.constraints.assign(sample.constraints.begin(), sample.constraints.end());
    if (sample.structure) kept.structure = Quad(*sample.structure);
    kept.error = sample.error;
    kept.invariant_errors = sample.invariant_errors;
  }
  void take(const Sample<Quad>& sample) override { samples.push_back(sample); }
  using SampleTaker::take;
  std::vector<Sample<Quad>> samples;
};

inline RecordWithSamples execute_and_keep(const ResolvedRun& run,
                                          const ReferenceSolution* reference = nullptr,
                                          const Progress& progress = {},
                                          const std::atomic<bool>* stop = nullptr) {
  KeptSamples kept;
  RunRecord record = execute(run, reference, progress, stop, &kept);
  return {std::move(record), std::move(kept.samples)};
}

/// The text of series.csv.
inline std::string series_csv(const ResolvedRun& run, const ReferenceSolution* reference = nullptr) {
  std::string text;
  SeriesWriter writer(run, [&](std::string_view rows) { text += rows; });
  (void)execute(run, reference, {}, nullptr, &writer);
  writer.finish();
  return text;
}

}  // namespace pfaff::testing
