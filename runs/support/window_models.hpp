// window_models: what the window means of a series are compared with: shapes of a trend, kinds of noise, and
// slow oscillations; computed once per process for 15 and for 31 windows.
//
// Noise. The means of B windows have a covariance C that is that of a process on a fine grid, filtered by the
// windows, and scaled so that the trace of C without mean and line is B:
//     white    independent values, mixed with the share 0, .8 or .96 of differences of independent values:
//              these are what fast oscillations leave;
//     walk     white, mixed with the share .02 ... 1 of their running sum (10 values);
//     smooth   white, mixed with the share .5 ... 1 of the running sum of a running sum (5 values), which
//              wanders as smoothly as an oscillation of which the run shows less than a period.
// Shapes of a trend, on scaled time s in (0, 1), filtered in the same way: s; s^p with p = 1.04^k, k = -16 ..
// 48; exp(lambda (s - 1)) with lambda = 2 1.12^k, k = -12 .. 26. Slow lines: cos and sin of 1 .. 12 periods a
// run (1 .. 6 for 15 windows, which see no faster ones) in steps of a quarter. Arcs: those of 1/4 .. 7/8 in
// steps of an eighth.
//
// For each covariance the columns (shapes, cosines and sines) are whitened, freed of the constant, and scaled
// to unit length; `products` are their inner products. Every regression is then elimination in a small table.
#pragma once

#include <cstddef>
#include <vector>

namespace pfaff::windows {

enum class Noise { white, walk, smooth };

/// s, s^parameter or exp(parameter (s - 1)).
struct Shape {
  enum class Kind { line, power, exponential } kind = Kind::line;
  double parameter = 1;
  double operator()(double s) const;
};

/// One covariance of the window means, C = L L', and the columns seen through it.
struct Covariance {
  Noise noise;
  double log_determinant;        // of C
  double stiffness;              // the trace of its inverse over that of white noise, at least 1
  std::vector<double> whitener;  // the inverse of L, row by row
  std::vector<double> constant;  // the whitened constant, of unit length
  double constant_norm;          // the length of it before
  std::vector<double> columns;   // [column][window], whitened, orthogonal to the constant, of unit length
  std::vector<double> norms;     // their lengths before
  std::vector<double> products;  // [column][column]
};

/// All models for one number of windows.
struct WindowModels {
  std::size_t windows;
  std::vector<Shape> shapes;        // columns 0 .. shapes.size() - 1: the line, the powers, the exponentials
  std::vector<double> frequencies;  // then a cosine and a sine for each, in periods a run, rising
  std::size_t arcs;                 // how many of the frequencies are below one period a run
  std::vector<Covariance> covariances;

  [[nodiscard]] std::size_t column_count() const { return shapes.size() + 2 * frequencies.size(); }
  [[nodiscard]] std::size_t cosine(std::size_t frequency) const { return shapes.size() + 2 * frequency; }
};

inline constexpr std::size_t few_windows = 15, many_windows = 31;
inline constexpr std::size_t power_count = 65, exponential_count = 39;
inline constexpr double power_ratio = 1.04, exponential_ratio = 1.12;

/// The models for few_windows or many_windows.
const WindowModels& window_models(std::size_t windows);

}  // namespace pfaff::windows
