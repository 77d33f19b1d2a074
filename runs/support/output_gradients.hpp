// output_gradients: the gradients of all outputs of a tape at a state, and what follows from them about the
// size of errors: how much of the roundings of a state a quantity takes up.
//
// Every step rounds each coordinate z_i to u|z_i|, which changes a quantity I by up to u R,
//     R = sum_i |dI/dz_i z_i|;
// N steps that round independently change it by some sqrt(N) u R. R may be far below the sum of the
// magnitudes of the terms of I: a rest energy is rounded whenever I is evaluated, but no step rounds it anew.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The gradients in the state of every output of a tape.
class OutputGradients {
 public:
  explicit OutputGradients(const Tape& tape);

  /// Whether the gradients of a tape are taken: those of formulas of more than 100 000 operations are not,
  /// because recording them would take longer than many a run.
  static bool applies(const Tape& tape) { return tape.code.size() <= 100000; }

  /// One entry of a gradient that is not zero by construction.
  struct Entry {
    std::size_t output, input;
  };
  /// By output; their values at the last state are those of `values`, in the same order.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<double>& values(double t, const std::vector<double>& z);

 private:
  std::vector<Entry> entries_;
  std::optional<Replay<double>> replay_;
  std::vector<double> values_;
};

/// The largest R of every output along a run.
class PropagatedRoundings {
 public:
  explicit PropagatedRoundings(const Tape& tape) : gradients_(tape), largest_(tape.outputs.size()) {}

  /// Takes a state. What is not finite is left out.
  void add(double t, const std::vector<double>& z);

  /// For every output.
  [[nodiscard]] const std::vector<double>& largest() const { return largest_; }

 private:
  OutputGradients gradients_;
  std::vector<double> largest_;
};

}  // namespace pfaff
