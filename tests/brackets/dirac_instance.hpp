// Random instances for the solvers of the Dirac bracket: a tensor, gradients of constraints and a covector in
// small integers, so that they are the same in every scalar. Fixed seeds.
#pragma once

#include <pfaff/brackets/dirac/dirac.hpp>

#include "random_gram.hpp"

namespace pfaff::testing {

/// DiracData with its numbers.
template <class T>
struct DiracInstance {
  std::size_t n, count;
  Symmetry symmetry;
  std::vector<T> tensor, gradients, covector, sharps, gram, vector, brackets;

  [[nodiscard]] DiracData<T> data() const {
    return {n, count, symmetry, gradients, sharps, gram, covector, vector, brackets, tensor};
  }
};

/// The numbers that follow from the tensor, the gradients and the covector.
template <class T>
void complete(DiracInstance<T>& d) {
  const std::size_t n = d.n;
  d.sharps.assign(d.count * n, T(0));
  d.gram.assign(d.count * d.count, T(0));
  d.vector.assign(n, T(0));
  d.brackets.assign(d.count, T(0));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      d.vector[a] = d.vector[a] + d.tensor[a * n + b] * d.covector[b];
      for (std::size_t i = 0; i < d.count; ++i)
        d.sharps[i * n + a] = d.sharps[i * n + a] + d.tensor[a * n + b] * d.gradients[i * n + b];
    }
  for (std::size_t i = 0; i < d.count; ++i)
    for (std::size_t a = 0; a < n; ++a) {
      d.brackets[i] = d.brackets[i] + d.gradients[i * n + a] * d.vector[a];
      for (std::size_t j = 0; j < d.count; ++j)
        d.gram[i * d.count + j] = d.gram[i * d.count + j] + d.gradients[i * n + a] * d.sharps[j * n + a];
    }
}

/// The same instance in another scalar; everything but the first three is computed in it.
template <class T>
DiracInstance<T> in_scalar(const DiracInstance<Rational>& exact) {
  DiracInstance<T> d{exact.n, exact.count, exact.symmetry, {}, {}, {}, {}, {}, {}, {}};
  for (const Rational& x : exact.tensor) d.tensor.push_back(as<T>(x));
  for (const Rational& x : exact.gradients) d.gradients.push_back(as<T>(x));
  for (const Rational& x : exact.covector) d.covector.push_back(as<T>(x));
  complete(d);
  return d;
}

/// K from 2 to 12 (even for skew brackets), up to 20 coordinates, W regular.
inline DiracInstance<Rational> random_instance(unsigned seed) {
  std::mt19937 random(seed);
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  for (;;) {
    DiracInstance<Rational> d{};
    d.symmetry = static_cast<Symmetry>(seed % 3);
    d.count = static_cast<std::size_t>(d.symmetry == Symmetry::skew ? 2 * integer(1, 6) : integer(2, 12));
    d.n = static_cast<std::size_t>(integer(static_cast<int>(d.count), 20));
    const std::size_t n = d.n;
    d.tensor.resize(n * n);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a; b < n; ++b) {
        const int x = integer(-3, 3);
        d.tensor[a * n + b] = Rational(a == b && d.symmetry == Symmetry::skew ? 0 : x);
        d.tensor[b * n + a] = Rational(d.symmetry == Symmetry::none   ? integer(-3, 3)
                                       : d.symmetry == Symmetry::skew ? (a == b ? 0 : -x)
                                                                      : x);
      }
    for (std::size_t k = 0; k < d.count * n; ++k) d.gradients.emplace_back(integer(-3, 3));
    for (std::size_t a = 0; a < n; ++a) d.covector.emplace_back(integer(-3, 3));
    complete(d);
    if (determinant(Matrix<Rational>(d.count, d.gram)) != Rational(0)) return d;
  }
}

/// sharp_D(covector) by one solver.
template <class T, class Solver>
std::vector<T> solved(const DiracInstance<T>& d, const Solver& solver, Status& status) {
  typename Solver::template Work<T> work(solver, d.n, d.count);
  std::vector<T> result(d.n);
  status = solver.template operator()<T>(d.data(), result, work);
  return result;
}

}  // namespace pfaff::testing
