// drift_facts: the numbers that the rules of drift_rules.hpp ask for, of one series.
#pragma once

#include <cmath>
#include <vector>

#include <pfaff/runs/support/drift_rules.hpp>

namespace pfaff::drift_rules {

/// Numbers about a series of at least 32 samples; scores are log evidences (window_scores.hpp).
struct Facts {
  std::size_t samples = 0;
  std::vector<double> means;  // of the windows; where there are none, only `samples` is known
  double maximum = 0;         // max |e|
  double white = 0, walk = 0, smooth = 0;
  std::vector<double> shape_scores;    // of every shape of the models
  std::vector<windows::Shape> shapes;  // the models' shapes
  windows::Slope slope;                // per unit of scaled time
  double trend = 0, noise = 0;         // scores with handicaps: of the best trend, of what it has to beat
  std::size_t shape = 0;               // of the best trend
  double modulation = -HUGE_VAL;       // what noise beside a modulated oscillation scores, where asked for
  double arc = 0;                      // score of the best arc of an oscillation
  double jump = 0, rest = 0;           // its change over the run, and half the range of e beside it
  double oscillation = 0;              // half the range of e beside the line
  double slowest = 0;                  // f, 0 for none
  double range = 0, range_of_means = 0,
         late_range_of_means = 0,     // of e; of all means; of those of the second half
      settled_range_of_means = 0;     // of those after the first quarter
  double range_after_start = 0;       // of e behind the first block
  double first_half = 0, shared = 0;  // shares of the range of e: of the first half; what both halves have
  std::size_t turns = 0,
              turns_of_means = 0;  // by more than 2 % of the range; of the means, by 20 % of theirs
  std::size_t late_turns = 0;      // of the second half, by a tenth of its own range and .1 % of the whole
  std::size_t periods = 0;         // of a regular oscillation of the size of e
  bool curve = false, one_sided = false;
  windows::ExponentialFit maxima;  // of twentieths
  std::vector<double> spreads;     // in few_windows windows
  double lost = 0;                 // share of the quantity's own range by which the last eighth is away

  [[nodiscard]] bool accepted() const { return trend > noise + 4; }
  [[nodiscard]] double evidence() const { return trend - noise; }
};

/// With fewer samples a walk cannot be told from an oscillation, and spreads are those of fewer windows.
inline constexpr std::size_t few_samples = 96;

Facts facts_of(const Observed& observed);

/// The exponent or the rate of a shape, with its likelihood interval: the parameters whose score is
/// within 1.92 of the best, and half a step of the grid more. `at_end`: the best is the first or the last of
/// its kind.
struct Parameter {
  windows::Estimate estimate;
  bool at_end = false;
};
Parameter parameter_of(const Facts& facts, windows::Shape::Kind kind);

}  // namespace pfaff::drift_rules
