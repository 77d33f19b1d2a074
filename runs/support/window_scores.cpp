#include <pfaff/runs/support/window_scores.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pfaff::windows {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// What a slow line must add to the best score to be taken, and the most that are.
constexpr double line_gain = 8;
constexpr std::size_t most_lines = 5;
constexpr double line_parameters = 3;
/// Columns that are nearly combinations of others are not used: of their square, 1 at first, this must be
/// left.
constexpr double least_pivot = 1e-8;
/// Prior weights of the kinds of noise when the slope is estimated, and the factor of its interval.
constexpr std::array<double, 3> slope_prior{0.5, 0.4, 0.1};
constexpr double interval_factor = 1.2;

double walk_parameter(Noise noise) { return noise == Noise::white ? 0 : 1; }
double shape_parameters(const Shape& shape) { return shape.kind == Shape::Kind::line ? 1 : 2; }

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

/// Tables of products are large, so that the system takes long to give the memory. A thread keeps those that
/// it has had for the quantity that it classes next.
thread_local std::vector<std::vector<double>> spare_tables;
std::vector<double> copied(const std::vector<double>& table) {
  std::vector<double> copy;
  if (!spare_tables.empty()) {
    copy = std::move(spare_tables.back());
    spare_tables.pop_back();
  }
  copy.assign(table.begin(), table.end());
  return copy;
}

double product(const double* x, const double* y, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += x[i] * y[i];
  return sum;
}

/// The solution of the symmetric positive system a x = b, row by row; b is overwritten by x.
void solve(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = c + 1; i < n; ++i) {
      const double factor = a[i * n + c] / a[c * n + c];
      for (std::size_t j = c; j < n; ++j) a[i * n + j] -= factor * a[c * n + j];
      b[i] -= factor * b[c];
    }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t j = c + 1; j < n; ++j) b[c] -= a[c * n + j] * b[j];
    b[c] /= a[c * n + c];
  }
}

}  // namespace

// In units of `scale_`, without the constant.
void Scores::through(const Covariance& c, const std::vector<double>& values, double origin,
                     std::vector<double>& result) const {
  const std::size_t n = values.size();
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = 0;
    for (std::size_t j = 0; j <= i; ++j) result[i] += c.whitener[i * n + j] * ((values[j] - origin) / scale_);
    mean += result[i] * c.constant[i];
  }
  for (std::size_t i = 0; i < n; ++i) result[i] -= mean * c.constant[i];
}

Scores::Scores(const std::vector<double>& means, double resolution, double shape_resolution,
               const std::vector<double>& beside)
    : models_(window_models(means.size())),
      shape_square_(shape_resolution * shape_resolution),
      beside_(beside.empty() ? 0 : 1) {
  const std::size_t n = means.size(), columns = models_.column_count();
  const auto [low, high] = std::minmax_element(means.begin(), means.end());
  scale_ = *high > *low ? *high - *low : 1;
  least_square_ = resolution * resolution / (scale_ * scale_);
  std::vector<double> data(n), along(n);
  for (const Covariance& c : models_.covariances) {
    Seen seen{std::vector<double>(columns), {}, 0, 2 * std::log(c.constant_norm), {}, {}};
    through(c, means, *low, data);
    if (beside_ > 0) {
      through(c, beside, 0, along);
      if (const double square = product(along.data(), along.data(), n); square > 0) {
        for (double& x : along) x /= std::sqrt(square);
        const double part = product(along.data(), data.data(), n);
        for (std::size_t i = 0; i < n; ++i) data[i] -= part * along[i];
        for (std::size_t a = 0; a < columns; ++a)
          seen.beside.push_back(product(&c.columns[a * n], along.data(), n));
        seen.products = copied(c.products);
        for (std::size_t a = 0; a < columns; ++a)
          for (std::size_t b = 0; b < columns; ++b)
            seen.products[a * columns + b] -= seen.beside[a] * seen.beside[b];
        seen.log_pivots += std::log(square);
      }
    }
    seen.square = product(data.data(), data.data(), n);
    for (std::size_t a = 0; a < columns; ++a) seen.data[a] = product(&c.columns[a * n], data.data(), n);
    seen.original = seen.data;
    seen_.push_back(std::move(seen));
  }
  rank_explanations();
  while (joined_.size() < std::min(most_lines, models_.windows / 6)) {
    const double before = best();
    double top = -infinity;
    std::size_t line = 0;
    for (std::size_t f = models_.arcs; f < models_.frequencies.size(); ++f)
      if (const double with = best_with_line(f, true); with > top) top = with, line = f;
    if (!(top > before + line_gain)) break;
    join(line);
    rank_explanations();
  }
}

Scores::~Scores() {
  for (Seen& seen : seen_)
    if (!seen.products.empty()) spare_tables.push_back(std::move(seen.products));
}

double Scores::score(std::size_t covariance, double square, double parameters) const {
  const double b = double(models_.windows);
  // White noise of the shapes' resolution is a part of every covariance, also of one that has none.
  const double v = std::max(
      {square / b, least_square_of(covariance), shape_square_ * models_.covariances[covariance].stiffness});
  return -0.5 * models_.covariances[covariance].log_determinant - 0.5 * b * std::log(v) -
         0.5 * std::max(square, 0.0) / v -
         0.5 * std::log(b) * (parameters + double(beside_) + line_parameters * double(joined_.size()));
}

const std::vector<double>& Scores::products(std::size_t covariance) const {
  const std::vector<double>& own = seen_[covariance].products;
  return own.empty() ? models_.covariances[covariance].products : own;
}

double Scores::square_with(std::size_t covariance, std::size_t column) const {
  const Seen& seen = seen_[covariance];
  const double pivot = products(covariance)[column * models_.column_count() + column];
  return pivot > least_pivot ? seen.square - seen.data[column] * seen.data[column] / pivot : seen.square;
}

double Scores::least_square_of(std::size_t covariance) const {
  // What elimination leaves of a square has an error of some units in the last place of that square.
  const double rounding =
      8 * std::numeric_limits<double>::epsilon() * seen_[covariance].square / double(models_.windows);
  return std::max({least_square_, rounding, std::numeric_limits<double>::min()});
}

void Scores::rank_explanations() {
  plain_.assign(3, {-infinity, 0, no_shape});
  trend_.assign(3, {-infinity, 0, no_shape});
  shape_scores_.assign(models_.shapes.size(), -infinity);
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Noise noise = models_.covariances[k].noise;
    const double parameter = walk_parameter(noise), plain = score(k, seen_[k].square, parameter);
    if (plain > plain_[std::size_t(noise)].score) plain_[std::size_t(noise)] = {plain, k, no_shape};
    if (noise == Noise::smooth) continue;
    for (std::size_t a = 0; a < models_.shapes.size(); ++a) {
      const Shape& shape = models_.shapes[a];
      const double value = score(k, square_with(k, a), parameter + shape_parameters(shape));
      shape_scores_[a] = std::max(shape_scores_[a], value);
      Explanation& top = trend_[std::size_t(shape.kind)];
      if (value > top.score) top = {value, k, a};
    }
  }
}

double Scores::best() const {
  double top = -infinity;
  for (const auto* list : {&plain_, &trend_})
    for (const Explanation& e : *list) top = std::max(top, e.score);
  return top;
}

// Every second power and every third exponential are tried beside a new line; all of them once it has joined.
double Scores::best_with_line(std::size_t frequency, bool beside_shapes) const {
  const std::size_t columns = models_.column_count(), c = models_.cosine(frequency), s = c + 1;
  double top = -infinity;
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Seen& seen = seen_[k];
    const std::vector<double>& of_columns = products(k);
    const auto product = [&](std::size_t a, std::size_t b) { return of_columns[a * columns + b]; };
    const double cc = product(c, c), cs = product(c, s), ss = product(s, s), determinant = cc * ss - cs * cs;
    if (!(cc > least_pivot && ss > least_pivot && determinant > least_pivot * cc)) continue;
    const auto taken = [&](double uc, double us, double vc, double vs) {
      return (ss * uc * vc - cs * (uc * vs + us * vc) + cc * us * vs) / determinant;
    };
    const double yc = seen.data[c], ys = seen.data[s], square = seen.square - taken(yc, ys, yc, ys);
    const Noise noise = models_.covariances[k].noise;
    const double parameters = walk_parameter(noise) + line_parameters;
    if (beside_shapes || noise != Noise::smooth) top = std::max(top, score(k, square, parameters));
    if (!beside_shapes || noise == Noise::smooth) continue;
    // Of shapes with as many parameters the one that leaves least has the best score.
    std::array<double, 2> least{infinity, infinity};
    for (std::size_t a = 0; a<models_.shapes.size(); a += a> power_count ? 3 : (a == 0 ? 1 : 2)) {
      const double xc = product(a, c), xs = product(a, s);
      const double pivot = product(a, a) - taken(xc, xs, xc, xs);
      if (!(pivot > least_pivot)) continue;
      const double xy = seen.data[a] - taken(xc, xs, yc, ys);
      double& of_as_many = least[models_.shapes[a].kind == Shape::Kind::line ? 0 : 1];
      of_as_many = std::min(of_as_many, square - xy * xy / pivot);
    }
    for (const std::size_t more : {0, 1})
      if (least[more] < infinity) top = std::max(top, score(k, least[more], parameters + 1 + double(more)));
  }
  return top;
}

double Scores::arc() const {
  double top = -infinity;
  for (std::size_t f = 0; f < models_.arcs; ++f) top = std::max(top, best_with_line(f, false));
  return top;
}

void Scores::join(std::size_t frequency) {
  const std::size_t columns = models_.column_count();
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    Seen& seen = seen_[k];
    if (seen.products.empty()) seen.products = copied(models_.covariances[k].products);
    for (const std::size_t c : {models_.cosine(frequency), models_.cosine(frequency) + 1}) {
      const double pivot = seen.products[c * columns + c];
      if (!(pivot > least_pivot)) continue;
      seen.log_pivots += std::log(pivot) + 2 * std::log(models_.covariances[k].norms[c]);
      seen.square -= seen.data[c] * seen.data[c] / pivot;
      const std::vector<double> row(seen.products.begin() + std::ptrdiff_t(c * columns),
                                    seen.products.begin() + std::ptrdiff_t((c + 1) * columns));
      const double data = seen.data[c];
      for (std::size_t a = 0; a < columns; ++a) {
        const double factor = row[a] / pivot;
        seen.data[a] -= factor * data;
        for (std::size_t b = 0; b < columns; ++b) seen.products[a * columns + b] -= factor * row[b];
      }
    }
  }
  joined_.push_back(frequency);
}

std::vector<double> Scores::frequencies() const {
  std::vector<double> result;
  for (const std::size_t f : joined_) result.push_back(models_.frequencies[f]);
  return result;
}

Scores::Fit Scores::fit(const Explanation& explanation) const {
  std::vector<std::size_t> used;
  if (explanation.shape != no_shape) used.push_back(explanation.shape);
  for (const std::size_t f : joined_) used.insert(used.end(), {models_.cosine(f), models_.cosine(f) + 1});
  const Covariance& c = models_.covariances[explanation.covariance];
  const Seen& seen = seen_[explanation.covariance];
  const std::size_t columns = models_.column_count();
  std::vector<double> matrix, x;
  for (const std::size_t a : used) {
    for (const std::size_t b : used)
      matrix.push_back(c.products[a * columns + b] -
                       (seen.beside.empty() ? 0 : seen.beside[a] * seen.beside[b]));
    x.push_back(seen.original[a]);
  }
  solve(matrix, x);
  for (std::size_t i = 0; i < used.size(); ++i) x[i] *= scale_ / c.norms[used[i]];
  Fit result;
  std::size_t next = 0;
  if (explanation.shape != no_shape) result.shape = x[next++];
  for (; next < x.size(); next += 2) result.lines.push_back(std::hypot(x[next], x[next + 1]));
  return result;
}

Slope Scores::slope() const {
  const std::size_t freedom = models_.windows - 2 - 2 * joined_.size() - beside_;
  std::array<double, 3> members{};
  for (const Covariance& c : models_.covariances) members[std::size_t(c.noise)] += 1;
  std::vector<double> value, width, weight;
  double top = -infinity, widest = 0;
  for (std::size_t k = 0; k < seen_.size(); ++k) {
    const Covariance& c = models_.covariances[k];
    const double pivot = products(k)[0], norm = c.norms[0];
    if (!(pivot > least_pivot)) continue;
    const double square = std::max(square_with(k, 0), double(models_.windows) * least_square_of(k));
    value.push_back(seen_[k].data[0] / pivot / norm);
    width.push_back(std::sqrt(square / double(freedom) / pivot) / norm);
    widest = std::max(widest, width.back());
    const double prior = slope_prior[std::size_t(c.noise)] / members[std::size_t(c.noise)];
    weight.push_back(std::log(prior) - 0.5 * (c.log_determinant + seen_[k].log_pivots + std::log(pivot)) -
                     std::log(norm) - 0.5 * double(freedom) * std::log(square));
    top = std::max(top, weight.back());
  }
  double sum = 0, mean = 0;
  for (std::size_t k = 0; k < weight.size(); ++k) {
    weight[k] = std::exp(weight[k] - top);
    sum += weight[k];
    mean += weight[k] * value[k];
  }
  mean /= sum;
  const auto quantile = [&](double probability) {
    double reach = 13 * widest;  // Student's 97.5 % quantile is at most 12.71
    for (const double v : value) reach = std::max(reach, std::abs(v - mean) + 13 * widest);
    double low = mean - reach, high = mean + reach;
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      double below = 0;
      for (std::size_t k = 0; k < weight.size(); ++k)
        if (weight[k] > 1e-9) below += weight[k] / sum * student((middle - value[k]) / width[k], freedom);
      (below < probability ? low : high) = middle;
    }
    return (low + high) / 2;
  };
  const double low = interval_factor * (mean - quantile(0.025)),
               high = interval_factor * (quantile(0.975) - mean);
  return {mean * scale_, (mean - low) * scale_, (mean + high) * scale_};
}

}  // namespace pfaff::windows
