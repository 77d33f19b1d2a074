// The samples of a run while it goes, and series.csv, which is made of them.
#pragma once

#include <optional>
#include <vector>

#include <pfaff/bench/runner/row_writer.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/tile_rows.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// The run at one instant, in its scalar.
template <class T>
struct Sample {
  T t{};
  std::vector<T> state, invariants, constraints;  // `constraints`: the largest residual of each level
  std::optional<T> structure;                     // structure residual of one step from here
  std::optional<Quad> error;                      // relative to the reference solution's norm
  std::vector<Quad> invariant_errors;  // of those that are not conserved: I(z) less that of the reference
};

/// Samples at some rows of a block, of which nothing is measured beside.
template <class T>
struct SampleRows {
  const Block<T>& block;
  const Tiles<T>* invariants;  // at the rows of the block; null where the system has none
  ChosenRows rows;
};

/// What the samples of a run hold beside states, invariants and residuals of constraints; some of them.
struct MeasuredBeside {
  bool error = false, invariant_errors = false, structure = false;
};

/// Takes the samples of a run, each as soon as all of it is known.
class SampleTaker {
 public:
  virtual ~SampleTaker() = default;
  /// Called once, before the first sample; also where there is none.
  virtual void begin(const MeasuredBeside& measured) = 0;
  virtual void take(const Sample<double>& sample) = 0;
  virtual void take(const Sample<Quad>& sample) = 0;
  /// Many samples at once: the same as one after another.
  virtual void take(const SampleRows<double>& samples) { one_by_one(samples); }
  virtual void take(const SampleRows<Quad>& samples) { one_by_one(samples); }

 protected:
  template <class T>
  void one_by_one(const SampleRows<T>& samples) {
    Sample<T> sample;
    sample.state.resize(samples.block.states.components());
    sample.invariants.resize(samples.invariants == nullptr ? 0 : samples.invariants->components());
    for (std::size_t k = 0; k < samples.rows.count; ++k) {
      const std::size_t row = samples.rows[k];
      sample.t = samples.block.time(row);
      samples.block.states.get(row, sample.state);
      if (samples.invariants != nullptr) samples.invariants->get(row, sample.invariants);
      take(sample);
    }
  }
};

/// Writes samples as rows of series.csv.
class SeriesWriter final : public SampleTaker {
 public:
  SeriesWriter(const ResolvedRun& run, RowWriter::Destination destination);
  void begin(const MeasuredBeside& measured) override;
  void take(const Sample<double>& sample) override { row(sample); }
  void take(const Sample<Quad>& sample) override { row(sample); }
  using SampleTaker::take;
  /// Passes on what is not yet.
  void finish() { rows_.flush(); }

 private:
  template <class T>
  void row(const Sample<T>& sample);

  const Model& model_;
  MeasuredBeside measured_;
  std::size_t changing_ = 0;  // how many invariants are not conserved
  RowWriter rows_;
};

}  // namespace pfaff
