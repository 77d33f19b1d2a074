#include <pfaff/verify/sign_along_motion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {
constexpr std::int64_t most_steps_followed = 4096;

// The rate at times of the motion.
class RateOfMotion {
 public:
  RateOfMotion(FollowedMotion& motion, const std::shared_ptr<const Tape>& rate,
               const std::shared_ptr<const Tape>& domain)
      : motion_(motion),
        solution_(motion.solution()),
        rate_(rate),
        domain_(domain),
        needed_(domain_.tape().outputs.size()) {}

  // How far it is found, in parts of the duration.
  [[nodiscard]] double reach(int parts) const {
    int k = parts;
    while (k > 0 && !solution_.covers(motion_.time(Quad(k) / Quad(parts)))) --k;
    return static_cast<double>(k) / parts;
  }
  // At a part of the duration; negative where the state does not count.
  WithRounding<Quad> operator()(double part) {
    const Quad t = motion_.time(Quad(part));
    const std::vector<Quad> state = solution_.at(t);
    const std::vector<WithRounding<Quad>> z(state.begin(), state.end());
    WithRounding<Quad> rate(-1);
    domain_(WithRounding<Quad>(t), z.data(), needed_.data());
    if (!motion_.region().contains(state) ||
        !std::all_of(needed_.begin(), needed_.end(), [](const auto& x) { return isfinite(x.value); }))
      return rate;
    rate_(WithRounding<Quad>(t), z.data(), &rate);
    return rate;
  }

 private:
  const FollowedMotion& motion_;
  const ReferenceSolution& solution_;
  Replay<WithRounding<Quad>> rate_, domain_;
  std::vector<WithRounding<Quad>> needed_;
};

// The largest rate found between two parts of the duration by golden sections.
WithRounding<Quad> highest_between(RateOfMotion& rate, double low, double high) {
  constexpr int sections = 40;
  constexpr double golden = 0.6180339887498949;
  double left = high - golden * (high - low), right = low + golden * (high - low);
  WithRounding<Quad> at_left = rate(left), at_right = rate(right);
  for (int k = 0; k < sections; ++k) {
    if (at_left.value > at_right.value) {
      high = right, right = left, at_right = at_left;
      left = high - golden * (high - low);
      at_left = rate(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + golden * (high - low);
      at_right = rate(right);
    }
  }
  return at_left.value > at_right.value ? at_left : at_right;
}
}  // namespace

FollowedMotion::FollowedMotion(std::shared_ptr<const Model> model, Region region)
    : model_(std::move(model)), region_(std::move(region)), begin_(generic_time_of(*model_).quad()) {}

const ReferenceSolution& FollowedMotion::solution() {
  if (!solution_) {
    const std::vector<Real>& start = region_.centres.front();
    duration_ = Quad(own_times_followed(*model_)) * own_time(*model_, generic_time_of(*model_), start);
    // A motion that gets ever faster is followed as far as so many steps lead, some seconds at most; sixteen
    // turns of one that does not take some hundred.
    const Budget budget({.steps = most_steps_followed});
    solution_.emplace(model_, begin_, std::vector<Quad>(start.begin(), start.end()), duration_,
                      Certainty::not_shown);
  }
  return *solution_;
}

double largest_along(FollowedMotion& motion, const std::shared_ptr<const Tape>& rate,
                     const std::shared_ptr<const Tape>& domain) {
  constexpr std::size_t most_operations = std::size_t{1} << 18;  // at all times together
  constexpr std::size_t most_maxima = 32;
  const auto looks = static_cast<int>(
      std::clamp<std::size_t>(most_operations / std::max<std::size_t>(1, rate->code.size()), 64, 512));
  RateOfMotion along(motion, rate, domain);
  const double reach = along.reach(looks);
  std::vector<WithRounding<Quad>> seen;
  for (int k = 0; k <= looks; ++k) seen.push_back(along(reach * k / looks));
  double worst = 0;
  const auto take = [&](const WithRounding<Quad>& x) {
    if (x.value > Quad(0)) worst = std::max(worst, relative_to_rounding(x));
  };
  std::vector<int> maxima;
  for (int k = 0; k <= looks; ++k) {
    const auto at = static_cast<std::size_t>(k);
    take(seen[at]);
    if (k > 0 && k < looks && seen[at].value >= seen[at - 1].value && seen[at].value >= seen[at + 1].value)
      maxima.push_back(k);
  }
  std::sort(maxima.begin(), maxima.end(), [&](int a, int b) {
    return seen[static_cast<std::size_t>(a)].value > seen[static_cast<std::size_t>(b)].value;
  });
  if (maxima.size() > most_maxima) maxima.resize(most_maxima);
  for (const int k : maxima) take(highest_between(along, reach * (k - 1) / looks, reach * (k + 1) / looks));
  return worst;
}

}  // namespace pfaff
