#include <pfaff/bench/measure/drift_rules.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/measure/drift_facts.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff::drift_rules {

namespace {

using windows::Estimate;
using windows::Shape;

constexpr std::size_t fewest_samples = 32;

template <class... A>
std::string told(const char* format, A... numbers) {
  return formatted(format, numbers...);
}

Verdict undetermined(std::string evidence) {
  return {DriftClass::undetermined, std::move(evidence), {}, {}, {}};
}
Verdict bounded(std::string evidence) {
  return {DriftClass::bounded, std::move(evidence), Estimate{0, 0, 0}, {}, {}};
}
/// Bounded, unless the first half of the run covers less than half of the range.
Verdict bounded_throughout(const Facts& facts, std::string evidence) {
  if (facts.first_half < 0.5)
    return undetermined(told("first half covers %.0f %% of the range: an event", 100 * facts.first_half));
  return bounded(std::move(evidence));
}
Verdict of_power(const Estimate& exponent, std::string evidence) {
  return {exponent.value > 1.3 ? DriftClass::polynomial : DriftClass::linear,
          std::move(evidence),
          exponent,
          {},
          {}};
}
Verdict of_rate(const Estimate& rate, std::string evidence) {
  return {DriftClass::exponential, std::move(evidence), {}, rate, {}};
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

std::optional<Verdict> round_off(const Observed& observed) {
  const RoundOff& r = observed.round_off;
  const double step = r.unit * r.scale;
  if (!(step > 0)) return {};
  const double walk = step * std::sqrt(double(std::max<std::int64_t>(r.steps, 1)));
  if (observed.maximum <= 8 * walk)
    return Verdict{
        DriftClass::round_off, told("max is %.2g u|I| sqrt(steps)", observed.maximum / walk), {}, {}, {}};
  const std::size_t n = observed.series.samples;
  if (observed.values.size() > std::min<std::size_t>(n / 4, DriftAccumulator::most_values)) return {};
  std::vector<double> levels = observed.values;
  std::sort(levels.begin(), levels.end());
  for (std::size_t k = 1; k < levels.size(); ++k)
    if (levels[k] - levels[k - 1] > 4 * step) return {};
  return Verdict{DriftClass::round_off, told("%zu different values among %zu", levels.size(), n), {}, {}, {}};
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
  if (const auto fit = windows::power_fit(v);
      fit && fit->scatter < 0.35 && fit->exponent.low > 0 && fit->exponent.value >= 0.7)
    return of_power(fit->exponent,
                    told("oscillation grows %.2g-fold like t^%.2f", growth, fit->exponent.value));
  return undetermined(told("oscillation grows %.2g-fold but neither as a power nor exponentially", growth));
}

/// The class of a trend that noise does not explain; nothing where the trend has none.
std::optional<Verdict> accepted_trend(const Facts& facts) {
  const double gate = facts.slowest > 0 && facts.slowest < 8 ? 1 / facts.slowest : 0.01;
  if (facts.jump < gate * facts.rest)
    return bounded(told("trend of %.2g %% of the oscillation", 100 * facts.jump / facts.rest));
  const Shape::Kind kind = facts.shapes[facts.shape].kind;
  const std::string moves = told("moves by %.2g = %.2g x oscillation; log evidence %.2g", facts.jump,
                                 facts.jump / facts.rest, facts.evidence());
  const bool bent = facts.curve && facts.rest > (kind == Shape::Kind::line ? 0.12 : 0.03) * facts.jump;
  if (kind == Shape::Kind::exponential) {
    Parameter rate = parameter_of(facts, kind);
    if (rate.estimate.value > 16 && !facts.maxima.steady) return {};
    if (rate.at_end || (facts.curve && facts.maxima.scatter >= 0.25))
      return undetermined("grows like no power and no exponential; " + moves);
    return of_rate(widened(rate.estimate), moves);
  }
  Parameter power = parameter_of(facts, Shape::Kind::power);
  if (kind == Shape::Kind::line) power.estimate.value = 1;
  const double p = power.estimate.value;
  if (p < 0.75) return {};
  if (p > 1.3) {
    if (power.at_end || bent || ((facts.samples < few_samples || facts.curve) && facts.evidence() < 8))
      return undetermined(told("t^%.2g does not fit; ", p) + moves);
    return of_power(power.estimate, told("like t^%.2f; ", p) + moves);
  }
  if (bent) return undetermined("a curve and no line; " + moves);
  if (facts.slope.low <= 0 && facts.slope.high >= 0) return {};
  return of_power(power.estimate, moves);
}

/// Whether what moves at first stays where it is: means move little in the second half, or little enough
/// after the first quarter too, which an arc of a slow oscillation does not.
bool settles(const Facts& facts) {
  return facts.late_range_of_means < 0.15 * facts.range_of_means ||
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
    return bounded("levels off");
  if (facts.slowest > 0 && facts.slowest < 2 && facts.jump < 50 * facts.oscillation)
    return undetermined(told("only %.3g periods of a slow oscillation", facts.slowest));
  const bool straight =
      facts.shape == 0 && facts.jump > 20 * facts.rest && facts.trend > std::max(facts.white, facts.walk) + 4;
  if (facts.accepted() || straight)
    if (auto verdict = accepted_trend(facts)) return *verdict;
  if (facts.range_of_means < 0.1 * facts.range)
    return bounded_throughout(
        facts, told("means wander by %.2g %% of the range", 100 * facts.range_of_means / facts.range));
  if (facts.samples >= few_samples && settles(facts)) return bounded("levels off");
  if (facts.accepted() && facts.shapes[facts.shape].kind == Shape::Kind::power &&
      facts.shapes[facts.shape].parameter < 0.75)
    return undetermined(told("sublinear: like t^%.2g", facts.shapes[facts.shape].parameter));
  if (facts.white > std::max(facts.walk, facts.smooth - 5) - 6)
    return bounded_throughout(facts, told("no trend: %.2g +- %.2g; oscillation %.2g", facts.slope.value,
                                          (facts.slope.high - facts.slope.low) / 2, facts.oscillation));
  if (facts.slowest >= 2 && facts.shared >= 0.8)
    return bounded_throughout(facts,
                              told("halves of the run share %.0f %% of the range", 100 * facts.shared));
  if (facts.samples < few_samples) return undetermined("too few samples to tell a walk from an oscillation");
  if (facts.one_sided) return undetermined("nearly all steps have one sign: no walk");
  if (facts.curve) return undetermined(told("turns only %zu times: a curve and no walk", facts.turns));
  if (facts.first_half < 0.1)
    return undetermined(told("first half covers %.2g %% of the range: an event", 100 * facts.first_half));
  if (facts.smooth - 5 > facts.walk && facts.turns_of_means >= 5 && facts.shared >= 0.7)
    return bounded_throughout(facts,
                              told("halves of the run share %.0f %% of the range", 100 * facts.shared));
  if (facts.walk >= facts.smooth - 2)
    return {DriftClass::random_walk,
            told("no trend; log evidence of a walk %.2g", facts.walk - facts.white),
            Estimate{0.5, 0.5, 0.5},
            {},
            {}};
  return undetermined("wanders smoothly: an oscillation that is longer than the run or a trend");
}

bool is_trend(DriftClass c) {
  return c == DriftClass::linear || c == DriftClass::polynomial || c == DriftClass::exponential;
}

/// The series up to the block in which half of the quantity is lost.
Observed until_half_is_lost(const Observed& observed) {
  Observed part = observed;
  const double half = 0.5 * observed.round_off.scale;
  std::vector<windows::Block> blocks;
  part.maximum = 0;
  for (const windows::Block& block : observed.series.blocks) {
    if (std::abs(block.mean) >= half) break;
    blocks.push_back(block);
    part.maximum = std::max({part.maximum, std::abs(block.minimum), std::abs(block.maximum)});
  }
  part.series = blocks.size() < 2 ? windows::Series{}
                                  : windows::on_scaled_time(blocks, blocks.front().time, blocks.back().time);
  return part;
}

}  // namespace

Verdict judge(const Observed& observed) {
  const windows::Series& series = observed.series;
  if (observed.maximum == 0 && series.samples > 1 && !observed.non_finite_time)
    return {DriftClass::exact, "every error is zero", {}, {}, windows::Slope{}};
  if (series.samples < fewest_samples)
    return undetermined(told("%zu samples; %zu are needed", series.samples, fewest_samples));
  const Facts facts = facts_of(observed);
  if (!facts.means) return undetermined("the samples are too uneven in time");
  std::optional<Verdict> at_once = observed.non_finite_time ? std::nullopt : round_off(observed);
  Verdict verdict = at_once ? *at_once : decide(facts);
  verdict.slope = facts.slope;
  if (at_once) return verdict;
  const RoundOff& r = observed.round_off;
  const double lost = r.scale > 0 ? observed.maximum / r.scale : 0;
  if (observed.non_finite_time || (lost > 1000 && !is_trend(verdict.drift_class))) {
    // What blows up seldom does so at one rate: the rate is left out.
    verdict.drift_class = facts.maxima.growth > 1000 && facts.first_half < 0.5 ? DriftClass::exponential
                                                                               : DriftClass::undetermined;
    verdict.evidence = observed.non_finite_time
                           ? told("blows up: not finite from t = %.6g on", *observed.non_finite_time)
                           : told("blows up: to %.2g times the quantity", lost);
    verdict.exponent.reset(), verdict.rate.reset();
    return verdict;
  }
  if (r.unit > 0 && r.scale > 0 && is_trend(verdict.drift_class) &&
      observed.maximum <= r.unit * r.scale * double(r.steps)) {
    verdict.evidence = told("%.2g u|I| a step; ", observed.maximum / (r.unit * r.scale * double(r.steps))) +
                       std::string(to_string(verdict.drift_class)) + ": " + verdict.evidence;
    verdict.drift_class = DriftClass::biased_round_off;
    return verdict;
  }
  if (facts.lost && !is_trend(verdict.drift_class)) {
    const Observed before = until_half_is_lost(observed);
    std::string evidence = told("loses %.0f %% of the quantity; ", 100 * lost);
    if (before.series.samples >= fewest_samples && before.series.blocks.size() >= fewest_samples) {
      Facts early = facts_of(before);
      early.slowest = 0;  // what is used up stays away: its curve is no arc of an oscillation
      const Verdict first = early.means ? decide(early) : undetermined("");
      if (is_trend(first.drift_class)) {
        verdict.drift_class = first.drift_class;
        verdict.evidence = evidence + "until half of it " + first.evidence;
        verdict.exponent = first.exponent;
        return verdict;
      }
    }
  }
  return verdict;
}

}  // namespace pfaff::drift_rules
