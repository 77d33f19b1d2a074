// Taylor's method of any order: a step is the truncated power series of the solution, summed.
//
// The coefficients come from one pass over the tape of the field in truncated series
// (core/tape/taylor_expansion.hpp), whose cost grows with the square of the order, so that high orders pay
// where accuracy is asked for.
//
// With a tolerance e the order is chosen first, p = ceil(-ln(e) / 2 + 1), and then, at every step, the step
// (jorba-zou2005, 3.2),
//
//   h = rho e^{-2 - 0.7/(p-1)},
//
// at which the work per unit of time is least for that order; rho is the radius of convergence that the last
// degrees show. The terms left out are then about e times the scale in each coordinate
// (core/facets/tolerance.hpp). Where the last degrees vanish for a reason of their own, or say less than the
// truth, the defect of the series at the end of the step does not, and the step is shortened before it is
// taken (core/tape/taylor_steps.hpp). Where the solution runs into a singularity the steps shrink until they
// no longer move the time, and the status says so. No structure is kept.
//
// A series ends where the field has a kink (core/tape/kinks.hpp): there a step is made of two series, and a
// step that is chosen ends.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/tape/taylor_steps.hpp>

namespace {
using namespace pfaff;

constexpr int most_order = 64;
constexpr int most_kinks = 1000;  // of the field within a step
// Of a step: what goes so far and has not left a kink behind was not kept there by rounding.
constexpr double largest_repeated = 1e-3;
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
    std::optional<TaylorSteps<T>> adaptive;
    State<P> carry, rate;
    State<P> begin, carry_at_begin;  // of a step that meets a kink
    CoordinateScales<P> scales;
    std::vector<T> sizes;  // the scales for the step that is looked for
    T last_step{0};        // of a run with a tolerance

    Work(const Taylor& method, const P& p)
        : expansion(p.field_tape(), method.truncation),
          carry(p.make_state()),
          rate(p.make_state()),
          begin(p.make_state()),
          carry_at_begin(p.make_state()),
          scales(p),
          sizes(p.size()) {}
  };

  template <HasFieldTape P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    using V = Value<T>;
    T rest = h;
    std::optional<Kink<V>> last;
    V repeated(0);  // the length of the last piece, where that went through a kink once more
    for (int piece = 0; piece < most_kinks; ++piece) {
      p.counters().fields += truncation;
      w.expansion.expand(t + (h - rest), z.data());
      const auto kink = w.expansion.first_kink(value_of(rest));
      if (kink && piece == 0) w.begin = z, w.carry_at_begin = w.carry;
      T s = rest;
      V end = value_of(rest);
      if (kink) {
        repeated = kink->repeats(last) ? longer(*kink, repeated, value_of(rest), value_of(t)) : V(0);
        if (abs(repeated) > abs(value_of(h)) * V(largest_repeated)) break;
        end = repeated == V(0) ? kink->behind : repeated;
        s = w.expansion.time_of_kink(*kink, end);
      }
      for (std::size_t k = 0; k < z.size(); ++k)
        add_to(z[k], w.carry[k], w.expansion.increment(s, k), compensated);
      if (end == value_of(rest)) return Status::converged;
      last = kink;
      rest = rest - s;
    }
    z = w.begin, w.carry = w.carry_at_begin;
    return Status::not_converged;  // the motion stays at a kink
  }

  template <HasPlainFieldTape P>
  Status advance_to(const P& p, Scalar<P>& t, const Scalar<P>& end, const Tolerance<Scalar<P>>& tolerance,
                    State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!(tolerance.relative >= std::numeric_limits<T>::epsilon())) return Status::not_converged;
    const int degree =
        std::clamp(static_cast<int>(std::ceil(1 - std::log(static_cast<double>(tolerance.relative)) / 2)), 4,
                   most_order);
    if (!w.adaptive || w.adaptive->expansion().order() != static_cast<std::size_t>(degree))
      w.adaptive.emplace(p.field_tape(), degree, std::exp(-2 - 0.7 / (degree - 1)));
    TaylorSteps<T>& series = *w.adaptive;
    detail::AllowedSteps<P> steps(p);
    for (std::int64_t taken = 0; t != end; ++taken) {
      if (taken == most_taylor_steps) return Status::not_converged;
      if (steps.next(1) == 0) break;
      p.counters().fields += degree;
      if (!series.expand(t, z.data())) return Status::non_finite;
      const T longest = longest_step(p, tolerance, z, T(end - t), w);
      const T after = abs(end - t) <= abs(longest) ? end : t + longest;
      const T h = after - t;  // what rounding leaves of the step
      if (h == T(0)) return Status::not_converged;
      w.scales.find(tolerance, z, w.rate, h);
      w.scales.keep();
      w.last_step = abs(h);
      for (std::size_t k = 0; k < z.size(); ++k)
        add_to(z[k], w.carry[k], series.expansion().increment(h, k), compensated);
      t = after;
      ++p.counters().steps;
    }
    return Status::converged;
  }

 private:
  // A piece of a step that goes through a kink once more: rounding has left the state or the time on the near
  // side. Twice the last such piece, and at least what moves the time, leads on, up to the rest of the step.
  template <class V>
  static V longer(const Kink<V>& kink, const V& last, const V& rest, const V& t) {
    const V moving = V(4) * std::numeric_limits<V>::epsilon() * std::max(V(abs(t)), V(abs(rest)));
    const V length = std::max({V(abs(kink.behind)), V(V(2) * abs(last)), moving});
    return length < abs(rest) ? (rest < V(0) ? V(-length) : length) : rest;
  }

  // The step from z that the series allows, at most `limit` and in its direction. The scale of a coordinate
  // that begins at zero follows from the step, which at the start of a motion is therefore looked for twice.
  template <class P>
  static Scalar<P> longest_step(const P& p, const Tolerance<Scalar<P>>& tolerance, const State<P>& z,
                                const Scalar<P>& limit, Work<P>& w) {
    using T = Scalar<P>;
    const T* coefficients = w.adaptive->expansion().coefficients().data();
    for (std::size_t k = 0; k < p.size(); ++k) w.rate[k] = coefficients[p.size() + k];
    const auto at_scales_of = [&](const T& step) {
      w.scales.find(tolerance, z, w.rate, step);
      const auto scales = w.scales.get();
      std::copy(scales.begin(), scales.end(), w.sizes.begin());
      return w.adaptive->step(limit, tolerance.relative, w.sizes);
    };
    if (w.last_step == T(0)) w.last_step = abs(at_scales_of(T(0)));
    return at_scales_of(w.last_step);
  }
};

const Method<Taylor> registered{
    {.name = "taylor",
     .title = "Taylor series of the solution, of any order",
     .family = "explicit",
     .reference = "jorba-zou2005",
     .description =
         "The truncated power series of the solution itself, of any order up to 64, which with a tolerance "
         "chooses order and steps, in double and in quad. Take it for reference solutions and for smooth "
         "problems to high accuracy. It keeps no structure, and a step costs as many passes "
         "over the formulas as half the square of its order.",
     .preserves = {Claim::none}}};
}  // namespace
