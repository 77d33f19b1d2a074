// Sets of constraints phi_i(z, t) and their gradients, by hand or derived.
//
// A constraint set is any struct with count() and a template values(t, z, phi); it may write gradients(t, z,
// rows) too, K x n row-major, which is checked by check_gradients(). Without it, gradients come from dual
// numbers, and from the tape where formulas are recorded.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

/// C has constraints with scalar T.
template <class C, class T>
concept ConstraintSet = requires(const C& c, const T& t, In<T> z, Out<T> phi) {
  { c.count() } -> std::convertible_to<std::size_t>;
  c.values(t, z, phi);
};
template <class C, class T>
concept WritesGradients = requires(const C& c, const T& t, In<T> z, Out<T> rows) {
  c.gradients(t, z, rows);
};

/// Derives the gradients of a constraint set, with buffers of its own.
template <class C, class T>
class DerivedGradients {
 public:
  DerivedGradients(const C& constraints, std::size_t dimension)
      : point_(dimension), values_(constraints.count()) {}

  /// rows[i n + a] = d phi_i / d z_a.
  void operator()(const C& constraints, const T& t, In<T> z, Out<T> rows) {
    const std::size_t n = z.size();
    for (std::size_t first = 0; first < n; first += width) {
      for (std::size_t a = 0; a < n; ++a) {
        const bool varied = a >= first && a < first + width;
        point_[a] = varied ? D::variable(z[a], static_cast<int>(a - first)) : D(z[a]);
      }
      constraints.values(D(t), In<D>(point_), Out<D>(values_));
      for (std::size_t a = first; a < std::min(n, first + width); ++a)
        for (std::size_t i = 0; i < values_.size(); ++i) rows[i * n + a] = values_[i].derivative[a - first];
    }
  }

 private:
  static constexpr std::size_t width = 4;
  using D = Dual<T, static_cast<int>(width)>;
  std::vector<D> point_, values_;
};

/// On the tape: the Jacobian of the recorded constraints.
template <class C>
class DerivedGradients<C, Recorded> {
 public:
  DerivedGradients(const C& /*constraints*/, std::size_t /*dimension*/) {}
  void operator()(const C& constraints, const Recorded& t, In<Recorded> z, Out<Recorded> rows) {
    const Tape tape =
        record(static_cast<int>(z.size()), static_cast<int>(constraints.count()),
               [&](const Recorded& s, In<Recorded> x, Out<Recorded> phi) { constraints.values(s, x, phi); });
    const std::vector<Recorded> slopes = jacobian(tape, t, z);
    std::copy(slopes.begin(), slopes.end(), rows.begin());
  }
};

/// Compares gradients written by hand with derived ones at a point. InputError, naming the constraint and the
/// coordinate, where they differ by more than 1e-9 of the largest of the row: more than the rounding of any
/// formula that is not ill-conditioned there.
template <class C>
void check_gradients(const C& constraints, double t, std::span<const double> z,
                     const std::vector<std::string>& names) requires WritesGradients<C, double> {
  const std::size_t n = z.size(), count = constraints.count();
  std::vector<double> written(count * n), derived(count * n);
  constraints.gradients(t, In<double>(z), Out<double>(written));
  DerivedGradients<C, double>(constraints, n)(constraints, t, z, derived);
  for (std::size_t i = 0; i < count; ++i) {
    double largest = 0;
    for (std::size_t a = 0; a < n; ++a) largest = std::max(largest, abs(derived[i * n + a]));
    for (std::size_t a = 0; a < n; ++a)
      if (!(abs(written[i * n + a] - derived[i * n + a]) <= 1e-9 * largest))
        throw InputError("constraint " + names[i] + ": the gradient written for coordinate " +
                         std::to_string(a + 1) + " is " + formatted("%.9g", written[i * n + a]) +
                         "; expected " + formatted("%.9g", derived[i * n + a]) +
                         ", the derivative of the constraint");
  }
}

}  // namespace pfaff
