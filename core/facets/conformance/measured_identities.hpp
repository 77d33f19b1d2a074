// How identities of evaluators are measured: what the conformance of holonomic and of velocity constraints
// shares. Each identity compares an operation with dense matrices in quad, in units of round-off.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// An identity, named after the operation that it speaks of, and how far it is from holding: the largest
/// difference between its two sides, by the sizes of their terms, in units of round-off.
struct ConstraintIdentity {
  std::string operation;
  double roundings = 0;
};

/// Where evaluators are sampled: states about the model's initial one, on and off the surface.
struct ConstraintSamples {
  double spread = 0.05;  // in every coordinate
  int points = 10;
  unsigned seed = 20041;
  /// The largest error allowed, in units of round-off: sums over a few hundred terms and eliminations lose
  /// that much.
  double roundings = 1e4;
};

namespace detail {

/// Keeps the largest error of each identity, by the name of the operation.
template <class T>
class MeasuredIdentities {
 public:
  [[nodiscard]] std::vector<ConstraintIdentity> worst() const { return worst_; }

 protected:
  void note(const std::string& operation, double roundings) {
    if (std::isnan(roundings)) roundings = INFINITY;
    for (ConstraintIdentity& identity : worst_)
      if (identity.operation == operation) {
        identity.roundings = std::max(identity.roundings, roundings);
        return;
      }
    worst_.push_back({operation, roundings});
  }

  static double magnitude(const auto& numbers) {
    double largest = 0;
    for (const auto& x : numbers) {
      const auto size = static_cast<double>(abs(Quad(x)));
      largest = std::isnan(size) ? size : std::max(largest, size);
    }
    return largest;
  }
  // The largest sum of the terms of a product.
  static double size_of(const Matrix<Quad>& m, const auto& x) {
    double largest = 0;
    for (std::size_t i = 0; i < m.rows(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < m.columns(); ++j) sum += static_cast<double>(abs(m(i, j) * Quad(x[j])));
      largest = std::max(largest, sum);
    }
    return largest;
  }
  void same(const std::string& operation, const auto& given, const std::vector<Quad>& expected,
            double size = 0, double condition = 1) {
    if (given.size() != expected.size()) return note(operation, INFINITY);
    double worst = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto difference = static_cast<double>(abs(Quad(given[i]) - expected[i]));
      worst = std::isnan(difference) ? INFINITY : std::max(worst, difference);
    }
    size = std::max({size, magnitude(expected), 1.0});
    note(operation, worst / (size * condition * static_cast<double>(unit_roundoff<T>())));
  }

  [[nodiscard]] std::vector<T> random(std::size_t size) {
    std::uniform_real_distribution<double> draw(-1, 1);
    std::vector<T> numbers;
    for (std::size_t k = 0; k < size; ++k) numbers.push_back(T(draw(random_)));
    return numbers;
  }
  static std::vector<Quad> quad(const std::vector<T>& x) { return {x.begin(), x.end()}; }

  // r = M u for a random u.
  template <class Apply>
  void map(const std::string& operation, const Matrix<Quad>& m, const Apply& apply) {
    const std::vector<T> u = random(m.columns());
    std::vector<T> r(m.rows());
    apply(u, r);
    same(operation, r, m * quad(u), size_of(m, u));
  }
  // M x = r, judged by the residual r - M x.
  void solved(const std::string& operation, const Matrix<Quad>& m, const std::vector<T>& x,
              const std::vector<T>& r) {
    same(operation, m * quad(x), quad(r), size_of(m, x));
  }

  // Entries of S outside its pattern are zero.
  void within(const SymmetricPattern& pattern, const Matrix<Quad>& s) {
    double outside = 0;
    for (std::size_t i = 0; i < s.rows(); ++i)
      for (std::size_t j = i + 1; j < s.rows(); ++j)
        if (pattern.coupling(i, j) == SymmetricPattern::npos)
          outside = std::max(outside, static_cast<double>(abs(s(i, j))));
    note("pattern", outside / static_cast<double>(unit_roundoff<T>()) / (1 + magnitude(s.entries())));
  }

 private:
  std::vector<ConstraintIdentity> worst_;
  std::mt19937_64 random_{7};
};

/// Every identity of a conformance, at its worst over samples about the initial state of `model`.
template <class T, class Conformance>
std::vector<ConstraintIdentity> worst_over(Conformance conformance, const Model& model,
                                           const ConstraintSamples& samples) {
  if (!conformance.sizes()) return conformance.worst();
  std::mt19937_64 random(samples.seed);
  std::uniform_real_distribution<double> offset(-samples.spread, samples.spread);
  const auto near_start = [&] {
    std::vector<T> z;
    for (const Real& x : model.initial()) z.push_back(T(x) + T(offset(random)));
    return z;
  };
  for (int k = 0; k < samples.points; ++k) {
    const T t(1 + offset(random));
    const std::vector<T> first = near_start(), second = near_start();
    conformance.at(t, first, second);
  }
  return conformance.worst();
}

}  // namespace detail

}  // namespace pfaff
