// Taylor's method of any order: a step is the truncated power series of the solution, summed.
//
// The coefficients come from one pass over the tape of the field in truncated series
// (core/tape/taylor_expansion.hpp), whose cost grows with the square of the order, so that high orders pay
// where accuracy is asked for.
//
// With a tolerance e the order is chosen first, p = ceil(-ln(e) / 2 + 1), and then, at every step, the step
// (jorba-zou2005, 3.2). The radius of convergence is seen from the last two coefficients, rho_m =
// min_k (s_k / |z_{m,k}|)^{1/m} for m = p - 1 and p, with the scale s_k of each coordinate
// (core/facets/tolerance.hpp). The step
//
//   h = min(rho_{p-1}, rho_p) e^{-2 - 0.7/(p-1)}
//
// is the one at which the work per unit of time is least for that order, and the terms left out are about e
// times the scale in each coordinate. No step is ever rejected. Where the solution runs into a singularity
// the steps shrink until they no longer move the time, and the status says so. No structure is kept.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>

namespace {
using namespace pfaff;

constexpr int most_order = 64;
constexpr std::int64_t most_taylor_steps = 1000000000;

template <class P>
concept HasFieldTape = HasVectorField<P> && requires(const P& p) {
  p.field_tape();
};
// Problems in double or quad, not in numbers with derivatives, from which no step size can be chosen.
template <class P>
concept HasPlainFieldTape = HasFieldTape<P> && std::is_same_v<Scalar<P>, Value<Scalar<P>>>;

struct Taylor {
  int truncation = 12;
  bool compensated = true;

  static constexpr bool fixed_sizes = false;
  static std::vector<Parameter> parameters() {
    return {parameter(&Taylor::truncation, "order", "", 1, most_order,
                      "degree of the series of a step of fixed size; a tolerance chooses its own"),
            parameter(&Taylor::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list{{{"order", "8"}}, {{"order", "3"}}};
    if (full) list.insert(list.end(), {{{"order", "1"}}, {{"order", "5"}}, {{"order", "12"}}});
    return list;
  }
  [[nodiscard]] int order(const Model& /*model*/) const { return truncation; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    TaylorExpansion<T> expansion;
    // Made when a tolerance is first given, since its degree follows from that.
    std::optional<TaylorExpansion<T>> adaptive;
    State<P> carry, rate;
    CoordinateScales<P> scales;
    double last_step = 0;  // of a run with a tolerance

    Work(const Taylor& method, const P& p)
        : expansion(p.field_tape(), method.truncation),
          carry(p.make_state()),
          rate(p.make_state()),
          scales(p) {}
  };

  template <HasFieldTape P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    ++p.counters().fields;
    w.expansion.expand(t, z.data());
    for (std::size_t k = 0; k < z.size(); ++k)
      add_to(z[k], w.carry[k], w.expansion.increment(h, k), compensated);
    return Status::converged;
  }

  template <HasPlainFieldTape P>
  Status advance_to(const P& p, Scalar<P>& t, const Scalar<P>& end, const Tolerance<Scalar<P>>& tolerance,
                    State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!(tolerance.relative >= std::numeric_limits<T>::epsilon())) return Status::not_converged;
    const int degree =
        std::clamp(static_cast<int>(std::ceil(1 - std::log(static_cast<double>(tolerance.relative)) / 2)), 4,
                   most_order);
    if (!w.adaptive || w.adaptive->order() != static_cast<std::size_t>(degree))
      w.adaptive.emplace(p.field_tape(), degree);
    TaylorExpansion<T>& expansion = *w.adaptive;
    detail::AllowedSteps<P> steps(p);
    for (std::int64_t taken = 0; t != end; ++taken) {
      if (taken == most_taylor_steps) return Status::not_converged;
      if (steps.next(1) == 0) break;
      ++p.counters().fields;
      expansion.expand(t, z.data());
      const double longest = longest_step(p, expansion, tolerance, z, T(abs(end - t)), w);
      if (!(longest > 0)) return Status::non_finite;
      const T after = abs(end - t) <= T(longest) ? end : end < t ? t - T(longest) : t + T(longest);
      const T h = after - t;  // what rounding leaves of the step
      if (h == T(0)) return Status::not_converged;
      w.scales.find(tolerance, z, w.rate, h);
      w.scales.keep();
      w.last_step = static_cast<double>(T(abs(h)));
      for (std::size_t k = 0; k < z.size(); ++k)
        add_to(z[k], w.carry[k], expansion.increment(h, k), compensated);
      t = after;
      ++p.counters().steps;
    }
    return Status::converged;
  }

 private:
  // The step from z that the series allows, at most `distance`. The scales of coordinates that begin at zero
  // follow from the step, and the step from its p-th root of them, so that a few rounds suffice.
  template <class P>
  static double longest_step(const P& p, const TaylorExpansion<Scalar<P>>& expansion,
                             const Tolerance<Scalar<P>>& tolerance, const State<P>& z,
                             const Scalar<P>& distance, Work<P>& w) {
    using T = Scalar<P>;
    const auto most = static_cast<double>(distance);
    const T* coefficients = expansion.coefficients().data();
    for (std::size_t k = 0; k < p.size(); ++k) w.rate[k] = coefficients[p.size() + k];
    double step = w.last_step;
    for (int round = 0; round < 3; ++round) {
      w.scales.find(tolerance, z, w.rate, T(step));
      step = step_of(expansion, w.scales.get());
      if (!(step < most)) step = most;
    }
    return step;
  }

  // The step that the last two coefficients allow beside the scales; 0 where they are not finite, and the
  // most there is where they vanish, since the solution then is a polynomial of a lower degree. A coordinate
  // without a scale, in a group in which nothing moves, says nothing.
  template <class T>
  static double step_of(const TaylorExpansion<T>& expansion, std::span<const T> scales) {
    for (const T& x : expansion.coefficients())  // since the largest of a degree says nothing of NaN
      if (!isfinite(x)) return 0;
    const std::size_t p = expansion.order(), n = scales.size();
    double radius = std::numeric_limits<double>::max();
    for (const std::size_t degree : {p - 1, p}) {
      T largest(0);
      for (std::size_t k = 0; k < n; ++k)
        if (scales[k] > T(0))
          largest = std::max(largest, T(abs(expansion.coefficients()[degree * n + k]) / scales[k]));
      // In logarithms, since the coefficients of a fast motion in quad are beyond the range of doubles.
      if (largest > T(0))
        radius = std::min(radius, std::exp(-static_cast<double>(log(largest)) / static_cast<double>(degree)));
    }
    return radius * std::exp(-2 - 0.7 / static_cast<double>(p - 1));
  }
};

const Method<Taylor> registered{
    {.name = "taylor",
     .title = "Taylor series of the solution, of any order",
     .reference = "jorba-zou2005",
     .description =
         "The truncated power series of the solution itself, of any order up to 64, which with a tolerance "
         "chooses order and steps, in double and in quad. Take it for reference solutions and for smooth "
         "problems to high accuracy. It keeps no structure, and a step costs as many passes "
         "over the formulas as half the square of its order.",
     .preserves = {Claim::none}}};
}  // namespace
