#include <pfaff/runs/support/window_models.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pfaff/runs/support/windows.hpp>

namespace pfaff::windows {

namespace {

using Vector = std::vector<double>;

/// A square matrix, or one of window responses, row by row.
struct WindowMatrix {
  std::size_t rows, columns;
  Vector entries = Vector(rows * columns);
  double& operator()(std::size_t i, std::size_t j) { return entries[i * columns + j]; }
  double operator()(std::size_t i, std::size_t j) const { return entries[i * columns + j]; }
};

/// The windows' weights on the fine grid; each row adds up to 1.
WindowMatrix filter(std::size_t windows) {
  WindowMatrix f{windows, points_in_half * (windows + 1)};
  for (std::size_t j = 0; j < windows; ++j) {
    double sum = 0;
    for (std::size_t g = 0; g < f.columns; ++g)
      sum += f(j, g) =
          hann((double(g) + 0.5) / double(f.columns), double(j + 1) / double(windows + 1), windows);
    for (std::size_t g = 0; g < f.columns; ++g) f(j, g) /= sum;
  }
  return f;
}

/// Responses to the values whose running sum is filtered by `f`.
WindowMatrix of_running_sum(const WindowMatrix& f) {
  WindowMatrix r = f;
  for (std::size_t j = 0; j < r.rows; ++j)
    for (std::size_t g = r.columns - 1; g-- > 0;) r(j, g) += r(j, g + 1);
  return r;
}

/// Responses to the values whose differences are filtered by `f`.
WindowMatrix of_differences(const WindowMatrix& f) {
  WindowMatrix r = f;
  for (std::size_t j = 0; j < r.rows; ++j)
    for (std::size_t g = 0; g + 1 < r.columns; ++g) r(j, g) = f(j, g) - f(j, g + 1);
  return r;
}

/// R R', scaled so that its trace without mean and line is the number of windows.
WindowMatrix covariance(const WindowMatrix& r) {
  const std::size_t n = r.rows;
  WindowMatrix c{n, n};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t g = 0; g < r.columns; ++g) c(i, j) += r(i, g) * r(j, g);
      c(j, i) = c(i, j);
    }
  double trace = 0, of_mean = 0, of_line = 0, norm = 0;
  const auto centred = [n](std::size_t i) { return double(i) - double(n - 1) / 2; };
  for (std::size_t i = 0; i < n; ++i) {
    trace += c(i, i);
    norm += centred(i) * centred(i);
    for (std::size_t j = 0; j < n; ++j) {
      of_mean += c(i, j) / double(n);
      of_line += centred(i) * c(i, j) * centred(j);
    }
  }
  const double scale = double(n) / (trace - of_mean - of_line / norm);
  for (double& x : c.entries) x *= scale;
  return c;
}

WindowMatrix mixed(double share, const WindowMatrix& a, const WindowMatrix& b) {
  WindowMatrix c = a;
  for (std::size_t k = 0; k < c.entries.size(); ++k) c.entries[k] += share * (b.entries[k] - a.entries[k]);
  return c;
}

/// The inverse of Cholesky's factor of c, and the logarithm of the determinant of c.
Vector whitener_of(const WindowMatrix& c, double& log_determinant) {
  const std::size_t n = c.rows;
  WindowMatrix l{n, n}, inverse{n, n};
  log_determinant = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = c(i, j);
      for (std::size_t k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
      l(i, j) = i == j ? std::sqrt(sum) : sum / l(j, j);
    }
    log_determinant += 2 * std::log(l(i, i));
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) {
      double sum = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) sum -= l(i, k) * inverse(k, j);
      inverse(i, j) = sum / l(i, i);
    }
  return inverse.entries;
}

Vector times(const Vector& lower, const Vector& x) {
  const std::size_t n = x.size();
  Vector y(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) y[i] += lower[i * n + j] * x[j];
  return y;
}

double dot(const double* a, const double* b, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// The models' raw columns: every shape, cosine and sine, filtered.
std::vector<Vector> raw_columns(const WindowModels& models, const WindowMatrix& f) {
  std::vector<Vector> columns;
  Vector values(f.columns);
  const auto append = [&](const auto& value) {
    for (std::size_t g = 0; g < f.columns; ++g) values[g] = value((double(g) + 0.5) / double(f.columns));
    Vector column(f.rows);
    for (std::size_t j = 0; j < f.rows; ++j)
      for (std::size_t g = 0; g < f.columns; ++g) column[j] += f(j, g) * values[g];
    columns.push_back(std::move(column));
  };
  for (const Shape& shape : models.shapes) append(shape);
  for (const double frequency : models.frequencies) {
    append([=](double s) { return std::cos(2 * std::numbers::pi * frequency * s); });
    append([=](double s) { return std::sin(2 * std::numbers::pi * frequency * s); });
  }
  return columns;
}

Covariance seen_through(Noise noise, const WindowMatrix& c, const std::vector<Vector>& raw) {
  const std::size_t n = c.rows;
  Covariance result{noise, 0, 0, {}, {}, 0, {}, {}, {}};
  result.whitener = whitener_of(c, result.log_determinant);
  result.stiffness = dot(result.whitener.data(), result.whitener.data(), n * n);
  result.constant = times(result.whitener, Vector(n, 1.0));
  result.constant_norm = std::sqrt(dot(result.constant.data(), result.constant.data(), n));
  for (double& x : result.constant) x /= result.constant_norm;
  for (const Vector& column : raw) {
    Vector x = times(result.whitener, column);
    const double mean = dot(x.data(), result.constant.data(), n);
    for (std::size_t i = 0; i < n; ++i) x[i] -= mean * result.constant[i];
    const double norm = std::sqrt(dot(x.data(), x.data(), n));
    for (double& value : x) result.columns.push_back(value / norm);
    result.norms.push_back(norm);
  }
  // Those of one column with all others together, which the compiler makes several of at once.
  const std::size_t count = raw.size();
  Vector by_window(n * count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t i = 0; i < n; ++i) by_window[i * count + a] = result.columns[a * n + i];
  result.products.resize(count * count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t b = 0; b < count; ++b)
        result.products[a * count + b] += result.columns[a * n + i] * by_window[i * count + b];
  return result;
}

WindowModels make_models(std::size_t windows) {
  WindowModels models{windows, {}, {}, 0, {}};
  models.shapes.push_back({Shape::Kind::line, 1});
  for (std::size_t k = 0; k < power_count; ++k)
    models.shapes.push_back({Shape::Kind::power, std::pow(power_ratio, double(k) - 16)});
  for (std::size_t k = 0; k < exponential_count; ++k)
    models.shapes.push_back({Shape::Kind::exponential, 2 * std::pow(exponential_ratio, double(k) - 12)});
  const double fastest = windows == few_windows ? 6 : 12;
  for (double frequency = 0.25; frequency < 1; frequency += 0.125) models.frequencies.push_back(frequency);
  models.arcs = models.frequencies.size();
  for (double frequency = 1; frequency <= fastest; frequency += 0.25) models.frequencies.push_back(frequency);

  const WindowMatrix f = filter(windows), summed = of_running_sum(f);
  const WindowMatrix white = covariance(f), blue = covariance(of_differences(f)), walk = covariance(summed),
                     smooth = covariance(of_running_sum(summed));
  const std::vector<Vector> raw = raw_columns(models, f);
  const auto add = [&](Noise noise, const WindowMatrix& c) {
    models.covariances.push_back(seen_through(noise, c, raw));
  };
  for (const double share : {0.0, 0.8, 0.96}) add(Noise::white, mixed(share, white, blue));
  for (int k = 0; k < 10; ++k) add(Noise::walk, mixed(0.02 * std::pow(50.0, double(k) / 9), white, walk));
  for (const double share : {0.5, 0.8, 0.95, 0.99, 1.0}) add(Noise::smooth, mixed(share, white, smooth));
  const double of_white = models.covariances.front().stiffness;
  for (Covariance& c : models.covariances) c.stiffness = std::max(1.0, c.stiffness / of_white);
  return models;
}

}  // namespace

double Shape::operator()(double s) const {
  return kind == Kind::exponential ? std::exp(parameter * (s - 1))
                                   : (kind == Kind::line ? s : std::pow(s, parameter));
}

const WindowModels& window_models(std::size_t windows) {
  // Made when they are first asked for, as each takes milliseconds.
  if (windows == few_windows) {
    static const WindowModels few = make_models(few_windows);
    return few;
  }
  static const WindowModels many = make_models(many_windows);
  return many;
}

}  // namespace pfaff::windows
