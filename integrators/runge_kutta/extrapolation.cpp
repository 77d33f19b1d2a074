// Extrapolation of the explicit midpoint rule in the square of the step (Gragg, Bulirsch and Stoer), of any
// order and in any precision: every number in it is a fraction.
//
// Over a step h from z at time t, the increments d_0 = 0, d_1 = s f(t, z), d_{m+1} = d_{m-1} + 2 s f(t + m s,
// z + d_m) with s = h/n and an even number n of substeps have an expansion in s^2. From n = 2, 4, ..., 2k the
// scheme of Aitken and Neville,
//     T_{j,i+1} = T_{j,i} + (T_{j,i} - T_{j-1,i}) / ((n_j / n_{j-i})^2 - 1),
// makes T_kk of order 2k (hairer-norsett-wanner1993, II.9, (9.10), without the smoothing step). Increments
// are extrapolated instead of states, so that what the weights amplify is the rounding of the increment
// alone.
//
// With a tolerance, step and number of columns are chosen together, by the work per unit of time that each
// number of columns is expected to take (the same, II.9, "order and step size control"). The error of a step
// is estimated by T_kk - T_{k,k-1}, and judged by the scales of the coordinates (core/facets/tolerance.hpp).
// Rows do not look at the ends of a step, where the field may have jumped: a step is taken only if they lead
// to the slopes there (slope_prediction.hpp). Where round-off leaves no step that is good enough the status
// says so. No structure is kept.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/runge_kutta/slope_prediction.hpp>

namespace {
using namespace pfaff;

constexpr std::size_t most_columns = 16;
// The weights of k columns amplify rounding by a factor of about 1.8^k, so that in double more columns than
// nine, which ODEX takes as the most too, do not pay.
template <class T>
constexpr int most_useful = std::is_same_v<T, double> ? 9 : static_cast<int>(most_columns);
// Steps are multiplied by 0.9 of what would halve the error allowed, and change by bounded factors.
constexpr double safety = 0.9, goal = 0.5, least_factor = 0.1, most_factor = 4;
constexpr int most_rejections = 100;
constexpr std::int64_t most_steps = 1000000000;

// Problems in double or quad, not in numbers with derivatives, from which no step size can be chosen.
template <class P>
concept HasPlainField = HasVectorField<P> && std::is_same_v<Scalar<P>, Value<Scalar<P>>>;

// Right-hand sides for so many columns: the first one serves all rows, and row j takes 2j - 1 more.
constexpr double cost(int columns) { return 1.0 + columns * columns; }

struct Extrapolation {
  int columns = 4;
  bool compensated = true;
  /// 1/((n_j/n_i)^2 - 1) of the rows j = 2, 3, ..., with i = 1, ..., j - 1 in each.
  std::array<Quad, most_columns*(most_columns - 1) / 2> weights = [] {
    std::array<Quad, most_columns*(most_columns - 1) / 2> w;
    std::size_t next = 0;
    for (int j = 2; j <= static_cast<int>(most_columns); ++j)
      for (int i = 1; i < j; ++i) w[next++] = Quad(i * i) / Quad(j * j - i * i);
    return w;
  }();

  static constexpr bool fixed_sizes = false;
  static std::vector<Parameter> parameters() {
    return {parameter(&Extrapolation::columns, "columns", "", 1, static_cast<int>(most_columns),
                      "columns k of steps of one size; the order is 2 k"),
            parameter(&Extrapolation::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list{{{"columns", "4"}}, {{"columns", "2"}}, {{"columns", "6"}}};
    if (full) list.push_back({{"columns", "1"}});
    return list;
  }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * columns; }
  std::span<Quad> coefficients() {
    const auto k = static_cast<std::size_t>(columns);
    return {weights.data(), k * (k - 1) / 2};
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::array<State<P>, most_columns> table;  // row by row, the newest diagonal
    State<P> rate, slope, point, older, newer, carry;
    State<P> end, end_carry, end_rate;  // of the step that is tried
    std::vector<T> weights;
    CoordinateScales<P> scales;
    SlopePrediction<P, most_columns> at_start, at_end;
    // What the choice of steps keeps from one step to the next and, for each number of columns, makes of one.
    T next_step{0};
    int target = 0;
    std::array<double, most_columns + 1> step_for{}, work_for{};

    Work(const Extrapolation& method, const P& p)
        : rate(p.make_state()),
          slope(p.make_state()),
          point(p.make_state()),
          older(p.make_state()),
          newer(p.make_state()),
          carry(p.make_state()),
          end(p.make_state()),
          end_carry(p.make_state()),
          end_rate(p.make_state()),
          scales(p),
          at_start(p),
          at_end(p) {
      for (State<P>& row : table) row = p.make_state();
      for (const Quad& x : method.weights) weights.push_back(T(Real(x)));
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.rate);
    for (int j = 1; j <= columns; ++j) add_row(p, t, h, z, w, j, [](int /*substep*/) {});
    add(w, z, w.carry);
    return Status::converged;
  }

  template <HasPlainField P>
  Status advance_to(const P& p, Scalar<P>& t, const Scalar<P>& end, const Tolerance<Scalar<P>>& tolerance,
                    State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!(tolerance.relative >= std::numeric_limits<T>::epsilon())) return Status::not_converged;
    Status failure = Status::not_converged;
    int rejections = 0;
    detail::AllowedSteps<P> steps(p);
    if (t != end) p.field(t, z, w.rate);
    for (std::int64_t taken = 0; t != end;) {
      if (rejections == 0 && steps.next(1) == 0) break;
      if (w.target == 0) begin(p, t, end, tolerance, z, w);
      const bool last = abs(end - t) <= w.next_step;
      const T after = last ? end : end < t ? t - w.next_step : t + w.next_step;
      const T h = after - t;  // what rounding leaves of the step
      if (h == T(0) || rejections > most_rejections || taken == most_steps) return failure;
      const int accepted = attempt(p, t, h, tolerance, z, w, failure);
      if (accepted == 0) {
        if (++rejections < rejections_in_doubt) w.scales.find_noise(p, t, z, w.rate);
        continue;
      }
      w.scales.keep();
      std::swap(z, w.end), std::swap(w.carry, w.end_carry), std::swap(w.rate, w.end_rate);
      t = after;
      choose_next(accepted, last, rejections > 0, w);
      failure = Status::not_converged;
      rejections = 0;
      ++taken;
      ++p.counters().steps;
    }
    return Status::converged;
  }

 private:
  // Adds the increment of a step to z.
  template <class P>
  void add(const Work<P>& w, State<P>& z, State<P>& carry) const {
    for (std::size_t k = 0; k < z.size(); ++k) add_to(z[k], carry[k], w.table[0][k], compensated);
  }

  // Row j of the table, j = 1, 2, ...: the increment with 2 j substeps, and what the rows before make of it.
  // Afterwards table[0] is T_jj and table[1] is T_{j,j-1}. `look` is called for each substep, with the slope
  // there.
  template <class P, class Look>
  static void add_row(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w,
                      int j, const Look& look) {
    using T = Scalar<P>;
    const T sub = h / T(2 * j), twice = T(2) * sub;
    for (std::size_t k = 0; k < z.size(); ++k) {
      w.older[k] = T(0);
      w.newer[k] = sub * w.rate[k];
    }
    for (int m = 1; m < 2 * j; ++m) {
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + w.newer[k];
      p.field(t + T(m) * sub, w.point, w.slope);
      look(m);
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T next = w.older[k] + twice * w.slope[k];
        w.older[k] = w.newer[k];
        w.newer[k] = next;
      }
    }
    const auto row = static_cast<std::size_t>(j - 1);
    for (std::size_t k = 0; k < z.size(); ++k) w.table[row][k] = w.newer[k];
    for (std::size_t i = row; i-- > 0;) {
      const T& weight = w.weights[row * (row - 1) / 2 + i];
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T& below = w.table[i + 1][k];
        w.table[i][k] = below + (below - w.table[i][k]) * weight;
      }
    }
  }

  // The first step, and about as many columns as the tolerance has digits for (hairer-norsett-wanner1993,
  // II.9).
  template <class P>
  static void begin(const P& p, const Scalar<P>& t, const Scalar<P>& end,
                    const Tolerance<Scalar<P>>& tolerance, const State<P>& z, Work<P>& w) {
    w.next_step = w.scales.first_step(p, tolerance, t, end, z, w.rate);
    const double digits = -std::log10(static_cast<double>(tolerance.relative));
    w.target = std::clamp(static_cast<int>(0.6 * digits + 1.5), 2, most_useful<Scalar<P>> - 1);
  }

  // The estimated error of a step of size h with the rows so far, relative to what is allowed; infinite where
  // it is not finite.
  template <class P>
  static double error_of(const Tolerance<Scalar<P>>& tolerance, const State<P>& z, const Scalar<P>& h,
                         Work<P>& w) {
    for (std::size_t k = 0; k < z.size(); ++k) {
      w.point[k] = z[k] + w.table[0][k];
      w.slope[k] = w.table[0][k] - w.table[1][k];
    }
    w.scales.find(tolerance, z, w.rate, h, w.point);
    return w.scales.judge(tolerance, w.slope);
  }

  // Whether a step with so many columns leads to the slopes at its ends; that at its second end is found
  // here.
  template <class P>
  bool leads_to_its_ends(const P& p, const Scalar<P>& t, const Scalar<P>& h, int columns_now,
                         const Tolerance<Scalar<P>>& tolerance, const State<P>& z, Work<P>& w) const {
    w.end = z, w.end_carry = w.carry;
    add(w, w.end, w.end_carry);
    p.field(t + h, w.end, w.end_rate);
    const auto scales = w.scales.get();
    return w.at_start.leads_to(w.rate, columns_now, h, tolerance.relative, scales) &&
           w.at_end.leads_to(w.end_rate, columns_now, h, tolerance.relative, scales);
  }

  // One step of size h, to the state w.end: the number of columns with which it is good enough, or 0, with
  // the size for the next attempt in next_step, and `failure` where it is not finite.
  template <class P>
  int attempt(const P& p, const Scalar<P>& t, const Scalar<P>& h, const Tolerance<Scalar<P>>& tolerance,
              const State<P>& z, Work<P>& w, Status& failure) const {
    using T = Scalar<P>;
    const double size = static_cast<double>(T(abs(h)));
    int j = 1;
    const auto add_next_row = [&] {
      add_row(p, t, h, z, w, j, [&](int substep) {
        if (substep == 1) w.at_start.take(j, w.slope);
        if (substep == 2 * j - 1) w.at_end.take(j, w.slope);
      });
    };
    add_next_row();
    while (j <= w.target) {
      ++j;
      add_next_row();
      const double error = error_of<P>(tolerance, z, h, w);
      if (!std::isfinite(error)) {
        failure = Status::non_finite;
        w.next_step = T(least_factor) * abs(h);
        return 0;
      }
      const double factor = safety * std::pow(goal / std::max(error, 1e-30), 1.0 / (2 * j - 1));
      const auto column = static_cast<std::size_t>(j);
      w.step_for[column] = size * std::clamp(factor, least_factor, most_factor);
      w.work_for[column] = cost(j) / w.step_for[column];
      if (j < w.target - 1) continue;
      if (error <= 1) {
        if (leads_to_its_ends(p, t, h, j, tolerance, z, w)) return j;
        failure = Status::not_converged;
        w.next_step = abs(h) / T(2);
        return 0;
      }
      // Each further row n divides the error by (n/n_1)^2 or so; where that will not do the step is given up.
      double hope = 1;
      for (int row = j + 1; row <= w.target + 1; ++row) hope *= static_cast<double>(row) * row;
      if (error > hope) break;
    }
    failure = Status::not_converged;
    w.target = std::min(w.target, j);
    const auto column = static_cast<std::size_t>(w.target);
    if (w.target > 2 && w.work_for[column - 1] < safety * w.work_for[column]) --w.target;
    w.next_step = T(std::min(w.step_for[static_cast<std::size_t>(w.target)], safety * size));
    return 0;
  }

  // Step and number of columns after a step that was good enough with so many columns. A step shortened to
  // reach the end says nothing about the next one, unless that could be longer; and none grows after a
  // rejection.
  template <class P>
  static void choose_next(int accepted, bool last, bool rejected, Work<P>& w) {
    using T = Scalar<P>;
    const auto j = static_cast<std::size_t>(accepted);
    int best = accepted;
    double next = w.step_for[j];
    if (accepted > 2 && w.work_for[j - 1] < 0.8 * w.work_for[j]) {
      best = accepted - 1;
      next = w.step_for[j - 1];
    } else if (!rejected && accepted < most_useful<T> - 1 &&
               (accepted == 2 || w.work_for[j] < 0.9 * w.work_for[j - 1])) {
      best = accepted + 1;
      next = w.step_for[j] * cost(best) / cost(accepted);
    }
    if (last && T(next) <= w.next_step) return;
    w.target = std::min(best, most_useful<T> - 1);
    w.next_step = rejected ? std::min(w.next_step, T(next)) : T(next);
  }
};

const Method<Extrapolation> registered{
    {.name = "extrapolation",
     .title = "extrapolation of the midpoint rule (Gragg, Bulirsch and Stoer), of any order",
     .family = "explicit",
     .reference = "hairer-norsett-wanner1993 II.9",
     .description =
         "Extrapolation of the explicit midpoint rule, of order 2 k with k columns, which with a tolerance "
         "chooses step and order itself, in double and in quad. Take it for smooth problems to high accuracy "
         "over short times, in quad to tolerances of 1e-30. It keeps no structure, and stiff decay bounds "
         "its "
         "steps.",
     .preserves = {Claim::none}}};
}  // namespace
