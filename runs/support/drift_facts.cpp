#include <pfaff/runs/support/drift_facts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfaff::drift_rules {

namespace {

using windows::Block;
using windows::Noise;
using windows::Series;
using windows::Shape;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t twentieths = 20;
/// Shapes have the parameters of a grid: what they leave of the means is no smaller than this part of their
/// range, in which a power between two of the grid would be taken for an oscillation. The slope of a line has
/// no grid, and is as precise as the means.
constexpr double shape_resolution = 2e-3;
/// What the squares of the spreads must add to the best score to be taken for a part of it.
constexpr double modulation_gain = 4;

/// Least and largest of some values.
struct Range {
  double low = infinity, high = -infinity;
  void add(double below, double above) { low = std::min(low, below), high = std::max(high, above); }
  [[nodiscard]] double size() const { return std::max(high - low, 0.0); }
};

/// Half the range of e without `amplitude` times the shape.
double half_range_without(const Series& series, double amplitude, const Shape& shape) {
  Range range;
  for (std::size_t i = 0; i < series.blocks.size(); ++i) {
    const double trend = amplitude * shape(series.s[i]);
    range.add(series.blocks[i].minimum - trend, series.blocks[i].maximum - trend);
  }
  return range.size() / 2;
}

/// The number of times that the values turn round by more than `least`.
std::size_t turns_of(const std::vector<double>& values, double least) {
  std::size_t turns = 0;
  int direction = 0;
  double extreme = values.front();
  for (const double e : values) {
    if (direction >= 0 && e > extreme) extreme = e, direction = 1;
    if (direction <= 0 && e < extreme) extreme = e, direction = -1;
    if (direction != 0 && std::abs(e - extreme) > least) {
      ++turns;
      direction = -direction;
      extreme = e;
    }
  }
  return turns;
}

/// The extremes of the blocks that begin at `first` (scaled time) or later, in the order in which they were
/// taken.
std::vector<double> extremes_of(const Series& series, double first = 0) {
  std::vector<double> extremes;
  for (std::size_t i = 0; i < series.blocks.size(); ++i) {
    const Block& block = series.blocks[i];
    if (series.s[i] < first) continue;
    if (block.minimum_first) {
      extremes.insert(extremes.end(), {block.minimum, block.maximum});
    } else {
      extremes.insert(extremes.end(), {block.maximum, block.minimum});
    }
  }
  return extremes;
}

/// The number of periods of a regular oscillation: how often the values rise from the lowest third of their
/// range to the highest. 0 where the longest time between two of these is more than 1.5 times the shortest.
std::size_t periods_of(const Series& series, double range) {
  double low = infinity;
  for (const Block& block : series.blocks) low = std::min(low, block.minimum);
  std::size_t periods = 0;
  bool below = false;
  double last = 0;
  Range between;
  for (std::size_t i = 0; i < series.blocks.size(); ++i) {
    const Block& block = series.blocks[i];
    const bool high = block.maximum > low + range * 2 / 3;
    if (below && high) {
      if (periods++ > 0) between.add(series.s[i] - last, series.s[i] - last);
      last = series.s[i];
      below = false;
    }
    if (block.minimum < low + range / 3 && !(high && block.minimum_first)) below = true;
  }
  return between.high <= 1.5 * between.low ? periods : 0;
}

/// max |e| in each twentieth of the run.
void maxima_of(const Series& series, Facts& facts) {
  std::array<double, twentieths> maxima{};
  for (std::size_t i = 0; i < series.blocks.size(); ++i) {
    const auto k = std::min(std::size_t(series.s[i] * double(twentieths)), twentieths - 1);
    maxima[k] = std::max({maxima[k], std::abs(series.blocks[i].minimum), std::abs(series.blocks[i].maximum)});
  }
  std::vector<double> s, sizes;
  for (std::size_t k = 0; k < twentieths; ++k)
    if (maxima[k] > 0) {
      s.push_back((double(k) + 0.5) / double(twentieths));
      sizes.push_back(maxima[k]);
    }
  facts.maxima = windows::exponential_fit(s, sizes, 3);
}

void ranges_of(const Series& series, const std::vector<double>& means, Facts& facts) {
  Range all, after_start, first, second, of_means, late_means, settled_means;
  for (std::size_t i = 0; i < series.blocks.size(); ++i) {
    const Block& block = series.blocks[i];
    all.add(block.minimum, block.maximum);
    if (i > 0) after_start.add(block.minimum, block.maximum);
    (series.s[i] < 0.5 ? first : second).add(block.minimum, block.maximum);
  }
  for (std::size_t j = 0; j < means.size(); ++j) {
    of_means.add(means[j], means[j]);
    if (2 * j + 1 >= means.size()) late_means.add(means[j], means[j]);
    if (4 * j + 3 >= means.size()) settled_means.add(means[j], means[j]);
  }
  facts.range = all.size();
  facts.range_after_start = after_start.size();
  facts.late_turns = turns_of(extremes_of(series, 0.5), std::max(0.1 * second.size(), 0.001 * all.size()));
  facts.first_half = first.size() / all.size();
  facts.shared =
      Range{std::max(first.low, second.low), std::min(first.high, second.high)}.size() / all.size();
  facts.range_of_means = of_means.size();
  facts.late_range_of_means = late_means.size();
  facts.settled_range_of_means = settled_means.size();
}

/// How far the series is away from zero in its last eighth: the smallest window mean there. 0 where means are
/// on both sides, or where a sample comes as near as `near`: an oscillation returns, what is lost does not.
double away_at_last(const Series& series, const std::vector<double>& means, double near) {
  const double side = means.back() > 0 ? 1 : -1;
  double away = infinity, nearest = infinity;
  for (std::size_t j = means.size() - means.size() / 8; j < means.size(); ++j)
    away = std::min(away, side * means[j]);
  for (std::size_t i = 0; i < series.blocks.size(); ++i)
    if (series.s[i] > 0.875)
      nearest = std::min(nearest, side > 0 ? series.blocks[i].minimum : -series.blocks[i].maximum);
  return nearest > near ? std::max(away, 0.0) : 0;
}

/// What a trend has to beat: a smooth wander is taken for noise only where it is clearly better, since a
/// power is smooth too.
double noise_of(const windows::Scores& scores) {
  return std::max({scores.without_trend(Noise::white).score, scores.without_trend(Noise::walk).score,
                   scores.without_trend(Noise::smooth).score - 5});
}

/// The best trend and what it has to beat, with handicaps: a line is likelier than a power, and an
/// exponential less likely.
void compare(const windows::Scores& scores, const Series& series, Facts& facts) {
  facts.white = scores.without_trend(Noise::white).score;
  facts.walk = scores.without_trend(Noise::walk).score;
  facts.smooth = scores.without_trend(Noise::smooth).score;
  facts.noise = noise_of(scores);
  facts.shape_scores = scores.shape_scores();
  facts.shapes = scores.models().shapes;
  facts.trend = -infinity;
  facts.slowest = 0;
  windows::Explanation best{};
  for (const auto& [kind, handicap] :
       {std::pair{Shape::Kind::line, 2.0}, {Shape::Kind::power, 0.0}, {Shape::Kind::exponential, -2.0}})
    if (const auto& e = scores.with_trend(kind); e.score + handicap > facts.trend) {
      facts.trend = e.score + handicap;
      best = e;
    }
  facts.shape = best.shape;
  facts.arc = scores.arc();
  const Shape& shape = facts.shapes[facts.shape];
  const windows::Scores::Fit fit = scores.fit(best);
  facts.jump = std::abs(fit.shape * (shape(1) - shape(0)));
  facts.rest = half_range_without(series, fit.shape, shape);
  facts.oscillation = half_range_without(series, facts.slope.value, {Shape::Kind::line, 1});

  const std::vector<double> frequencies = scores.frequencies();
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    if (fit.lines[k] >= 0.05 * facts.oscillation && (facts.slowest == 0 || frequencies[k] < facts.slowest))
      facts.slowest = frequencies[k];
}

/// Scores, and the slope. An oscillation whose size is modulated, as by a beat, moves the means with the
/// square of its size. Where means move by less than half of the range of e, noise or a trend beside that is
/// asked for too.
void scores_of(const windows::Windows& seen, double resolution, const Series& series, Facts& facts) {
  const windows::Scores alone(seen.mean, resolution, shape_resolution);
  facts.slope = windows::Scores(seen.mean, resolution, 0).slope();
  compare(alone, series, facts);
  if (facts.range_of_means >= 0.5 * facts.range || std::max(facts.trend, facts.walk) <= facts.white + 4)
    return;
  std::vector<double> squares;
  for (const double spread : seen.spread) squares.push_back(spread * spread);
  const windows::Scores modulated(seen.mean, resolution, shape_resolution, squares);
  facts.modulation = noise_of(modulated);
  if (modulated.best() <= alone.best() + modulation_gain) return;
  facts.slope = windows::Scores(seen.mean, resolution, 0, squares).slope();
  compare(modulated, series, facts);
}

}  // namespace

Facts facts_of(const Observed& observed) {
  Facts facts;
  const Series& series = observed.series;
  facts.samples = series.samples;
  facts.maximum = observed.maximum;
  const auto windows = windows::over_windows(
      series, facts.samples < few_samples ? windows::few_windows : windows::many_windows);
  const auto spreads = windows::over_windows(series, windows::few_windows);
  if (windows.mean.empty() || spreads.mean.empty()) return facts;
  facts.means = windows.mean;
  const double resolution = observed.round_off.scale > 0
                                ? 0.3 * observed.round_off.unit * observed.round_off.scale
                                : std::numeric_limits<double>::epsilon() / 2 * observed.maximum;
  ranges_of(series, windows.mean, facts);
  scores_of(windows, resolution, series, facts);
  maxima_of(series, facts);
  facts.spreads = spreads.spread;
  facts.turns = turns_of(extremes_of(series), 0.02 * facts.range);
  facts.periods = periods_of(series, facts.range);
  facts.turns_of_means = turns_of(windows.mean, 0.2 * facts.range_of_means);
  facts.curve = facts.turns < 16 && !(facts.slowest >= 2);
  const auto steps = double(observed.rises + observed.falls);
  facts.one_sided = double(std::max(observed.rises, observed.falls)) >= 0.85 * steps;
  if (const double range = observed.round_off.own_range(); range > 0 && facts.periods < 2)
    facts.lost = away_at_last(series, windows.mean, 0.25 * range) / range;
  return facts;
}

Parameter parameter_of(const Facts& facts, Shape::Kind kind) {
  std::vector<double> score, parameter;
  for (std::size_t k = 0; k < facts.shapes.size(); ++k)
    if (facts.shapes[k].kind == kind) {
      score.push_back(facts.shape_scores[k]);
      parameter.push_back(facts.shapes[k].parameter);
    }
  const auto at = std::size_t(std::max_element(score.begin(), score.end()) - score.begin());
  Parameter result;
  result.at_end = at == 0 || at + 1 == score.size();
  const double half_step =
      std::sqrt(kind == Shape::Kind::power ? windows::power_ratio : windows::exponential_ratio);
  std::size_t low = at, high = at;
  while (low > 0 && score[low - 1] > score[at] - 1.92) --low;
  while (high + 1 < score.size() && score[high + 1] > score[at] - 1.92) ++high;
  // Between the points of the grid the top of the parabola through the best and its neighbours is taken.
  double shift = 0;
  if (!result.at_end) {
    const double left = score[at - 1] - score[at], right = score[at + 1] - score[at];
    if (left + right < 0) shift = 0.5 * (left - right) / (left + right);
  }
  result.estimate = {parameter[at] * std::pow(half_step * half_step, shift), parameter[low] / half_step,
                     parameter[high] * half_step};
  return result;
}

}  // namespace pfaff::drift_rules
