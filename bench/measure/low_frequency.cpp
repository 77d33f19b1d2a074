#include <algorithm>
#include <cmath>
#include <numbers>
#include <pfaff/bench/measure/low_frequency.hpp>

namespace pfaff::low_frequency {
namespace {

using Vector = std::vector<double>;
using Matrix = std::array<Coefficients, most_projections>;

/// Prior weights of the kinds of noise when the slope is estimated. Few runs wander, so the weights of walk
/// and smooth noise are small; where a run does wander, the data overrule them by many orders of magnitude.
constexpr PerNoise slope_prior{0.923, 0.07, 0.007};
/// Prior weights of the kinds of noise when the presence of a trend in it is tested.
constexpr PerNoise trend_noise_prior{0.7, 0.3, 0.0};

Vector tapered(const Vector& s, const Vector& count) {
  Vector weight(s.size());
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) sum += weight[i] = count[i] * s[i] * (1 - s[i]);
  for (double& w : weight) w /= sum;
  return weight;
}

/// Values [n - 1][i] of the polynomials of degree n = 1 .. q, orthonormal under the weights.
std::vector<Vector> orthonormal_polynomials(const Vector& s, const Vector& weight, std::size_t q) {
  const std::size_t blocks = s.size();
  std::vector<Vector> p{Vector(blocks, 1.0)};
  Vector previous(blocks, 0.0);
  double norm = 0;  // of the polynomial last built, before it was normalised
  for (std::size_t n = 0; n < q; ++n) {
    double center = 0;
    for (std::size_t i = 0; i < blocks; ++i) center += weight[i] * s[i] * p[n][i] * p[n][i];
    Vector next(blocks);
    for (std::size_t i = 0; i < blocks; ++i) next[i] = (s[i] - center) * p[n][i] - norm * previous[i];
    norm = 0;
    for (std::size_t i = 0; i < blocks; ++i) norm += weight[i] * next[i] * next[i];
    norm = std::sqrt(norm);
    for (double& value : next) value /= norm;
    previous = p[n];
    p.push_back(std::move(next));
  }
  p.erase(p.begin());
  return p;
}

/// Covariance of the projections of the process (1 - e^(-c/N) L)^(-d) white noise, scaled to trace 32.
Matrix covariance(const std::vector<Vector>& p, const Vector& weight, double c, double d) {
  const std::size_t points = weight.size();
  Vector psi(points, 1.0);
  for (std::size_t k = 1; k < points; ++k)
    psi[k] = psi[k - 1] * std::exp(-c / double(points)) * (double(k) - 1 + d) / double(k);
  std::vector<Vector> response(most_projections, Vector(points));  // of Y_n to the noise at point j
  for (std::size_t n = 0; n < most_projections; ++n)
    for (std::size_t j = 0; j < points; ++j)
      for (std::size_t i = j; i < points; ++i) response[n][j] += psi[i - j] * weight[i] * p[n][i];
  Matrix v{};
  double trace = 0;
  for (std::size_t n = 0; n < most_projections; ++n) {
    for (std::size_t m = 0; m <= n; ++m)
      for (std::size_t j = 0; j < points; ++j) v[n][m] += response[n][j] * response[m][j];
    trace += v[n][n];
  }
  for (Coefficients& row : v)
    for (double& entry : row) entry *= double(most_projections) / trace;
  return v;
}

/// One noise model: V = (1 - b) V(c, d) + b V(white) = L L', and its prior weight within its kind.
struct Cell {
  Noise kind;
  double c, d, prior;
  Matrix cholesky;

  /// True where a trend may be tested in this noise. Noise that looks like an oscillation of one or two
  /// periods or like a smooth wander is excluded, because a trend cannot be told from it.
  bool carries_trend() const { return kind == walk || (kind == steady && (c == 0 || c > 10)); }

  void whiten(Coefficients& x, std::size_t q) const {
    for (std::size_t i = 0; i < q; ++i) {
      for (std::size_t j = 0; j < i; ++j) x[i] -= cholesky[i][j] * x[j];
      x[i] /= cholesky[i][i];
    }
  }
};

Matrix cholesky_of_mixture(const Matrix& v, const Matrix& white, double b) {
  Matrix l{};
  for (std::size_t i = 0; i < most_projections; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = (1 - b) * v[i][j] + b * white[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  return l;
}

/// The grid of noise models. White noise has half the weight of the steady kind. b >= 1e-4 keeps every V well
/// conditioned, so that no verdict rests on details of a model's spectrum below one per cent of its
/// amplitude.
std::vector<Cell> make_cells() {
  constexpr std::size_t points = 400;
  Vector s(points);
  for (std::size_t i = 0; i < points; ++i) s[i] = (double(i) + 0.5) / double(points);
  const Vector weight = tapered(s, Vector(points, 1.0));
  const std::vector<Vector> p = orthonormal_polynomials(s, weight, most_projections);
  const Matrix white = covariance(p, weight, 0, 0);

  struct Shape {
    Noise kind;
    double c, d, prior;
  };
  std::vector<Shape> shapes{{steady, 0, -1.5, 0.5}, {steady, 0, -1, 0.5}, {steady, 0, 0.25, 1},
                            {steady, 0, 0.5, 1},    {steady, 8, 2, 1},    {steady, 8, 3, 1},
                            {walk, 0, 0.75, 1},     {walk, 0, 1, 1},      {walk, 0, 1.25, 1},
                            {walk, 0, 1.5, 1},      {smooth, 0, 2, 1},    {smooth, 0, 3, 1}};
  for (double c : {16., 32., 64.})
    for (double d : {0.5, 1., 2., 3.}) shapes.push_back({steady, c, d, 1});

  std::vector<Cell> cells;
  PerNoise total{};
  for (const Shape& shape : shapes) {
    const Matrix v = covariance(p, weight, shape.c, shape.d);
    for (double b : {1e-4, 1e-3, 1e-2, 0.1, 0.5}) {
      if (shape.kind == smooth && b > 0.01) continue;  // too much like a trend in white noise
      cells.push_back({shape.kind, shape.c, shape.d, shape.prior, cholesky_of_mixture(v, white, b)});
      total[shape.kind] += shape.prior;
    }
  }
  for (Cell& cell : cells) cell.prior *= (cell.kind == steady ? 0.5 : 1.0) / total[cell.kind];
  cells.push_back({steady, 0, 0, 0.5, cholesky_of_mixture(white, white, 1)});
  return cells;
}

const std::vector<Cell>& grid() {
  static const std::vector<Cell> cells = make_cells();
  return cells;
}

/// P(T <= x) of Student's distribution, n >= 1 degrees of freedom [abramowitz-stegun1964 (26.7.3), (26.7.4)].
double student(double x, std::size_t n) {
  const double angle = std::atan(x / std::sqrt(double(n))), cosine = std::cos(angle);
  double term = n % 2 == 1 ? cosine : 1, sum = 0;
  for (std::size_t k = n % 2 == 1 ? 3 : 2; k <= n; k += 2) {
    sum += term;
    term *= cosine * cosine * double(k - 1) / double(k);
  }
  sum *= std::sin(angle);
  return 0.5 + 0.5 * (n % 2 == 1 ? 2 / std::numbers::pi * (angle + sum) : sum);
}

double dot(const Coefficients& a, const Coefficients& b, std::size_t q) {
  double sum = 0;
  for (std::size_t n = 0; n < q; ++n) sum += a[n] * b[n];
  return sum;
}

double log_sum(const Vector& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (double value : logs) sum += std::exp(value - top);
  return top + std::log(sum);
}

}  // namespace

Projection::Projection(const Samples& samples, double resolution)
    : size_(std::min(
          {most_projections, std::size_t(2 * std::sqrt(double(samples.s.size()))), samples.s.size() - 1})),
      s_(samples.s),
      weight_(tapered(samples.s, samples.count)),
      polynomial_(orthonormal_polynomials(s_, weight_, size_)),
      noise_floor_(double(size_) * resolution * resolution) {
  scale_ = project([&](std::size_t i) { return s_[i]; })[0];
  const Coefficients y = project([&](std::size_t i) { return samples.value[i]; });
  for (const Cell& cell : grid()) {
    whitened_.push_back(y);
    cell.whiten(whitened_.back(), size_);
    square_.push_back(dot(whitened_.back(), whitened_.back(), size_));
    log_determinant_.push_back(0);
    for (std::size_t n = 0; n < size_; ++n) log_determinant_.back() += 2 * std::log(cell.cholesky[n][n]);
  }
}

Coefficients Projection::project(const std::function<double(std::size_t)>& value) const {
  Coefficients y{};
  for (std::size_t i = 0; i < s_.size(); ++i) {
    const double weighted = weight_[i] * value(i);
    for (std::size_t n = 0; n < size_; ++n) y[n] += weighted * polynomial_[n][i];
  }
  return y;
}

Projection::NoiseEvidence Projection::without_trend() const {
  std::array<Vector, 3> logs;
  Vector walk_d;
  for (std::size_t k = 0; k < grid().size(); ++k) {
    const Cell& cell = grid()[k];
    logs[cell.kind].push_back(std::log(cell.prior) - 0.5 * log_determinant_[k] -
                              0.5 * double(size_) * std::log(square_[k] + noise_floor_));
    if (cell.kind == walk) walk_d.push_back(cell.d);
  }
  NoiseEvidence result{{log_sum(logs[steady]), log_sum(logs[walk]), log_sum(logs[smooth])}, -0.5};
  for (std::size_t k = 0; k < walk_d.size(); ++k)
    result.walk_exponent += walk_d[k] * std::exp(logs[walk][k] - result.log_evidence[walk]);
  return result;
}

double Projection::with_trend(const std::function<double(double)>& f) const {
  const Coefficients shape = project([&](std::size_t i) { return f(s_[i]); });
  Vector logs;
  for (std::size_t k = 0; k < grid().size(); ++k) {
    const Cell& cell = grid()[k];
    if (!cell.carries_trend()) continue;
    Coefficients x = shape;
    cell.whiten(x, size_);
    const double xy = dot(x, whitened_[k], size_);
    const double residual = std::max(square_[k] - xy * xy / dot(x, x, size_), 0.0);
    logs.push_back(std::log(cell.prior * trend_noise_prior[cell.kind]) - 0.5 * log_determinant_[k] -
                   0.5 * double(size_) * std::log(residual + noise_floor_));
  }
  return log_sum(logs) - 0.5 * std::log(double(size_));
}

Slope Projection::slope() const {
  const std::size_t freedom = size_ - 1;
  double first = 0, widest = 0;
  Vector weight, scale;
  for (std::size_t k = 0; k < grid().size(); ++k) {
    const Cell& cell = grid()[k];
    Coefficients x{1.0};  // the projection of p_1; x' V^(-1) x = |V_22| / |V|
    cell.whiten(x, size_);
    const double xx = dot(x, x, size_), xy = dot(x, whitened_[k], size_);
    const double residual = std::max(square_[k] - xy * xy / xx, 0.0) + noise_floor_;  // R
    first = cell.cholesky[0][0] * whitened_[k][0];                                    // Y_1
    scale.push_back(cell.cholesky[0][0] * std::sqrt(residual / double(freedom)));
    weight.push_back(std::log(cell.prior * slope_prior[cell.kind]) -
                     0.5 * (log_determinant_[k] + std::log(xx)) - 0.5 * double(freedom) * std::log(residual));
    widest = std::max(widest, scale.back());
  }
  const double total = log_sum(weight);
  for (double& w : weight) w = std::exp(w - total);
  double low = 0, high = 13 * widest;  // Student's 97.5 % quantile is at most 12.71
  for (int step = 0; step < 40; ++step) {
    const double middle = (low + high) / 2;
    double below = 0;
    for (std::size_t k = 0; k < weight.size(); ++k)
      if (weight[k] > 1e-7) below += weight[k] * student(middle / scale[k], freedom);
    (below < 0.975 ? low : high) = middle;
  }
  return {first / scale_, high / scale_};
}

}  // namespace pfaff::low_frequency
