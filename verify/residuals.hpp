// Residuals of identities, recorded as tapes and evaluated at random points drawn with a fixed seed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/stated_identities.hpp>
#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

// States near the first centre of a region, near each of the others, and in its box.
inline constexpr int points = 20, far_points = 4, box_points = 80;

inline Check named(const std::string& plugin, const std::string& claim, const std::string& system,
                   const char* precision, double measured, double tolerance) {
  Check check;
  check.plugin = plugin;
  check.claim = claim;
  check.scope = "every point";
  check.system = system;
  check.precision = precision;
  check.measured = measured;
  check.tolerance = tolerance;
  check.result = measured <= tolerance ? CheckResult::pass : CheckResult::fail;
  return check;
}

// Adds to `controls` those of the checks of a planted fault that is_meant(check) selects: they have to fail.
// std::logic_error where there are none, since the claim is then called otherwise.
template <class Meant>
void add_controls(std::vector<Check>& controls, const std::string& fault, const std::string& claim,
                  const std::vector<Check>& checks, const Meant& is_meant) {
  const std::size_t before = controls.size();
  for (Check check : checks) {
    if (!is_meant(check)) continue;
    check.plugin = fault;
    check.system.clear();
    check.scope = "control";
    check.control = true;
    check.result = check.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
    controls.push_back(std::move(check));
  }
  if (controls.size() == before) throw std::logic_error(fault + ": no claim is called " + claim);
}

template <class T>
bool within(const Range& range, const T& x) {
  return static_cast<double>(x) >= range[0] && static_cast<double>(x) <= range[1];
}
// A coordinate that was moved from `centre`: on the other side of it where it has left its range, or not
// moved.
template <class T>
T inside(const Range& range, const T& centre, const T& moved) {
  if (within(range, moved)) return moved;
  const T mirrored = centre + (centre - moved);
  return within(range, mirrored) ? mirrored : centre;
}

// The centres near which states are drawn: one, or those of the region that a motion reaches (region_of); and
// the box from which they are drawn besides.
struct Region {
  Region(std::vector<Real> centre) : centres{std::move(centre)} {}  // NOLINT(google-explicit-constructor)
  std::vector<std::vector<Real>> centres;
  std::vector<double> times{1};          // near which they are drawn, that of a motion where it reaches them
  double own_time = 1;                   // of the motion, in which times are drawn about those
  std::vector<Range> box{};              // a range for each coordinate; empty where no coordinate states one
  std::shared_ptr<const Tape> domain{};  // outputs without which a far state does not count; null: all count
  std::shared_ptr<const Model> surface{};  // on whose constraints states are brought; null: they stay
  // Whether the coordinates are in the ranges that they state.
  [[nodiscard]] bool contains(std::span<const Quad> z) const;
  // The region in the first `count` coordinates.
  [[nodiscard]] Region first(std::size_t count) const;
  // The region of an exact solution: with one more coordinate, the time at which the motion starts, and times
  // that have elapsed since, a sixteenth of its own time to either side.
  [[nodiscard]] Region of_elapsed_times() const;
};

/// Over how many times the system's own time checks follow a motion: 32, and four where the field takes more
/// than 512 operations.
int own_times_followed(const Model& motion);

/// A state of a motion and the states that the motion reaches from there, forwards and backwards in time, up
/// to own_times_followed, or until a coordinate has grown by eight. What holds near the initial state alone
/// does not hold there. Of a field that is not short the first alone. The box is that of the ranges which
/// coordinates state; a motion on constraints has none, unless states are brought onto them.
Region region_of(const Model& motion, std::vector<Real> centre);

/// The region with a box about what the motion reaches, four times as large, where a formula has branches and
/// no ranges are stated. A formula without branches that holds near the motion holds wherever it has values,
/// because it is analytic; a branch that the motion does not take shows beyond alone.
Region with_branches_of(const Tape& formula, Region region);

// Random states near the centres of a region, drawn with a fixed seed. Near the first one each coordinate is
// within 1/20 of its scale and the time within 1/20 of the motion's own; near the others within 1/20 or, of
// every other state, a half of itself, so that it keeps its sign. The last ones are anywhere in the box, but
// near the first centre in coordinates that state no range.
template <class T>
class NearbyStates {
 public:
  explicit NearbyStates(const Region& region) : region_(region), z_(region.centres.front().size()) {}
  [[nodiscard]] int count() const {
    return points + far_points * static_cast<int>(region_.centres.size() - 1) +
           (region_.box.empty() ? 0 : box_points);
  }
  // True of a state near another centre than the first. It may lie outside the domain of a formula.
  [[nodiscard]] bool far() const { return far_; }
  // The next state, in a buffer that the call after it overwrites, and its time. Where a state cannot be
  // brought onto the surface, or is outside the box there, it is not-a-number and counts as far.
  const std::vector<T>& next(T& time) {
    const std::vector<T>& z = drawn(time);
    if (region_.surface != nullptr) far_ = !bring_onto(*region_.surface, time, z_) || far_;
    return z;
  }

 private:
  // The coordinates of the surface, the first ones of the state, moved onto its constraints. Those of an
  // exact solution are a state at the time that stands behind them, and `time` is what has elapsed since.
  bool bring_onto(const Model& surface, const T& time, std::vector<T>& z) const {
    const auto n = static_cast<std::size_t>(surface.dimension());
    std::vector<Quad> x(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
    const Quad at(z.size() > n ? z[n] : time);
    const bool there =
        project_onto_constraints(surface, at, x).status == Status::converged && region_.contains(x);
    for (std::size_t k = 0; k < x.size(); ++k)
      z[k] = there ? T(Real(x[k])) : std::numeric_limits<T>::quiet_NaN();
    return there;
  }
  const std::vector<T>& drawn(T& time) {
    far_ = drawn_ >= points;
    const auto place = static_cast<std::size_t>(far_ ? 1 + (drawn_ - points) / far_points : 0);
    if (drawn_++ == 0) scales_ = coordinate_scales(region_.centres.front());
    if (place >= region_.centres.size()) return in_box(time);
    const std::vector<Real>& centre = region_.centres[place];
    for (std::size_t i = 0; i < z_.size(); ++i) {
      const double reach = far_ ? std::abs(centre[i].value()) * (drawn_ % 2 == 0 ? 10 : 1) : scales_[i];
      z_[i] = T(centre[i]) + T(offset_(random_) * reach);
      if (i < region_.box.size()) z_[i] = inside(region_.box[i], T(centre[i]), z_[i]);
    }
    time = T(region_.times[place] + offset_(random_) * region_.own_time);
    return z_;
  }
  const std::vector<T>& in_box(T& time) {
    for (std::size_t i = 0; i < z_.size(); ++i) {
      const double share = offset_(random_);
      const auto [smallest, largest] = i < region_.box.size() ? region_.box[i] : unbounded;
      z_[i] = std::isfinite(largest - smallest) ? T(smallest) + T((share + 0.05) * 10) * T(largest - smallest)
                                                : T(region_.centres.front()[i]) + T(share * scales_[i]);
    }
    // A branch may begin at some time.
    const auto [first, last] = std::minmax_element(region_.times.begin(), region_.times.end());
    time =
        T(*first + (offset_(random_) + 0.05) * 10 * (*last - *first) + offset_(random_) * region_.own_time);
    return z_;
  }

  const Region& region_;
  std::vector<double> scales_;
  std::vector<T> z_;
  int drawn_ = 0;
  bool far_ = false;
  std::mt19937_64 random_{20041};
  std::uniform_real_distribution<double> offset_{-0.05, 0.05};
};

// The values of a formula at a state that is known to the rounding of a step, with their bounds.
template <class T>
std::vector<WithRounding<T>> with_rounding(Replay<WithRounding<T>>& values, const T& t, std::span<const T> z,
                                           const std::vector<T>& scales) {
  std::vector<WithRounding<T>> state, out(values.tape().outputs.size());
  for (std::size_t k = 0; k < z.size(); ++k) state.emplace_back(z[k], scales[k]);
  values(WithRounding<T>(t), state.data(), out.data());
  return out;
}

// The largest output of a tape at random states of a region, each relative to the sizes of the terms that
// it is made of. A formula that is zero stays below a few units of round-off, however large, small or badly
// conditioned its terms are.
template <class T>
double largest(const std::shared_ptr<const Tape>& tape, const Region& region) {
  using W = WithRounding<T>;
  NearbyStates<T> states(region);
  Replay<W> replay(tape);
  std::optional<Replay<W>> domain;
  std::vector<W> out(tape->outputs.size()), needed;
  if (region.domain != nullptr) domain.emplace(region.domain), needed.resize(region.domain->outputs.size());
  const auto finite = [](const W& x) { return isfinite(x.value); };
  double worst = 0;
  for (int k = 0; k < states.count(); ++k) {
    T time;
    const std::vector<T>& z = states.next(time);
    // A state on a surface is a rounded one.
    std::vector<W> exact(z.begin(), z.end());
    for (W& x : exact)
      if (region.surface != nullptr) x.error = T(abs(x.value));
    replay(W(time), exact.data(), out.data());
    if (states.far()) {
      if (domain) (*domain)(W(time), exact.data(), needed.data());
      if (!std::all_of(out.begin(), out.end(), finite) || !std::all_of(needed.begin(), needed.end(), finite))
        continue;
    }
    for (const W& x : out) {
      const double size = relative_to_rounding(x);
      worst = std::isnan(size) || std::isnan(worst) ? NAN : std::max(worst, size);
    }
  }
  return worst;
}

// A residual is the sum of rounding errors of which each is at most one unit of round-off of its term, or two
// where it comes from a library function. Twice as much is allowed for what a bound to first order leaves
// out.
template <class T>
constexpr double residual_tolerance() {
  return 4 * static_cast<double>(unit_roundoff<T>());
}

inline void both(std::vector<Check>& checks, const std::string& plugin, const std::string& claim,
                 const std::string& system, const std::shared_ptr<const Tape>& residual,
                 const Region& region) {
  checks.push_back(named(plugin, claim, system, "double", largest<double>(residual, region),
                         residual_tolerance<double>()));
  checks.push_back(
      named(plugin, claim, system, "quad", largest<Quad>(residual, region), residual_tolerance<Quad>()));
}

/// [Pi, Pi]^{ijk} = sum_l Pi^il d_l Pi^jk + cyclic: n x n x n, zero where Jacobi's identity holds.
std::shared_ptr<const Tape> jacobiator(const Tape& tensor, int n);
/// Pi dC for each function C in `casimirs`, n numbers each, one after the other; zero where C is a Casimir of
/// Pi.
std::shared_ptr<const Tape> sharp_of_casimirs(const Tape& tensor, const Tape& casimirs);

/// The third difference I(z + 3d) - 3 I(z + 2d) + 3 I(z + d) - I(z) of output k of a tape along a fixed
/// direction d of unequal parts of the scales of coordinates: one number, zero where the output is a
/// polynomial of degree two in the state.
std::shared_ptr<const Tape> third_difference(const Tape& values, std::size_t k,
                                             const std::vector<double>& scales);
/// True where it is, at random states near the initial one; computed once for a model.
bool is_quadratic(const std::shared_ptr<const Model>& model, std::size_t invariant);

/// Y_z^T K_c Y_z - K with K_c = [[0, -I], [I, 0]], for the chart Y and the structure K: zero where the chart
/// is Darboux's.
std::shared_ptr<const Tape> darboux_residual(const Tape& chart, const Tape& structure);

/// Compares what the author wrote with what is derived without it, at random states of a region: every
/// formula of the table that is written and can be derived, and the gradients of constraints one by one, by
/// the names of the constraints.
std::vector<Check> check_overrides(const std::string& plugin, const Model& model, const Region& region);

/// Whether a symmetric tensor, n x n, is non-negative at random states of a region, in double and quad: the
/// number of its negative pivots is zero.
std::vector<Check> check_not_negative(const std::string& plugin, const std::string& claim,
                                      const std::string& system, const std::shared_ptr<const Tape>& tensor,
                                      const Region& region);

/// Self-adjointness of a system K zdot + D = 0 (su-qin (8)), condition by condition.
std::vector<Check> check_self_adjointness(const std::string& plugin, const Model& model);

}  // namespace pfaff
