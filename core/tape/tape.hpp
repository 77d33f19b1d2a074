// Tape: a formula as straight-line code in single-assignment form.
//
// A formula (t, z) -> outputs is recorded once (recorder.hpp) and replayed with any scalar: doubles, quads,
// duals (replay.hpp), truncated series (series.hpp), or the recording scalar itself, which is how formulas
// are composed and differentiated (derivatives.hpp). Instruction k writes slot k. Instructions are ordered so
// that constants come first, then what depends on time alone, then what depends on the state: a replay at an
// unchanged time starts at `state_begin`.
#pragma once

#include <cstdint>
#include <vector>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

enum class Operation : std::uint8_t {
  constant,     // constants[a]
  time,         // t
  input,        // z[a]
  negate,       // -a
  add,          // a + b
  subtract,     // a - b
  multiply,     // a * b
  divide,       // a / b
  square_root,  // sqrt a
  exponential,  // exp a
  logarithm,    // log a
  sine,         // sin a; the next instruction is the cosine of the same argument
  cosine,       // cos a, written together with the sine before it
  power,        // a ^ constants[b]
  special,      // SpecialFunction(c) of a, whose derivative at a is b
  select,       // b where a > 0, else c
  solve,        // first component of the solution of linear system solves[a]
  solve_next    // its further components, written together with the first
};

/// One instruction; a, b, c are slots, or indices as the operation says.
struct Instruction {
  Operation operation;
  int a = 0, b = 0, c = 0;
  friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// A dense linear system whose matrix (row-major) and right-hand side are slots. It is pivoted when it is
/// solved.
struct LinearSystem {
  int size = 0;
  std::vector<int> matrix;
  std::vector<int> right_hand_side;
};

/// Straight-line code of a formula of time and `inputs` state variables.
struct Tape {
  int inputs = 0;
  std::vector<Instruction> code;
  std::vector<Real> constants;
  std::vector<LinearSystem> solves;
  std::vector<int> outputs;  // slots
  int time_begin = 0;        // code[0, time_begin): constants
  int state_begin = 0;       // code[time_begin, state_begin): functions of time alone

  /// True when no output depends on time.
  [[nodiscard]] bool autonomous() const;
  /// True when no output depends on the state.
  [[nodiscard]] bool state_independent() const;
  /// True when every output is the constant 0, as it was written or folded.
  [[nodiscard]] bool zero() const;
};

}  // namespace pfaff
