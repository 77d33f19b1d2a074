#include <pfaff/core/tape/polynomial_degree.hpp>

#include <algorithm>

namespace pfaff {

namespace {
using Degree = std::optional<int>;

Degree larger(const Degree& a, const Degree& b) { return a && b ? Degree(std::max(*a, *b)) : std::nullopt; }
// The degree of a function that is no polynomial of its argument.
Degree unless_constant(const Degree& argument) { return argument == 0 ? argument : std::nullopt; }

// The degree of the solution of a linear system whose matrix does not depend on the state.
Degree solved(const LinearSystem& system, const std::vector<Degree>& degrees) {
  Degree degree = 0;
  for (const int slot : system.right_hand_side)
    degree = larger(degree, degrees[static_cast<std::size_t>(slot)]);
  for (const int slot : system.matrix)
    if (degrees[static_cast<std::size_t>(slot)] != 0) return std::nullopt;
  return degree;
}

Degree of(const Instruction& code, const Tape& tape, const std::vector<Degree>& degrees) {
  const auto at = [&](int slot) { return degrees[static_cast<std::size_t>(slot)]; };
  switch (code.operation) {
    case Operation::constant:
    case Operation::time:
      return 0;
    case Operation::input:
      return 1;
    case Operation::negate:
      return at(code.a);
    case Operation::add:
    case Operation::subtract:
      return larger(at(code.a), at(code.b));
    case Operation::multiply:
      return at(code.a) && at(code.b) ? Degree(*at(code.a) + *at(code.b)) : std::nullopt;
    case Operation::divide:
      return at(code.b) == 0 ? at(code.a) : std::nullopt;
    case Operation::square_root:
    case Operation::exponential:
    case Operation::logarithm:
    case Operation::sine:
    case Operation::cosine:
    case Operation::special:
      return unless_constant(at(code.a));
    case Operation::power:
      for (int exponent = 0; exponent <= 8; ++exponent)
        if (at(code.a) && tape.constants[static_cast<std::size_t>(code.b)].is(exponent))
          return *at(code.a) * exponent;
      return unless_constant(at(code.a));
    case Operation::select:
      return unless_constant(larger(at(code.a), larger(at(code.b), at(code.c))));
    case Operation::solve:
    case Operation::solve_next:
      return solved(tape.solves[static_cast<std::size_t>(code.a)], degrees);
  }
  return std::nullopt;
}
}  // namespace

std::optional<int> polynomial_degree(const Tape& tape) {
  std::vector<Degree> degrees;
  for (const Instruction& code : tape.code) degrees.push_back(of(code, tape, degrees));
  Degree degree = 0;
  for (const int slot : tape.outputs) degree = larger(degree, degrees[static_cast<std::size_t>(slot)]);
  return degree;
}

}  // namespace pfaff
