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

#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The gradients in the state of every output of a tape, in the scalar T: double, or eight of them.
template <class T>
class OutputGradients {
 public:
  explicit OutputGradients(const Tape& tape);

  /// One entry of a gradient that is not zero by construction.
  struct Entry {
    std::size_t output, input;
  };
  /// By output; their values at the last state are those of `values`, in the same order.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<T>& values(const T& t, const T* z);

 private:
  std::vector<Entry> entries_;
  std::optional<Replay<T>> replay_;
  std::vector<T> values_;
};

extern template class OutputGradients<double>;
extern template class OutputGradients<Pack<8>>;

/// Whether the gradients of a tape are taken: those of formulas of more than 100 000 operations are not,
/// because recording them would take longer than many a run.
inline bool takes_gradients(const Tape& tape) { return tape.code.size() <= 100000; }

/// The largest R of every output along a run.
class PropagatedRoundings {
 public:
  explicit PropagatedRoundings(const Tape& tape) : gradients_(tape), largest_(tape.outputs.size()) {}

  /// Takes eight states, one in every lane. What is not finite is left out.
  void add(const Pack<8>& t, const Pack<8>* z);

  /// For every output.
  [[nodiscard]] const std::vector<double>& largest() const { return largest_; }

 private:
  OutputGradients<Pack<8>> gradients_;
  std::vector<double> largest_;
};

}  // namespace pfaff
