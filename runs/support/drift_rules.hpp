// drift_rules: by which class a series of errors is called, and why. Fewer rules than a statistician would
// like, so that a reader can check each by eye.
//
// Statistics (window_scores.hpp): the log evidences, in window means of e, of noise without a trend that is
// white (W), a walk (R) or a smooth wander (S), and of the best line (L), power (P) and exponential (E) in
// noise; f, the lowest slow oscillation, in periods a run, of at least 5 % of the oscillation; the trend's
// change over the run ("jump") and half the range of what is left beside it ("rest"); turns of e by more than
// 2 % of its range; A, the log evidence of an arc of less than one period of an oscillation; V, that of noise
// beside a multiple of the squared spread, which is what an oscillation of changing size does to the means:
// where the means move by less than half of the range of e and V has the best score by more than 4, that
// multiple is a part of every explanation. A series that
// turns less than 16 times and shows no two periods of an oscillation is a "curve". u is the unit of
// round-off, M the largest sum of the magnitudes of the quantity's terms, R what each step propagates of the
// roundings of the state (output_gradients.hpp; M where it is unknown), N the number of steps; n the number
// of samples.
//
// The first rule that applies decides:
//     e = 0 throughout                                         exact
//     n < 32                                                   undetermined
//     max <= u M + 8 u R sqrt(N)                               round-off
//     at most 4 values, 4 u M apart or less                    round-off
//     ... min(n/4, 40), max <= 4 times the bound above         round-off        no trend
//     maxima of twentieths of the run grow exponentially       exponential
//     the spread grows threefold and exceeds jump/4            exponential, linear, polynomial, by its fit
//     means move < 10 % in the second half                     bounded **       levels off; n >= 96
//     0 < f < 2, jump < 50 times the oscillation               undetermined     too few periods
//     a trend beats noise by more than 4:
//         A beats the trend by more than 2                     undetermined     goes on below if by < 2 %
//         jump < 1 % of rest, or < 3 %, slope not known to 8 % bounded *
//         jump < 1/f of rest, f = 4 ... 8, slope known to 8 %  undetermined
//         jump < 1/f of rest, f < 8                            bounded *
//         no line, jump < rest: by 15 and .3 of rest, or       goes on below
//         line, or power .75 ... 1.3:                          linear           no curve, rest > 12 % of jump
//           jump < rest, and V is within 2 of the trend, or
//           the spread rises or falls throughout by jump/2     undetermined     it changes its size
//           jump < rest, and noise is beaten by less than 6    undetermined
//         power > 1.3                                          polynomial       not at its search's end
//         exponential, rate 2 ... 16 a run                     exponential      not at its search's end
//         exponential, rate < 2 a run                          linear, polynomial, by the best power
//     range of means < 10 % of the range of e                  bounded *
//     means move < 18 % in the second half                     bounded **       levels off; n >= 96
//     ... or < 22 %, and < 35 % after the first quarter        bounded **       levels off; n >= 96
//     A beats every trend and noise by more than 6             undetermined     less than a period
//     a trend of power < .75                                   undetermined     sublinear
//     W > max(R, S - 5) - 6                                    bounded *        a curve of < 3 swings: **
//     f >= 2, halves of the run share >= 75 % of the range     bounded *
//     e swings 4 times between the outer thirds of its range,
//       at regular times, halves share >= 60 % of the range    bounded *
//     range of means < half of that of e, halves share >= 75 % bounded *        no walk beside an oscillation
//     n < 96, or 85 % of the steps of one sign, or a curve     undetermined
//     first half covers < 10 % of the range                    undetermined     an event
//     R < S - 5, means turn 5 times, halves share >= 70 %      bounded *
//     R >= S - 2                                               random-walk      else undetermined
// * undetermined if the first half of the run covers less than half of the range: bursts, events.
// ** undetermined if e turns less than 4 times in the second half, by a tenth of its range there and .1 % of
// the whole, unless it is one number behind its first block: RK4 loses energy once in a period of Kepler's
// motion, of which the run may be a part, and a planet that has escaped, or what has come to rest, no longer
// tries the method.
// Every class that grows as a power excludes no growth: its slope's interval, or that of its exponent for a
// growing spread, does not contain 0; if it does, the class is undetermined.
// A trend within one unit of round-off a step, max <= u M + u R N, is biased-round-off.
// A line within 5 % of the change over the run needs to beat W and R only. A walk has the exponent that its
// means have (walk_exponent.hpp).
//
// What is lost is never bounded. A quantity is lost where the means of the last eighth of the run are away by
// half of its own range (own_range.hpp) or more, to one side, and no sample there comes back to a quarter of
// it, as an oscillation would; nor is it one that has swung twice between the outer thirds of the range of e.
// Having nothing left to lose it levels off, which says nothing for the method. Where nothing that grows was
// found in the whole run, the run is judged anew up to where half was lost, and, since a loss that slows down
// is no line, up to where a tenth was: the first of them with a trend gives the class, the exponent, the rate
// and the slope. Without one, as where less than 32 samples were taken before, it is undetermined in place of
// bounded. A run that ends in numbers that are not finite, or a thousand times the range, after growing a
// thousandfold, is exponential.
//
// Constants. 8 sqrt(N) u: walks of at most 3 u a step reach it at 2.5 standard deviations. 1 %: invisible
// beside the oscillation. Log evidences of 4, 6, 8: odds of 50, 400, 3000. Of a line 2 are added and of an
// exponential 2 taken; a walk rarely scores below 10 while what fast oscillations leave often has 3 to 5. 5
// on S: a power is smooth too. 2 on A beside a trend: an arc fits many a line by chance; 6 beside noise: many
// a walk. 16 turns: 1 % of walks of 100 samples turn less than 23 times, a single swing less than 15.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pfaff/runs/support/drift.hpp>
#include <pfaff/runs/support/window_scores.hpp>

namespace pfaff::drift_rules {

/// What is known of a series.
struct Observed {
  windows::Series series;  // on scaled time; without blocks where there are less than two samples
  /// The start of the series in blocks that are shorter, the shortest first.
  std::vector<std::vector<windows::Block>> starts;
  std::vector<double> values;  // the different values, as many as are kept
  std::size_t rises = 0, falls = 0;
  double maximum = 0;  // max |e|
  std::optional<double> non_finite_time;
  RoundOff round_off;
};

/// The part of a run before a quantity was lost: its slope per unit of scaled time, and that in time.
struct StartOfRun {
  windows::Slope slope;
  double span = 1;
};

/// Slope and rate are per unit of scaled time: the rate per unit of that of the start, where there is one.
struct Verdict {
  DriftClass drift_class = DriftClass::undetermined;
  std::string evidence;
  std::optional<windows::Estimate> exponent = {}, rate = {};
  std::optional<windows::Slope> slope = {};
  std::optional<StartOfRun> of_start = {};
};

Verdict judge(const Observed& observed);

}  // namespace pfaff::drift_rules
