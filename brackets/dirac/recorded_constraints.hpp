// What the algorithm of Dirac and Bergmann asks of constraints, as expressions on a tape: which of them,
// their rates d_t phi + {phi, H}, and their Poisson brackets. Gradients are exact, by the derivatives of
// tapes.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <pfaff/brackets/dirac/dirac_bergmann.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff::recorded_constraints {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

inline Recorded product(std::span<const Recorded> a, std::span<const Recorded> b) {
  Recorded sum(0);
  for (std::size_t k = 0; k < a.size(); ++k) sum = sum + a[k] * b[k];
  return sum;
}

/// The tape of two tapes' outputs, one after the other.
inline std::shared_ptr<const Tape> joined(const Tape& first, const Tape& second) {
  const auto count = static_cast<int>(first.outputs.size() + second.outputs.size());
  return std::make_shared<const Tape>(
      record(first.inputs, count, [&](const Recorded& t, Arguments z, Results out) {
        const auto a = evaluate(first, t, z), b = evaluate(second, t, z);
        std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), out.begin()));
      }));
}

/// Rates d_t phi + {phi, H} and brackets {phi_a, phi_m} with the primary constraints, as recorded
/// expressions.
struct Brackets {
  std::vector<Recorded> rates;    // K
  std::vector<Recorded> primary;  // K x primary
  std::vector<Recorded> all;      // K x K, instead of `primary` where `mutual` ones are asked for

  Brackets(const ConstrainedHamiltonian& system, const Tape& constraints, const Recorded& t, Arguments z,
           bool mutual) {
    const std::size_t n = z.size(), count = constraints.outputs.size();
    const std::size_t columns = mutual ? count : system.primary->outputs.size();
    const auto gradients = jacobian(constraints, t, z);
    const auto row = [&](std::size_t k) { return Arguments(gradients).subspan(k * n, n); };
    const auto sharp = [&](Arguments covector) {
      std::vector<Recorded> x(z.begin(), z.end());
      x.insert(x.end(), covector.begin(), covector.end());
      return evaluate(*system.sharp, t, x);
    };
    rates = time_derivative(constraints, t, z);
    const auto velocity = sharp(gradient(*system.hamiltonian, t, z, std::vector<Recorded>{Recorded(1)}));
    for (std::size_t a = 0; a < count; ++a) rates[a] = rates[a] + product(row(a), velocity);
    std::vector<Recorded>& brackets = mutual ? all : primary;
    brackets.resize(count * columns);
    for (std::size_t m = 0; m < columns; ++m) {
      const auto image = sharp(row(m));
      for (std::size_t a = 0; a < count; ++a) brackets[a * columns + m] = product(row(a), image);
    }
  }
};

/// The tape of the k-th output alone.
inline Tape only(const Tape& tape, std::size_t k) {
  return record(tape.inputs, 1,
                [&](const Recorded& t, Arguments z, Results out) { out[0] = evaluate(tape, t, z)[k]; });
}

}  // namespace pfaff::recorded_constraints
