#include <pfaff/verify/round_off_growth.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/integration.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {

constexpr auto blocks = static_cast<std::size_t>(round_off_blocks);
// The exponent is that of changes over so many blocks; there are few independent ones over longer times.
constexpr std::size_t shortest_lag = 4, longest_lag = 32;
// Steps that each run begins with, steps in a row over which e is averaged, and steps in quad that show the
// truncation.
constexpr int first_steps = 16, averaged_steps = 16, truncation_steps = 256, tried_steps = 6;
// The part of the walk that truncation may amount to.
constexpr double out_of_sight = 0.05;

// The energy and the invariants of a model: their values, and what a rounding of all that a step adds to the
// state is in them.
class Quantities {
 public:
  explicit Quantities(const Model& model)
      : size_(static_cast<std::size_t>(model.dimension())), field_(model.tape(Formula::field)) {
    add(*model.tape(Formula::hamiltonian));
    names_.emplace_back("energy H");
    conserved_.push_back(true);
    if (model.invariants().empty()) return;
    add(*model.tape(Formula::invariants));
    for (const Invariant& invariant : model.invariants()) {
      names_.push_back(invariant.name);
      conserved_.push_back(invariant.behaviour == Behaviour::conserved);
    }
  }
  [[nodiscard]] std::size_t count() const { return names_.size(); }
  [[nodiscard]] const std::string& name(std::size_t quantity) const { return names_[quantity]; }
  [[nodiscard]] bool conserved(std::size_t quantity) const { return conserved_[quantity]; }

  std::vector<Quad> at(const Quad& t, const std::vector<Quad>& z) {
    std::vector<Quad> values(count());
    std::size_t first = 0;
    for (Replay<Quad>& replay : values_) {
      replay(t, z.data(), values.data() + first);
      first += replay.tape().outputs.size();
    }
    return values;
  }
  // u / sqrt 3 sum_k |dI/dz_k| a_k for each quantity I, where a_k is what the step of size h adds to a
  // coordinate, with the rounding of the field that it is made of, which is evaluated at a rounded state.
  std::vector<double> roundings(double t, double h, const std::vector<double>& before,
                                std::span<const double> after) {
    std::vector<WithRounding<double>> z, rate(size_);
    for (const double x : before) z.emplace_back(x, std::abs(x));
    field_(WithRounding<double>(t), z.data(), rate.data());
    std::vector<double> added(size_);
    for (std::size_t k = 0; k < size_; ++k) added[k] = std::hypot(after[k] - before[k], h * rate[k].error);
    return in_quantities(t, before, added);
  }
  // The same of one rounding of the whole state.
  std::vector<double> roundings_of_state(double t, const std::vector<double>& z) {
    return in_quantities(t, z, z);
  }

 private:
  std::vector<double> in_quantities(double t, const std::vector<double>& z,
                                    const std::vector<double>& sizes) {
    std::vector<double> list, slope;
    for (Replay<double>& replay : slopes_) {
      slope.resize(replay.tape().outputs.size());
      replay(t, z.data(), slope.data());
      for (std::size_t i = 0; i < slope.size(); i += size_) {
        double sum = 0;
        for (std::size_t k = 0; k < size_; ++k) sum += std::abs(slope[i + k] * sizes[k]);
        list.push_back(sum * unit_roundoff<double>() / std::numbers::sqrt3);
      }
    }
    return list;
  }
  void add(const Tape& tape) {
    values_.emplace_back(std::make_shared<const Tape>(tape));
    slopes_.emplace_back(std::make_shared<const Tape>(jacobian_tape(tape)));
  }
  std::size_t size_;
  Replay<WithRounding<double>> field_;
  std::vector<Replay<Quad>> values_;
  std::vector<Replay<double>> slopes_;
  std::vector<std::string> names_;
  std::vector<bool> conserved_;
};

// The quantities where a run is.
template <class T>
std::vector<Quad> values_of(const Integration<T>& run, Quantities& quantities) {
  return quantities.at(Quad(run.time()), {run.state().begin(), run.state().end()});
}

// What is gathered of one quantity over all runs.
struct Samples {
  std::vector<std::vector<double>> errors;  // [run][block], from e = 0
  double rounding = 0;                      // sum of squares of the roundings of what single steps add
  double at_rest = 0;                       // the same of one rounding of the whole state
  std::size_t looks = 0;                    // terms of that sum
  // The mean square change of e over `lag` blocks.
  [[nodiscard]] double change(std::size_t lag) const {
    double square = 0, count = 0;
    for (const std::vector<double>& e : errors)
      for (std::size_t k = 0; k + lag < e.size(); ++k, ++count)
        square += (e[k + lag] - e[k]) * (e[k + lag] - e[k]);
    return square / count;
  }
};

// The slope of log of the rms change over a number of blocks against log of that number. What does not grow
// is the same in all changes; a walk leaves it in twice the mean square over one block less that over two,
// and a trend leaves nothing there. Changes over long times are few, and weigh less.
double growth_exponent(const Samples& samples) {
  const double bounded = std::max(2 * samples.change(1) - samples.change(2), 0.0);
  double weights = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (std::size_t lag = shortest_lag; lag <= longest_lag; lag *= 2) {
    const double weight = 1 / static_cast<double>(lag), x = std::log(static_cast<double>(lag));
    const double y = std::log(samples.change(lag) - bounded) / 2;
    weights += weight;
    x_sum += weight * x;
    y_sum += weight * y;
    xx += weight * x * x;
    xy += weight * x * y;
  }
  return (xy - x_sum * y_sum / weights) / (xx - x_sum * x_sum / weights);
}

RoundOffGrowth growth_of(const std::string& quantity, const Samples& samples, std::int64_t steps) {
  RoundOffGrowth growth{.quantity = quantity};
  const auto runs = static_cast<double>(samples.errors.size());
  double sum = 0, square = 0;
  for (const std::vector<double>& e : samples.errors) {
    sum += e.back();
    square += e.back() * e.back();
  }
  growth.rms = std::sqrt(square / runs);
  if (square == 0) return growth;
  growth.at_rest = std::sqrt(samples.at_rest / static_cast<double>(samples.looks));
  const double mean = sum / runs, variance = (square - runs * mean * mean) / (runs - 1);
  growth.significance = mean / std::sqrt(variance / runs);
  growth.exponent = growth_exponent(samples);
  growth.size = growth.rms /
                std::sqrt(static_cast<double>(steps) * samples.rounding / static_cast<double>(samples.looks));
  return growth;
}

// The means of the quantities over the next steps of a run, and the roundings of what the last of them adds;
// false where a step does not converge.
struct Look {
  std::vector<double> mean, rounding, at_rest;
};
bool look(Integration<double>& run, Quantities& quantities, const std::vector<Quad>& origin, Look& seen) {
  const std::size_t count = quantities.count();
  seen.mean.assign(count, 0);
  for (int k = 0; k < averaged_steps; ++k) {
    const std::vector<double> before(run.state().begin(), run.state().end());
    const double time = run.time();
    if (!run.steps(1).reached()) return false;
    const std::vector<Quad> now = values_of(run, quantities);
    for (std::size_t i = 0; i < count; ++i)
      seen.mean[i] += static_cast<double>(now[i] - origin[i]) / averaged_steps;
    if (k + 1 < averaged_steps) continue;
    seen.rounding = quantities.roundings(time, run.step(), before, run.state());
    seen.at_rest = quantities.roundings_of_state(time, before);
  }
  return true;
}

// True where the method claims what keeps the truncation of the energy from adding up.
bool without_trend(const MethodInstance& method, const Model& model) {
  const std::vector<Claim> claims = claims_in_scope(method.preserves(model), model);
  return std::any_of(claims.begin(), claims.end(), [](Claim claim) {
    return claim == Claim::symplectic || claim == Claim::k_symplectic || claim == Claim::energy;
  });
}

}  // namespace

std::optional<RoundOffStep> round_off_step(const MethodInstance& method,
                                           const std::shared_ptr<const Model>& model,
                                           const std::vector<Real>& z, const Real& t, const Real& time,
                                           std::int64_t steps) {
  Quantities quantities(*model);
  std::vector<Quad> start;
  std::vector<double> rounded;
  for (const Real& x : z) {
    start.push_back(x.quad());
    rounded.push_back(x.value());
  }
  // What truncation may amount to in the steps in quad, in units of the rounding of a step: where it has no
  // trend, a part of the walk over the shortest times that the exponent is taken from; else of that over the
  // whole run, by the end of which a trend would have grown in proportion.
  const auto all = static_cast<double>(steps);
  const double bounded = out_of_sight * std::sqrt(all * shortest_lag / round_off_blocks);
  const double growing = out_of_sight * std::sqrt(all) * truncation_steps / all;
  const bool energy_stays = without_trend(method, *model);
  Real h = time * Real::fraction(2, 5);
  for (int halving = 0; halving < tried_steps; ++halving, h = h / Real(2)) {
    Integration<double> rough(start_with(method, model, rounded, h.value(), t.value()));
    Integration<Quad> exact(start_with(method, model, start, h.quad(), t.quad()));
    if (!rough.steps(1).reached()) continue;
    const std::vector<double> rounding = quantities.roundings(t.value(), h.value(), rounded, rough.state());
    const std::vector<Quad> first = values_of(exact, quantities);
    std::vector<double> truncation(quantities.count());
    bool steps_on = true;
    for (int k = 0; k < truncation_steps && steps_on; ++k) {
      steps_on = exact.steps(1).reached();
      const std::vector<Quad> now = values_of(exact, quantities);
      for (std::size_t i = 0; i < now.size(); ++i)
        truncation[i] = std::max(truncation[i], std::abs(static_cast<double>(now[i] - first[i])));
    }
    if (!steps_on) continue;
    RoundOffStep found{h, {}};
    for (std::size_t i = 0; i < quantities.count(); ++i)
      if (quantities.conserved(i) &&
          truncation[i] <= (i == 0 && energy_stays ? bounded : growing) * rounding[i])
        found.quantities.push_back(i);
    if (!found.quantities.empty() && found.quantities.front() == 0) return found;
  }
  return std::nullopt;
}

std::optional<std::vector<RoundOffGrowth>> round_off_growth(const MethodInstance& method,
                                                            const std::shared_ptr<const Model>& model,
                                                            const std::vector<Real>& centre, const Real& t,
                                                            const RoundOffStep& step,
                                                            const RoundOffEnsemble& ensemble) {
  Quantities quantities(*model);
  std::vector<Samples> samples(quantities.count());
  const std::vector<double> scales = coordinate_scales(centre);
  std::mt19937_64 random(ensemble.seed);
  std::uniform_real_distribution<double> offset(-ensemble.spread, ensemble.spread);
  for (int k = 0; k < ensemble.starts; ++k) {
    std::vector<double> z;
    for (std::size_t i = 0; i < centre.size(); ++i)
      z.push_back(centre[i].value() + scales[i] * offset(random));
    Integration<double> run(start_with(method, model, z, step.h.value(), t.value()));
    const std::vector<Quad> origin = values_of(run, quantities);
    Look first, now;
    if (!run.steps(first_steps).reached() || !look(run, quantities, origin, first)) return std::nullopt;
    for (Samples& s : samples) s.errors.push_back({0});
    for (std::size_t block = 0; block < blocks; ++block) {
      if (!run.steps(ensemble.steps / round_off_blocks - averaged_steps).reached() ||
          !look(run, quantities, origin, now))
        return std::nullopt;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].errors.back().push_back(now.mean[i] - first.mean[i]);
        samples[i].rounding += now.rounding[i] * now.rounding[i];
        samples[i].at_rest += now.at_rest[i] * now.at_rest[i];
        ++samples[i].looks;
      }
    }
  }
  std::vector<RoundOffGrowth> growth;
  for (const std::size_t i : step.quantities)
    growth.push_back(growth_of(quantities.name(i), samples[i], ensemble.steps));
  return growth;
}

double excess_over_random_walk(const std::vector<RoundOffGrowth>& growth) {
  double worst = 0;
  for (const RoundOffGrowth& g : growth) {
    // Errors that are no more than one rounding of the state have not grown, which is better than a walk.
    if (g.rms <= g.at_rest) continue;
    for (const double part : {std::abs(g.significance) / 3, (g.exponent - 0.5) / 0.1, g.size})
      worst = std::isnan(part) || std::isnan(worst) ? NAN : std::max(worst, part);
  }
  return worst;
}

}  // namespace pfaff
