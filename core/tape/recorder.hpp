// The recording scalar and the recorder that turns a templated formula into a Tape.
//
// Recording folds constants exactly (fractions stay fractions), drops additions of zero and multiplications
// by zero and one, shares common subexpressions, and keeps sine and cosine of one argument together.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/tape/instruction_index.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

class Recorder;

/// A number that records what is done with it. Plain constants belong to no recorder and fold immediately.
class Recorded {
 public:
  Recorded() = default;
  Recorded(int value) : constant_(value) {}  // NOLINT(google-explicit-constructor)
  explicit Recorded(const Real& value) : constant_(value) {}
  /// Refused, because a floating-point number would be cut to an int. The constants of a formula are ints and
  /// Reals.
  template <std::floating_point F>
  Recorded(F value) = delete;
  Recorded(Recorder* recorder, int slot) : recorder_(recorder), slot_(slot) {}

  [[nodiscard]] bool is_constant() const { return recorder_ == nullptr; }
  [[nodiscard]] const Real& constant() const { return constant_; }
  [[nodiscard]] Recorder* recorder() const { return recorder_; }
  [[nodiscard]] int slot() const { return slot_; }
  [[nodiscard]] bool is(int value) const { return is_constant() && constant_.is(value); }

  Recorded& operator+=(const Recorded& o) { return *this = *this + o; }
  Recorded& operator-=(const Recorded& o) { return *this = *this - o; }
  Recorded& operator*=(const Recorded& o) { return *this = *this * o; }
  Recorded& operator/=(const Recorded& o) { return *this = *this / o; }

  friend Recorded operator-(const Recorded& a);
  friend Recorded operator+(const Recorded& a, const Recorded& b);
  friend Recorded operator-(const Recorded& a, const Recorded& b);
  friend Recorded operator*(const Recorded& a, const Recorded& b);
  friend Recorded operator/(const Recorded& a, const Recorded& b);

 private:
  Recorder* recorder_ = nullptr;
  int slot_ = -1;
  Real constant_;
};

Recorded sqrt(const Recorded& x);
Recorded exp(const Recorded& x);
Recorded log(const Recorded& x);
Recorded sin(const Recorded& x);
Recorded cos(const Recorded& x);
/// x^y: small integer and half-integer powers become products and a square root.
Recorded pow(const Recorded& x, const Real& y);
Recorded pow(const Recorded& x, const Recorded& y);
Recorded select(const Recorded& condition, const Recorded& positive, const Recorded& otherwise);
inline bool structurally_zero(const Recorded& x) { return x.is(0); }

/// Solves the n x n system `matrix` (row-major) x = `right_hand_side`; a matrix with one entry in every row
/// and column becomes divisions, everything else one pivoted solve when the tape is replayed.
std::vector<Recorded> solve(std::span<const Recorded> matrix, std::span<const Recorded> right_hand_side);

/// Collects instructions; one recorder per tape.
class Recorder {
 public:
  explicit Recorder(int inputs);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  [[nodiscard]] Recorded time() { return {this, time_slot_}; }
  [[nodiscard]] std::vector<Recorded> inputs();

  /// The slot that holds x, recording a constant if need be.
  int slot_of(const Recorded& x);
  /// The slot of an instruction, shared with an equal earlier one.
  Recorded append(const Instruction& instruction);
  Recorded append_sine(int argument, bool cosine);
  std::vector<Recorded> append_solve(LinearSystem system);
  int constant_index(const Real& value);

  /// Removes what no output needs, orders by dependence and returns the tape.
  Tape finish(std::span<const Recorded> outputs);

 private:
  int inputs_;
  int time_slot_ = 0;
  std::vector<Instruction> code_;
  std::vector<Real> constants_;
  std::vector<LinearSystem> solves_;
  InstructionIndex known_;
};

/// Records formula(t, z, outputs) with `inputs` state variables and `outputs` results.
template <class Formula>
Tape record(int inputs, int outputs, Formula&& formula) {
  Recorder recorder(inputs);
  const std::vector<Recorded> z = recorder.inputs();
  std::vector<Recorded> results(static_cast<std::size_t>(outputs));
  formula(recorder.time(), In<Recorded>(z), Out<Recorded>(results));
  return recorder.finish(results);
}

}  // namespace pfaff
