// Collocation of q' = M^-1 p, p' = f(q, t) as equations of second order, in Nystroem's form: with w = h p,
//   S_i = c_i w + sum_j nu_ij L_j,  L_j = h^2 b_j f(q + M^-1 S_j, t + c_j h),
//   q' = q + M^-1 (w + sum_j beta_j L_j),   w' = w + sum_j L_j.
//
// These are the steps of the Runge-Kutta method that the coefficients come from, with half the unknowns, and
// an iteration that contracts like h^2 instead of h. The kinetic energy has to be quadratic, which is seen on
// the tape of the velocity. Between steps the method goes on from w with its compensation and history; p is
// only computed from it. No product with h may be rounded in a step: rounding h p anew in every step would
// give the momenta, and with them the energy, an error with a bias. Where somebody has changed the state
// since the last step, w is computed from p and the past forgotten.
#pragma once

#include <type_traits>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/core/tape/linear.hpp>
#include <pfaff/integrators/runge_kutta/collocation_coefficients.hpp>
#include <pfaff/integrators/runge_kutta/collocation_form.hpp>
#include <pfaff/integrators/runge_kutta/formula_in_lanes.hpp>
#include <pfaff/integrators/runge_kutta/stage_iteration.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace pfaff {

/// The tape of the velocity dT/dp; null where the problem's energy is not separable.
template <class P>
std::shared_ptr<const Tape> separable_velocity(const P& p) {
  if constexpr (requires { p.velocity_tape(); }) {
    return p.velocity_tape();
  } else if constexpr (HasSeparable<P> && requires { p.model(); }) {
    if (p.model()->facets().has(Facet::separable)) return p.model()->tape(Formula::velocity);
  }
  return nullptr;
}

/// Nystroem steps on a problem of type P, which is separable. Its size and the number of stages may be
/// dynamic.
template <class P, int Stages, int Size = P::extent>
class NystromForm final : public CollocationForm<P> {
  static constexpr int half = Size == dynamic ? dynamic : Size / 2;

 public:
  using T = Scalar<P>;
  using Number = Value<T>;

  /// `velocity` is the tape of the velocity, which is linear.
  NystromForm(const CollocationCoefficients<Number>& c, const P& p, const Tape& velocity)
      : unit_mass_(identity(velocity)),
        degrees_(p.size() / 2),
        iteration_(degrees_, c.stages, c.nu, c.extrapolation, false,
                   HasFieldJacobian<P> && prepares_newton(p)),
        nodes_(iteration_.filled_row_of(c.nodes)),
        beta_(iteration_.row_of(c.beta)),
        counted_(iteration_.row_of(c.counted)),
        node_(c.stages),
        weight_(c.stages),
        scale_(c.stages),
        time_(c.stages),
        weights_(iteration_.row_of(c.scale)),
        scales_(iteration_.blocks()),
        times_(iteration_.blocks()),
        momentum_(degrees_),
        momentum_carry_(degrees_),
        position_carry_(degrees_),
        path_(degrees_),
        point_(degrees_),
        force_(degrees_),
        force_in_lanes_(p, c.stages),
        velocity_in_lanes_(p, c.stages),
        in_lanes_(force_in_lanes_.offered() && (unit_mass_ || velocity_in_lanes_.offered())),
        there_(degrees_),
        here_(degrees_),
        continuation_(p) {
    for (std::size_t i = 0; i < c.stages; ++i) {
      node_[i] = T(c.nodes[i]);
      weight_[i] = T(c.scale[i]);
    }
    p.prepare(Formula::force);
    if (!unit_mass_) p.prepare(Formula::velocity);
    if constexpr (HasFieldJacobian<P>)
      if (prepares_newton(p)) {
        p.prepare(Formula::field_jacobian);
        jacobian_.resize(4 * degrees_ * degrees_);
        slopes_.resize(degrees_ * degrees_);
      }
  }

  void restart() override { continuation_.forget(); }
  /// What sums round off belongs to w and to a step of one length: nothing is handed over.
  void hand_over(CollocationForm<P>& /*next*/) override {}

  Status step(const P& p, const T& t, const T& h, State<P>& z, bool compensated) override {
    begin(p, t, h, z);
    const auto evaluate = [&](const Table& stages) __attribute__((always_inline)) {
      evaluate_rates(p, z, stages);
    };
    Status status = iteration_.template solve<Force::inlined>(evaluate, false, p.counters().iterations);
    if constexpr (HasFieldJacobian<P>)
      status = this->or_by_newton(status, [&] { return correct_by_newton(p, t, h, z, evaluate); });
    if (status != Status::converged) {
      continuation_.forget();
      return status;
    }
    update(p, h, z, compensated);
    continuation_.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  using Iteration = StageIteration<T, half, Stages>;
  using Lane = typename Iteration::Lane;
  using Table = typename Iteration::Table;
  using Force = FormulaInLanes<Formula::force, P, Lane>;
  using Velocity = FormulaInLanes<Formula::velocity, P, Lane>;
  // Numbers of all components in lanes; on the way of an iteration they stay in registers where they are few.
  using Point = Vector<Lane, half>;

  [[nodiscard]] std::size_t degrees() const {
    return half == dynamic ? degrees_ : static_cast<std::size_t>(half);
  }

  void begin(const P& p, const T& t, const T& h, const State<P>& z) {
    const std::size_t m = degrees();
    if (in_lanes_)
      for (std::size_t b = 0; b < iteration_.blocks(); ++b) times_[b] = Lane(t) + nodes_[b] * Lane(h);
    if (!in_lanes_ || !unit_mass_)
      for (std::size_t i = 0; i < iteration_.stages(); ++i) time_[i] = t + node_[i] * h;
    if (!continuation_.holds(t, h, z)) {
      for (std::size_t i = 0; i < iteration_.stages(); ++i) scale_[i] = h * h * weight_[i];
      if (in_lanes_)
        for (std::size_t b = 0; b < iteration_.blocks(); ++b) scales_[b] = Lane(h * h) * weights_[b];
      for (std::size_t k = 0; k < m; ++k) {
        momentum_[k] = h * z[m + k];
        momentum_carry_[k] = position_carry_[k] = T(0);
      }
      iteration_.forget();
    }
    if (!iteration_.known()) {
      p.force(t, In<T>(z.data(), m), Out<T>(force_.data(), m));
      for (std::size_t k = 0; k < m; ++k) iteration_.begin_with(k, scale_.data(), force_[k]);
    }
    for (std::size_t k = 0; k < m; ++k) {
      const Lane fast(momentum_[k]), slow(momentum_carry_[k]), still(unit_mass_ ? position_carry_[k] : T(0));
      for (std::size_t b = 0; b < iteration_.blocks(); ++b)
        iteration_.line(k, b) = nodes_[b] * fast + (nodes_[b] * slow + still);
      // Rates far smaller than what they are added to need not be known to their own last digit.
      Sizes<T> small;
      small.add(momentum_[k] / T(64));
      if (unit_mass_) small.add(z[k] / T(4096));
      iteration_.small(k) = small;
    }
  }

  [[gnu::always_inline]] void evaluate_rates(const P& p, const State<P>& z, const Table& stages) {
    if constexpr (Force::possible && Velocity::possible) {
      if (in_lanes_) [[likely]] {
        if constexpr (half == dynamic) {
          evaluate_in_lanes(p, z, stages, there_, here_);
        } else {
          Point there, here;
          evaluate_in_lanes(p, z, stages, there, here);
        }
        p.counters().fields += static_cast<std::int64_t>(iteration_.stages());
        return;
      }
      if constexpr (!std::is_same_v<Table, Vector<Lane, dynamic>>) {
        // So that the stages themselves may stay in registers.
        const Table copy = stages;  // NOLINT(performance-unnecessary-copy-initialization)
        return evaluate_one_by_one(p, z, copy);
      }
    }
    evaluate_one_by_one(p, z, stages);
  }
  [[gnu::noinline]] void evaluate_one_by_one(const P& p, const State<P>& z, const Table& stages) {
    const std::size_t m = degrees();
    const Out<T> point(point_.data(), m), force(force_.data(), m), path(path_.data(), m);
    for (std::size_t i = 0; i < iteration_.stages(); ++i) {
      if (unit_mass_) {
        for (std::size_t k = 0; k < m; ++k) point_[k] = z[k] + iteration_.stage(stages, i, k);
      } else {
        for (std::size_t k = 0; k < m; ++k) force_[k] = iteration_.stage(stages, i, k);
        p.velocity(time_[i], force, path);
        for (std::size_t k = 0; k < m; ++k) point_[k] = z[k] + (path_[k] + position_carry_[k]);
      }
      p.force(time_[i], point, force);
      for (std::size_t k = 0; k < m; ++k) iteration_.set_rate(i, k, scale_[i] * force_[k]);
    }
  }

  [[gnu::always_inline]] void evaluate_in_lanes(const P& p, const State<P>& z, const Table& stages,
                                                Point& there, Point& here) {
    const std::size_t m = degrees();
    for (std::size_t b = 0; b < iteration_.blocks(); ++b) {
      if (unit_mass_) [[likely]] {
        for (std::size_t k = 0; k < m; ++k) there[k] = Lane(z[k]) + iteration_.stages_in(stages, b, k);
      } else {
        for (std::size_t k = 0; k < m; ++k) here[k] = iteration_.stages_in(stages, b, k);
        velocity_in_lanes_(p, times_[b], In<Lane>(here), Out<Lane>(there));
        for (std::size_t k = 0; k < m; ++k) there[k] = Lane(z[k]) + (there[k] + Lane(position_carry_[k]));
      }
      force_in_lanes_(p, times_[b], In<Lane>(there), Out<Lane>(here));
      for (std::size_t k = 0; k < m; ++k) iteration_.set_rates(b, k, scales_[b] * here[k]);
    }
  }

  template <class Evaluate>
  [[gnu::noinline]] Status correct_by_newton(const P& p, const T& t, const T& h, const State<P>& z,
                                             const Evaluate& evaluate) {
    const std::size_t m = degrees(), n = 2 * m;
    jacobian_.resize(n * n);  // of a large system, at the first use
    slopes_.resize(m * m);
    p.field_jacobian(t + h / T(2), z, Out<T>(jacobian_.data(), n * n));
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        T sum(0);  // of f_q M^-1
        for (std::size_t k = 0; k < m; ++k) sum = sum + jacobian_[(m + i) * n + k] * jacobian_[k * n + m + j];
        slopes_[i * m + j] = sum;
      }
    ++p.counters().factorisations;
    const auto size = [&](std::size_t k) { return unit_mass_ ? z[k] : momentum_[k]; };
    return iteration_.solve_by_newton(
        evaluate, slopes_, scale_.data(), size,
        [&](std::span<Value<T>> sizes) {
          rounded_.find(p.field_tape(), t + h / T(2), z);
          for (std::size_t k = 0; k < m; ++k) sizes[k] = rounded_.over(h * h, m + k);
        },
        p.counters().iterations);
  }

  void update(const P& p, const T& h, State<P>& z, bool compensated) {
    const std::size_t m = degrees();
    for (std::size_t k = 0; k < m; ++k) {
      T kick, kick_lost, path, path_lost, whole, lost;
      iteration_.total(beta_, k, path, path_lost);
      two_sum(momentum_[k], path, whole, lost);
      lost = lost + (path_lost + momentum_carry_[k]);
      if (unit_mass_) {
        add_sum(z[k], position_carry_[k], whole, lost, compensated);
      } else {
        path_[k] = whole + lost;
      }
      iteration_.total(counted_, k, kick, kick_lost);
      add_sum(momentum_[k], momentum_carry_[k], kick, kick_lost, compensated);
      z[m + k] = momentum_[k] / h;
    }
    if (unit_mass_) return;
    p.velocity(time_[0], In<T>(path_.data(), m), Out<T>(force_.data(), m));
    for (std::size_t k = 0; k < m; ++k) add_to(z[k], position_carry_[k], force_[k], compensated);
  }

  bool unit_mass_;
  std::size_t degrees_;
  Iteration iteration_;
  typename Iteration::Row nodes_, beta_, counted_;
  Vector<T, Stages> node_, weight_, scale_, time_;
  typename Iteration::Row weights_, scales_, times_;            // the same in lanes
  Vector<T, half> momentum_, momentum_carry_, position_carry_;  // w = h p and what sums have rounded off
  Vector<T, half> path_, point_, force_;
  Force force_in_lanes_;
  Velocity velocity_in_lanes_;
  bool in_lanes_;
  Point there_, here_;
  std::vector<T> jacobian_, slopes_;
  RoundedRates<T> rounded_;
  Continuation<P> continuation_;
};

}  // namespace pfaff
