// low_frequency: inference on the slow part of a time series: is there a trend, how large, and what kind of
// noise is it drawn in? Used by drift.cpp; knows nothing of invariants or integrators.
//
// Data: B block means m_i at scaled times s_i = (t_i - origin) / span in (0, 1), of n_i samples each.
//
// Projection. With the taper w_i ~ n_i s_i (1 - s_i), sum w_i = 1, let p_1 .. p_q be the polynomials of
// degree 1 .. q, orthonormal under sum_i w_i p_j p_k and orthogonal to 1 (Stieltjes' recurrence). The series
// is reduced to   Y_n = sum_i w_i p_n(s_i) m_i,   q = min(32, 2 sqrt(B), B - 1). Everything faster than
// about q/2 cycles per run is thereby averaged away. The taper vanishes at both ends, so an oscillation of N
// >> q periods leaks into Y as O(1/N^2), not as the O(1/N) of plain least squares; the price is a slope that
// is 1.2 times (white noise) or 1.09 times (random walk) less precise.
//
// Slope. p_1 is a straight line, hence slope = Y_1 / (d s / d p_1): weighted least squares. Y_2 .. Y_q
// contain no trend and measure the noise at just the time scales that disturb the slope: the series
// estimator of the long-run variance in trend inference [sun2011trend], in the low-frequency form
// of [muller2016longrun].
//
// Noise model: Y - trend ~ N(0, omega V(b, c, d)), the (b, c, d) model of [muller2016longrun], its spectrum
//     S(f) ~ (f^2 + c^2)^(-d) + constant          (f, c in radians per run)
// d = 0: white; d = 1, c = 0: random walk; d = 1, c > 0: AR(1) of correlation time 1/c; d >= 2, c > 0: slow
// oscillations; d < 0: what is left of fast oscillations. V = (1 - b) V(0, c, d) + b V(0, 0, 0), both terms
// of trace 32; indexed 1 .. q, symmetric. V is computed once per process on N = 400 points from the moving
// average of (1 - e^(-c/N) L)^(-d), with weights psi_k = e^(-c/N) psi_(k-1) (k-1+d)/k
// [hosking1981 (2.1) with -d], started at zero as an invariant's error is.
//
// For each cell of a fixed grid of (b, c, d), with omega and a slope integrated out under flat priors (on
// log omega, and on the slope), the density of Y_2 .. Y_q is
//     log L = -1/2 log|V_22| - (q-1)/2 log R,    R = Y_2' V_22^(-1) Y_2   (index 2: rows 2 .. q)
// and Y_1 - trend is Student with q-1 degrees of freedom and scale s = sqrt(R V_11 / (q-1)). (Exact when Y_1
// and Y_2 .. Y_q are uncorrelated; approximate otherwise, and the tests measure how well.) The reported
// interval is the 95 % interval of the mixture over the grid, weighted by prior and L: no bandwidth has to
// be chosen.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace pfaff::low_frequency {

inline constexpr std::size_t most_projections = 32;
using Coefficients = std::array<double, most_projections>;

/// What the noise does in the long run.
/// - steady: stationary (white noise, AR(1), an oscillation of at least about one and a half periods), and
/// 1/f noise.
/// - walk: c = 0 and 3/4 <= d <= 3/2, growing like t^(d - 1/2).
/// - smooth: c = 0 and d >= 2, a differentiable wander, of which one run shows too little to tell a trend
/// from an oscillation.
enum Noise : std::size_t { steady, walk, smooth };
using PerNoise = std::array<double, 3>;

/// The block means of a series: scaled times s in (0, 1), increasing; values; and the number of samples in
/// each block, by which it is weighted. All three have the same length B >= 4.
struct Samples {
  std::vector<double> s, value, count;
};

/// Slope d value / d s of the trend, and half the width of its 95 % interval.
struct Slope {
  double value = 0, half_width = 0;
};

/// The series, projected and compared with every noise model of the grid.
class Projection {
 public:
  /// `resolution` > 0 is the round-off error of one value; the noise is never taken to be smaller than that.
  Projection(const Samples& samples, double resolution);

  /// Number q of projections, 3 .. 32.
  std::size_t size() const { return size_; }

  Slope slope() const;

  /// log_evidence: log p(Y | no trend, kind of noise), up to a constant common to all evidences of this
  /// object. walk_exponent: the growth exponent d - 1/2, averaged over the random walks.
  struct NoiseEvidence {
    PerNoise log_evidence;
    double walk_exponent;
  };
  NoiseEvidence without_trend() const;

  /// log p(Y | a + A f(s) + steady noise or random walk), up to the same constant. The amplitude A is set to
  /// its best value, and log(q)/2 is subtracted for that fitted parameter [schwarz1978].
  double with_trend(const std::function<double(double)>& f) const;

 private:
  Coefficients project(const std::function<double(std::size_t)>& value) const;

  std::size_t size_;
  std::vector<double> s_, weight_;
  std::vector<std::vector<double>> polynomial_;   // [n - 1][i], degree n at block i
  double scale_ = 1, noise_floor_;                // ds/dp_1; smallest R, q resolution^2
  std::vector<Coefficients> whitened_;            // per cell: L^(-1) Y, V = L L'
  std::vector<double> square_, log_determinant_;  // per cell: |L^(-1) Y|^2, log|V|
};

}  // namespace pfaff::low_frequency
