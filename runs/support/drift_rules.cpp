#include <pfaff/runs/support/drift_rules.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/runs/support/drift_facts.hpp>
#include <pfaff/runs/support/walk_exponent.hpp>

namespace pfaff::drift_rules {

namespace {

using windows::Estimate;
using windows::Shape;

constexpr std::size_t fewest_samples = 32;

// What a slow exchange within the motion looks like, where energy goes from one mode to others: the error of
// a method that keeps the energy follows it, swells a few times, and comes back. Curves are called by their
// power or rate where they are more than that.
constexpr double steepest = 4;            // power of time of a trend that is called by it
constexpr double clean = 100;             // change of a steeper one, of the oscillation beside it
constexpr double least_exponential = 10;  // change of an exponential trend, the same
constexpr double least_curved = 10;       // growth of an oscillation faster than time

template <class... A>
std::string told(const char* format, A... numbers) {
  return formatted(format, numbers...);
}

Verdict undetermined(std::string evidence) { return {DriftClass::undetermined, std::move(evidence)}; }
Verdict bounded(std::string evidence) {
  return {DriftClass::bounded, std::move(evidence), Estimate{0, 0, 0}};
}
/// Bounded, unless the first half of the run covers less than half of the range.
Verdict bounded_throughout(const Facts& facts, std::string evidence) {
  if (facts.first_half < 0.5)
    return undetermined(told("first half covers %.0f %% of the range: an event", 100 * facts.first_half));
  return bounded(std::move(evidence));
}
Verdict of_power(const Estimate& exponent, std::string evidence) {
  return {exponent.value > 1.3 ? DriftClass::polynomial : DriftClass::linear, std::move(evidence), exponent};
}
Verdict of_rate(const Estimate& rate, std::string evidence) {
  return {DriftClass::exponential, std::move(evidence), {}, rate};
}

/// The likelihood's interval of a rate, widened by a tenth on both sides: it does not know of the shape of a
/// floor.
Estimate widened(const Estimate& rate) { return {rate.value, 0.9 * rate.low, 1.1 * rate.high}; }

/// The rate of maxima that grow exponentially: that of the means, which is the more precise, where they do so
/// too.
Estimate rate_of_maxima(const Facts& facts) {
  const bool of_means = facts.accepted() && facts.shapes[facts.shape].kind == Shape::Kind::exponential;
  const Parameter rate = parameter_of(facts, Shape::Kind::exponential);
  return of_means && !rate.at_end ? widened(rate.estimate) : facts.maxima.rate;
}

/// What roundings can add up to: u times the terms once, for the evaluation, and u times what each step
/// propagates, `steps` times.
double allowance(const RoundOff& r, double steps) { return r.unit * (r.scale + steps * r.walk()); }

/// The number of steps, or what a walk of as many comes to: 3 u a step reach 8 sqrt(N) u at 2.5 standard
/// deviations.
double steps_of(const RoundOff& r) { return double(std::max<std::int64_t>(r.steps, 1)); }
double walk_of(const RoundOff& r) { return 8 * std::sqrt(steps_of(r)); }

/// The number of different values of e where these are few and next to each other and to zero, as the
/// roundings of an evaluation are; otherwise 0.
std::size_t levels_of_rounding(const Observed& observed) {
  const std::size_t n = observed.series.samples, count = observed.values.size();
  if (count > std::min<std::size_t>(n / 4, DriftAccumulator::most_values)) return 0;
  std::vector<double> levels = observed.values;
  levels.push_back(0);  // which a residual need not be near, though it keeps its value
  std::sort(levels.begin(), levels.end());
  for (std::size_t k = 1; k < levels.size(); ++k)
    if (levels[k] - levels[k - 1] > 4 * observed.round_off.unit * observed.round_off.scale) return 0;
  return count;
}

/// Growth of the spread of e about its local mean; nothing where it does not grow or a trend hides it.
std::optional<Verdict> growing_spread(const Facts& facts) {
  const std::vector<double>& v = facts.spreads;
  const double growth = v.back() / v.front();
  if (!(growth > 3) || !(windows::rank_correlation(v) > 0.8) || !(v.back() > facts.jump / 4)) return {};
  std::vector<double> s;
  for (std::size_t j = 1; j <= v.size(); ++j) s.push_back(double(j) / double(v.size() + 1));
  if (const auto fit = windows::exponential_fit(s, v, 5); fit.grows && !(facts.curve && fit.scatter >= 0.25))
    return of_rate(fit.rate,
                   told("oscillation grows %.1e-fold; scatter %.2g about exp and %.2g about a power",
                        fit.growth, fit.scatter, fit.power_scatter));
  if (const auto fit = windows::power_fit(v); fit && fit->scatter < 0.35 && fit->exponent.low > 0 &&
                                              fit->exponent.value >= 0.7 &&
                                              (fit->exponent.value <= 1.3 || growth > least_curved))
    return of_power(fit->exponent,
                    told("oscillation grows %.2g-fold like t^%.2f", growth, fit->exponent.value));
  return undetermined(told(growth > least_curved
                               ? "oscillation grows %.2g-fold but neither as a power nor exponentially"
                               : "oscillation grows %.2g-fold, too little to tell how",
                           growth));
}

/// Whether the spread rises or falls throughout, by half of the trend's change or more: then the trend may be
/// what an oscillation does to the means whose size changes slowly.
bool swells(const Facts& facts) {
  return std::abs(windows::rank_correlation(facts.spreads)) > 0.8 &&
         2 * std::abs(facts.spreads.back() - facts.spreads.front()) > facts.jump;
}

/// The class of a trend that noise does not explain; nothing where the trend has none.
std::optional<Verdict> accepted_trend(const Facts& facts) {
  const double gate = facts.slowest > 0 && facts.slowest < 8 ? 1 / facts.slowest : 0.01;
  const bool known = std::abs(facts.slope.value) >= 6 * (facts.slope.high - facts.slope.low);
  const std::string small_trend = told("trend of %.2g %% of the oscillation", 100 * facts.jump / facts.rest);
  if (facts.jump < 0.01 * facts.rest || (facts.jump < 0.03 * facts.rest && !known))
    return bounded_throughout(facts, small_trend);
  if (facts.jump < gate * facts.rest) {
    if (known && facts.slowest >= 4)
      return undetermined(small_trend + told(", which has %.3g periods", facts.slowest));
    return bounded_throughout(facts, small_trend);
  }
  const Shape::Kind kind = facts.shapes[facts.shape].kind;
  const bool small = facts.jump < facts.rest;
  const std::string moves = told("moves by %.2g = %.2g x oscillation; log evidence %.2g", facts.jump,
                                 facts.jump / facts.rest, facts.evidence());
  if (small && kind != Shape::Kind::line) {
    if (!(facts.jump > 0.3 * facts.rest && facts.evidence() > 15)) return {};
    return undetermined("a curve that is smaller than the oscillation; " + moves);
  }
  const bool bent = facts.curve && facts.rest > (kind == Shape::Kind::line ? 0.12 : 0.03) * facts.jump;
  const Parameter rate = parameter_of(facts, Shape::Kind::exponential);
  if (kind == Shape::Kind::exponential && rate.estimate.value >= 2) {
    if (rate.estimate.value > 16 && !facts.maxima.steady) return {};
    if (rate.at_end || (facts.curve && facts.maxima.scatter >= 0.25))
      return undetermined("grows like no power and no exponential; " + moves);
    if (facts.jump < least_exponential * facts.rest)
      return undetermined("too small to tell a power from an exponential; " + moves);
    return of_rate(widened(rate.estimate), moves);
  }
  Parameter power = parameter_of(facts, Shape::Kind::power);
  if (kind == Shape::Kind::line) power.estimate.value = 1;
  const double p = power.estimate.value;
  if (p < 0.75) return {};
  if (p > 1.3) {
    if (power.estimate.low > steepest && facts.jump < clean * facts.rest)
      return undetermined(told("begins late, like t^%.2f; ", p) + moves);
    if (power.at_end || bent || ((facts.samples < few_samples || facts.curve) && facts.evidence() < 8))
      return undetermined(told("t^%.2g does not fit; ", p) + moves);
    return of_power(power.estimate, told("like t^%.2f; ", p) + moves);
  }
  if (bent) return undetermined("a curve and no line; " + moves);
  if (facts.slope.low <= 0 && facts.slope.high >= 0) return {};
  if (small && (swells(facts) || facts.modulation > facts.trend - 2))
    return undetermined("the means move as the size of the oscillation does; " + moves);
  if (small && facts.evidence() < 6) return undetermined("too small a trend to be sure of; " + moves);
  return of_power(power.estimate, moves);
}

/// What levels off is bounded where it goes on to turn, or is one number from the start. Without that nothing
/// may have tried the method since: RK4 loses energy once in a period of Kepler's motion, and keeps it in
/// between.
Verdict levelled(const Facts& facts) {
  if (facts.late_turns >= 4 || facts.range_after_start == 0) return bounded("levels off");
  return undetermined(
      told("levels off and then turns %zu times: nothing has tried it again", facts.late_turns));
}

/// Whether what moves at first stays where it is: means move little in the second half, or little enough
/// after the first quarter too, which an arc of a slow oscillation does not.
bool settles(const Facts& facts) {
  return facts.late_range_of_means < 0.18 * facts.range_of_means ||
         (facts.late_range_of_means < 0.22 * facts.range_of_means &&
          facts.settled_range_of_means < 0.35 * facts.range_of_means);
}

Verdict decide(const Facts& facts) {
  if (facts.maxima.grows && !(facts.curve && facts.maxima.scatter >= 0.25))
    return of_rate(rate_of_maxima(facts),
                   told("grows %.1e-fold; scatter %.2g about exp and %.2g about a power", facts.maxima.growth,
                        facts.maxima.scatter, facts.maxima.power_scatter));
  if (auto verdict = growing_spread(facts)) return *verdict;
  if (facts.samples >= few_samples && facts.late_range_of_means < 0.1 * facts.range_of_means)
    return levelled(facts);
  if (facts.slowest > 0 && facts.slowest < 2 && facts.jump < 50 * facts.oscillation)
    return undetermined(told("only %.3g periods of a slow oscillation", facts.slowest));
  const bool straight =
      facts.shape == 0 && facts.jump > 20 * facts.rest && facts.trend > std::max(facts.white, facts.walk) + 4;
  const bool arc = facts.accepted() && facts.arc > facts.trend + 2;
  if (arc && facts.range_of_means > 0.02 * facts.range)
    return undetermined(
        told("less than a period of a slow oscillation; log evidence %.2g", facts.arc - facts.trend));
  if (!arc && (facts.accepted() || straight))
    if (auto verdict = accepted_trend(facts)) return *verdict;
  if (facts.range_of_means < 0.1 * facts.range)
    return bounded_throughout(
        facts, told("means wander by %.2g %% of the range", 100 * facts.range_of_means / facts.range));
  if (facts.samples >= few_samples && settles(facts)) return levelled(facts);
  if (facts.arc > std::max(facts.trend, facts.noise) + 6)
    return undetermined(told("less than a period of a slow oscillation; log evidence %.2g",
                             facts.arc - std::max(facts.trend, facts.noise)));
  if (facts.accepted() && facts.shapes[facts.shape].kind == Shape::Kind::power &&
      facts.shapes[facts.shape].parameter < 0.75)
    return undetermined(told("sublinear: like t^%.2g", facts.shapes[facts.shape].parameter));
  if (facts.white > std::max(facts.walk, facts.smooth - 5) - 6) {
    // A few periods of a regular oscillation have tried the method more than once.
    if (facts.curve && facts.periods < 3 && facts.late_turns < 4 && facts.range_after_start > 0)
      return levelled(facts);
    return bounded_throughout(facts, told("no trend: %.2g +- %.2g; oscillation %.2g", facts.slope.value,
                                          (facts.slope.high - facts.slope.low) / 2, facts.oscillation));
  }
  if (facts.slowest >= 2 && facts.shared >= 0.75)
    return bounded_throughout(facts,
                              told("halves of the run share %.0f %% of the range", 100 * facts.shared));
  if (facts.periods >= 4 && facts.shared >= 0.6)
    return bounded_throughout(facts, told("%zu periods of an oscillation", facts.periods));
  if (facts.range_of_means < 0.5 * facts.range && facts.shared >= 0.75)
    return bounded_throughout(
        facts, told("means wander by %.2g %% of the range; halves of the run share %.0f %% of it",
                    100 * facts.range_of_means / facts.range, 100 * facts.shared));
  if (facts.samples < few_samples) return undetermined("too few samples to tell a walk from an oscillation");
  if (facts.one_sided) return undetermined("nearly all steps have one sign: no walk");
  if (facts.curve) return undetermined(told("turns only %zu times: a curve and no walk", facts.turns));
  if (facts.first_half < 0.1)
    return undetermined(told("first half covers %.2g %% of the range: an event", 100 * facts.first_half));
  if (facts.smooth - 5 > facts.walk && facts.turns_of_means >= 5 && facts.shared >= 0.7)
    return bounded_throughout(facts,
                              told("halves of the run share %.0f %% of the range", 100 * facts.shared));
  if (facts.walk >= facts.smooth - 2)
    return {DriftClass::random_walk, told("no trend; log evidence of a walk %.2g", facts.walk - facts.white),
            windows::walk_exponent(facts.means)};
  return undetermined("wanders smoothly: an oscillation that is longer than the run or a trend");
}

bool is_trend(DriftClass c) {
  return c == DriftClass::linear || c == DriftClass::polynomial || c == DriftClass::exponential;
}

/// The series up to the block whose mean is `limit` away, in the longest blocks of which there are 64, or in
/// the shortest.
Observed until_away_by(double limit, const Observed& observed) {
  constexpr std::size_t enough = 64;
  const auto away = [limit](const windows::Block& block) { return std::abs(block.mean) >= limit; };
  const std::vector<windows::Block>* blocks = &observed.series.blocks;
  auto end = std::find_if(blocks->begin(), blocks->end(), away);
  for (auto start = observed.starts.rbegin();
       start != observed.starts.rend() && std::size_t(end - blocks->begin()) < enough; ++start) {
    blocks = &*start;
    end = std::find_if(blocks->begin(), blocks->end(), away);
  }
  Observed part = observed;
  std::vector<windows::Block> before(blocks->begin(), end);
  part.maximum = 0;
  for (const windows::Block& block : before)
    part.maximum = std::max({part.maximum, std::abs(block.minimum), std::abs(block.maximum)});
  const double first = before.empty() ? 0 : before.front().time,
               last = before.empty() ? 0 : before.back().time;
  part.series = before.size() < fewest_samples ? windows::Series{}
                                               : windows::on_scaled_time(std::move(before), first, last);
  return part;
}

/// A quantity that is lost levels off, for which no method deserves the word bounded. What it did before
/// tells: up to where half of it was lost, and where that is no trend, as of a loss that slows down, up to
/// where a tenth was. What is on its way back at the end of the run was not lost.
Verdict of_lost(Verdict verdict, const Facts& facts, const Observed& observed) {
  const std::string loses = told("loses %.3g %% of the quantity; ", 100 * facts.lost);
  double farthest = 0;
  for (const double mean : facts.means) farthest = std::max(farthest, std::abs(mean));
  const bool comes_back = std::abs(facts.means.back()) < 0.85 * farthest;
  for (const auto& [share, words] : {std::pair{0.5, "until half of it "}, {0.1, "until a tenth of it "}}) {
    if (comes_back) break;
    const Observed before = until_away_by(share * observed.round_off.own_range(), observed);
    if (before.series.samples < fewest_samples) continue;
    Facts early = facts_of(before);
    if (early.means.empty()) continue;
    // What ends on the other side was not lost at the start.
    if (early.slope.value * facts.means.back() < 0) continue;
    early.slowest = 0, early.arc = -HUGE_VAL;  // what is used up stays away: its curve is no arc
    Verdict first = decide(early);
    if (!is_trend(first.drift_class)) continue;
    first.evidence = loses + words + first.evidence;
    first.slope = verdict.slope;
    first.of_start = StartOfRun{early.slope, before.series.span};
    return first;
  }
  if (verdict.drift_class == DriftClass::bounded) {
    verdict.drift_class = DriftClass::undetermined;
    verdict.exponent.reset();
  }
  verdict.evidence = loses + verdict.evidence;
  return verdict;
}

}  // namespace

Verdict judge(const Observed& observed) {
  const windows::Series& series = observed.series;
  if (observed.maximum == 0 && series.samples > 1 && !observed.non_finite_time)
    return {DriftClass::exact, "every error is zero", {}, {}, windows::Slope{}};
  if (series.samples < fewest_samples)
    return undetermined(told("%zu samples; %zu are needed", series.samples, fewest_samples));
  const Facts facts = facts_of(observed);
  if (facts.means.empty()) return undetermined("the samples are too uneven in time");
  const RoundOff& r = observed.round_off;
  const bool rounded = r.unit > 0 && r.scale > 0 && !observed.non_finite_time;
  const auto finished = [&](Verdict verdict) {
    verdict.slope = facts.slope;
    return verdict;
  };
  if (const double walk = rounded ? allowance(r, walk_of(r)) : 0; rounded && observed.maximum <= walk)
    return finished({DriftClass::round_off,
                     told("max is %.2g of what roundings may add up to", observed.maximum / walk)});
  Verdict verdict = finished(decide(facts));
  if (const std::size_t levels = rounded ? levels_of_rounding(observed) : 0;
      levels > 0 &&
      (levels <= 4 || (!is_trend(verdict.drift_class) && observed.maximum <= 4 * allowance(r, walk_of(r)))))
    return finished({DriftClass::round_off, told("%zu different values among %zu", levels, series.samples)});
  if (observed.non_finite_time || (facts.lost > 1000 && !is_trend(verdict.drift_class))) {
    // What blows up seldom does so at one rate: the rate is left out.
    verdict.drift_class = facts.maxima.growth > 1000 && facts.first_half < 0.5 ? DriftClass::exponential
                                                                               : DriftClass::undetermined;
    verdict.evidence = observed.non_finite_time
                           ? told("blows up: not finite from t = %.6g on", *observed.non_finite_time)
                           : told("blows up: to %.2g times the quantity", facts.lost);
    verdict.exponent.reset(), verdict.rate.reset();
    return verdict;
  }
  if (const double biased = rounded ? allowance(r, steps_of(r)) : 0;
      rounded && is_trend(verdict.drift_class) && observed.maximum <= biased) {
    verdict.evidence = told("%.2g units of round-off a step; ", observed.maximum / biased) +
                       std::string(to_string(verdict.drift_class)) + ": " + verdict.evidence;
    verdict.drift_class = DriftClass::biased_round_off;
    return verdict;
  }
  if (facts.lost >= 0.5 && !is_trend(verdict.drift_class)) return of_lost(verdict, facts, observed);
  return verdict;
}

}  // namespace pfaff::drift_rules
