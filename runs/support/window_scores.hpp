// window_scores: how well each kind of noise, and each shape of a trend in it, explains the window means of a
// series.
//
// For the means m of B windows, a covariance C of window_models.hpp and columns X (the constant, a shape or
// none, slow lines), the residual square r is the least of (m - X b)' C^(-1) (m - X b), and
//     log L = -1/2 log|C| - B/2 log v - r/(2 v),    v = r/B, but not below the square of the resolution.
// Nor is v, as white noise, below the square of a part of the means' range that is given: shapes have the
// parameters of a grid, and what a power between two of them leaves is no oscillation.
// score = log L - 1/2 log B for each parameter besides the constant [schwarz1978]: an amplitude, an exponent
// or a rate, the share of a walk, and three for a slow line. Scores of one series are comparable, and a
// difference is the logarithm of the odds.
//
// Slow lines (a cosine and a sine of one frequency) join every explanation, one after the other and at most
// three, as long as one raises the best score by more than 8: some 45 frequencies are tried.
//
// Beside the constant there may be a given number for each window, as one more parameter: what a modulated
// oscillation does to the means goes with the square of its size.
//
// Slope. Generalised least squares of (1, s, slow lines) gives for each covariance a slope and a Student
// interval; the mixture of them has the weights of the restricted likelihood times prior weights of the kinds
// of noise, W .5, R .4, S .1. Its 95 % interval is widened by 1.2: that brings the worst kind of series
// tried, a line in a hidden walk, to 95 %.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/runs/support/window_models.hpp>

namespace pfaff::windows {

/// An explanation: its score, and which covariance and shape make it.
struct Explanation {
  double score;
  std::size_t covariance;
  std::size_t shape;  // no_shape: no trend
};
inline constexpr std::size_t no_shape = static_cast<std::size_t>(-1);

/// A slope in units of the values per unit of s, and its 95 % interval.
struct Slope {
  double value = 0, low = 0, high = 0;
};

/// The scores of every explanation of one series.
class Scores {
 public:
  /// `means`: those of few_windows or many_windows; `resolution` > 0: the size below which nothing counts as
  /// evidence; `shape_resolution`: the same, as a part of the range of the means; `beside`: for each window a
  /// number whose multiples are a part of every explanation, or none.
  Scores(const std::vector<double>& means, double resolution, double shape_resolution,
         const std::vector<double>& beside = {});
  ~Scores();
  Scores(const Scores&) = delete;
  Scores& operator=(const Scores&) = delete;

  /// The best explanation without a trend, by kind of noise.
  [[nodiscard]] const Explanation& without_trend(Noise noise) const { return plain_[std::size_t(noise)]; }
  /// The best explanation with a trend of this kind, in white noise or a walk.
  [[nodiscard]] const Explanation& with_trend(Shape::Kind kind) const { return trend_[std::size_t(kind)]; }
  /// The best score of every shape, in the order of the models.
  [[nodiscard]] const std::vector<double>& shape_scores() const { return shape_scores_; }
  /// The best score of an arc, of less than one period of an oscillation, in white noise or a walk.
  [[nodiscard]] double arc() const;
  /// The slow lines that joined: their frequencies in periods a run.
  [[nodiscard]] std::vector<double> frequencies() const;
  /// The best score of all explanations.
  [[nodiscard]] double best() const;
  [[nodiscard]] const WindowModels& models() const { return models_; }

  /// Amplitudes of an explanation's shape (0 for none) and of its slow lines.
  struct Fit {
    double shape = 0;
    std::vector<double> lines;
  };
  [[nodiscard]] Fit fit(const Explanation& explanation) const;

  [[nodiscard]] Slope slope() const;

 private:
  /// The series through one covariance, freed of the constant, of what is beside it and of the slow lines
  /// that have joined.
  struct Seen {
    std::vector<double> data;      // inner products with the columns
    std::vector<double> products;  // of the columns with each other, where they are not the models' own
    double square = 0;             // of the data
    double log_pivots = 0;         // log of the determinant of X' C^(-1) X for the constant and the lines
    std::vector<double> original;  // `data` before any slow line joined
    std::vector<double> beside;    // inner products of the columns with what is beside, of unit length
  };
  void through(const Covariance& c, const std::vector<double>& values, double origin,
               std::vector<double>& result) const;
  [[nodiscard]] double score(std::size_t covariance, double square, double parameters) const;
  [[nodiscard]] const std::vector<double>& products(std::size_t covariance) const;
  [[nodiscard]] double square_with(std::size_t covariance, std::size_t column) const;
  [[nodiscard]] double least_square_of(std::size_t covariance) const;
  void rank_explanations();
  [[nodiscard]] double best_with_line(std::size_t frequency, bool beside_shapes) const;
  void join(std::size_t frequency);

  const WindowModels& models_;
  double shape_square_;
  double scale_ = 1, least_square_ = 0;  // unit of the data; smallest v
  std::size_t beside_ = 0;               // columns beside the constant: 1, or none
  std::vector<Seen> seen_;
  std::vector<std::size_t> joined_;  // slow lines, as indices of frequencies
  std::vector<Explanation> plain_, trend_;
  std::vector<double> shape_scores_;
};

}  // namespace pfaff::windows
