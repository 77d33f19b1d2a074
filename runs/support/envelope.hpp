// envelope: how the size of a series grows: exponentially, or as a power of time, by fits to the logarithms
// of sizes in consecutive parts of the run.
#pragma once

#include <optional>
#include <vector>

namespace pfaff::windows {

/// A number and its 95 % interval.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

/// Spearman's rank correlation of a series with its index: 1 where it never falls.
double rank_correlation(const std::vector<double>& values);

/// The fit of exp(rate s) to sizes.
struct ExponentialFit {
  double growth = 0;   // last size over the first
  double scatter = 0;  // rms of the logarithms about the fit
  double power_scatter = 0;
  bool steady = false;  // every condition of exponential_fit holds but the comparison with a power
  bool grows = false;   // every condition holds
  Estimate rate;        // per unit of s; the interval is +-4.2 standard errors
};

/// Whether positive sizes at scaled times s grow exponentially. They do where they rise nearly always (rank
/// correlation above .85), grow more than 100-fold, and, after they have left three times the first size,
/// which may be a floor of round-off, still more than 20-fold in at least five of them; where the logarithms
/// of those scatter about a line in s by less than .75 of their scatter about a line in log s and by less
/// than a quarter of the logarithm of the growth; and where the slopes of the thirds of that line differ by
/// less than the factor `agreement`.
ExponentialFit exponential_fit(const std::vector<double>& s, const std::vector<double>& sizes,
                               double agreement);

/// The fit of A s^exponent to the spreads of a series in few_windows windows, with a constant spread beside
/// it where that explains them much better.
struct PowerFit {
  Estimate exponent;
  double scatter = 0;  // rms of the logarithms about the fit
};
/// Compares the squares of spreads with the windows' means of s^(2 exponent), so that the first windows,
/// which see small and larger s at once, do not bend the exponent down. Nothing where the best exponent is at
/// an end of the search, .1 ... 8.
std::optional<PowerFit> power_fit(const std::vector<double>& spreads);

}  // namespace pfaff::windows
