// Collocation of z' = X(z, t) as it is: the rates L_j = h b_j X(z + S_j, t + c_j h) are iterated,
//   S_i = sum_j mu_ij L_j,   z' = z + sum_j L_j,   mu_ij = a_ij / b_j.
//
// They are known to round-off and belong to the stages that they make (stage_iteration.hpp), coefficients
// keep symplecticity to the last bit (collocation_coefficients.hpp), and updates are compensated, sums over
// the stages included.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/runge_kutta/collocation_coefficients.hpp>
#include <pfaff/integrators/runge_kutta/collocation_form.hpp>
#include <pfaff/integrators/runge_kutta/formula_in_lanes.hpp>
#include <pfaff/integrators/runge_kutta/stage_iteration.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>

namespace pfaff {

/// Steps of first order on a problem of type P, which has a vector field. Its size and the number of stages
/// may be dynamic.
template <class P, int Stages, int Size = P::extent>
class FirstOrderForm final : public CollocationForm<P> {
 public:
  using T = Scalar<P>;
  using Number = Value<T>;

  FirstOrderForm(const CollocationCoefficients<Number>& c, const P& p)
      : iteration_(p.size(), c.stages, c.mu, c.extrapolation, true,
                   HasFieldJacobian<P> && prepares_newton(p)),
        counted_(iteration_.row_of(c.counted)),
        nodes_(iteration_.filled_row_of(c.nodes)),
        weights_(iteration_.row_of(c.scale)),
        times_(iteration_.blocks()),
        scales_(iteration_.blocks()),
        node_(c.stages),
        weight_(c.stages),
        scale_(c.stages),
        point_(p.make_state()),
        rate_(p.make_state()),
        carry_(p.make_state()),
        field_in_lanes_(p, c.stages),
        there_(p.size()),
        rates_(p.size()) {
    for (std::size_t i = 0; i < c.stages; ++i) {
      node_[i] = T(c.nodes[i]);
      weight_[i] = T(c.scale[i]);
    }
    if constexpr (HasFieldJacobian<P>)
      if (prepares_newton(p)) {
        p.prepare(Formula::field_jacobian);
        jacobian_.resize(p.size() * p.size());
      }
  }

  void restart() override {
    iteration_.forget();
    for (T& x : carry_) x = T(0);
  }
  void hand_over(CollocationForm<P>& next) override {
    std::swap(carry_, static_cast<FirstOrderForm&>(next).carry_);
  }

  Status step(const P& p, const T& t, const T& h, State<P>& z, bool compensated) override {
    begin(p, t, h, z);
    const auto evaluate = [&](const Table& stages) { evaluate_rates(p, t, h, z, stages); };
    Status status =
        iteration_.template solve<Field::inlined>(evaluate, on_constraints(p), p.counters().iterations);
    if constexpr (HasFieldJacobian<P>)
      status = this->or_by_newton(status, [&] {
        jacobian_.resize(p.size() * p.size());  // of a large system, at the first use
        p.field_jacobian(t + h / T(2), z, jacobian_);
        ++p.counters().factorisations;
        return iteration_.solve_by_newton(
            evaluate, jacobian_, scale_.data(), [&z](std::size_t k) { return z[k]; },
            [&](std::span<Value<T>> sizes) {
              rounded_.find(p.field_tape(), t + h / T(2), z);
              for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] = rounded_.over(h, k);
            },
            p.counters().iterations);
      });
    if (status != Status::converged) {
      iteration_.forget();
      return status;
    }
    for (std::size_t k = 0; k < iteration_.components(); ++k) {
      T change, lost;
      iteration_.total(counted_, k, change, lost);
      add_sum(z[k], carry_[k], change, lost, compensated);
    }
    return Status::converged;
  }

 private:
  using Iteration = StageIteration<T, Size, Stages>;
  using Lane = typename Iteration::Lane;
  using Table = typename Iteration::Table;
  using Field = FormulaInLanes<Formula::field, P, Lane>;
  using Point = Vector<Lane, Size>;

  // On a constraint surface some components may not change but for round-off, nor their derivatives. Judged
  // by themselves such components would never converge, so that all are judged together.
  static bool on_constraints(const P& p) {
    if constexpr (HasHolonomic<P> || HasVelocityConstraints<P>) return p.model()->restricted();
    return false;
  }

  // What the stages of a step start from. Where nothing is remembered, and after a change of step, the first
  // rates are all the present one.
  void begin(const P& p, const T& t, const T& h, const State<P>& z) {
    for (std::size_t i = 0; i < iteration_.stages(); ++i) scale_[i] = h * weight_[i];
    if (field_in_lanes_.offered())
      for (std::size_t b = 0; b < iteration_.blocks(); ++b) {
        times_[b] = Lane(t) + nodes_[b] * Lane(h);
        scales_[b] = Lane(h) * weights_[b];
      }
    if (value_of(h) != value_of(last_h_)) iteration_.forget();
    last_h_ = h;
    if (!iteration_.known()) {
      p.field(t, z, rate_);
      for (std::size_t k = 0; k < iteration_.components(); ++k)
        iteration_.begin_with(k, scale_.data(), rate_[k]);
    }
    for (std::size_t k = 0; k < iteration_.components(); ++k) {
      for (std::size_t b = 0; b < iteration_.blocks(); ++b) iteration_.line(k, b) = Lane(carry_[k]);
      // Rates far smaller than what they are added to need not be known to their own last digit.
      iteration_.small(k) = {};
      iteration_.small(k).add(z[k] / T(4096));
    }
  }

  void evaluate_rates(const P& p, const T& t, const T& h, const State<P>& z, const Table& stages) {
    if constexpr (Field::possible)
      if (field_in_lanes_.offered()) {
        if constexpr (Size == dynamic) {
          evaluate_in_lanes(p, z, stages, there_, rates_);
        } else {
          Point there, rates;
          evaluate_in_lanes(p, z, stages, there, rates);
        }
        p.counters().fields += static_cast<std::int64_t>(iteration_.stages());
        return;
      }
    for (std::size_t i = 0; i < iteration_.stages(); ++i) {
      for (std::size_t k = 0; k < iteration_.components(); ++k)
        point_[k] = z[k] + iteration_.stage(stages, i, k);
      p.field(t + node_[i] * h, point_, rate_);
      for (std::size_t k = 0; k < iteration_.components(); ++k)
        iteration_.set_rate(i, k, scale_[i] * rate_[k]);
    }
  }
  void evaluate_in_lanes(const P& p, const State<P>& z, const Table& stages, Point& there, Point& rates) {
    for (std::size_t b = 0; b < iteration_.blocks(); ++b) {
      for (std::size_t k = 0; k < iteration_.components(); ++k)
        there[k] = Lane(z[k]) + iteration_.stages_in(stages, b, k);
      field_in_lanes_(p, times_[b], In<Lane>(there), Out<Lane>(rates));
      for (std::size_t k = 0; k < iteration_.components(); ++k)
        iteration_.set_rates(b, k, scales_[b] * rates[k]);
    }
  }

  Iteration iteration_;
  typename Iteration::Row counted_, nodes_, weights_, times_, scales_;
  Vector<T, Stages> node_, weight_, scale_;
  State<P> point_, rate_, carry_;
  Field field_in_lanes_;
  Point there_, rates_;
  std::vector<T> jacobian_;
  RoundedRates<T> rounded_;
  T last_h_{0};
};

}  // namespace pfaff
