#include <pfaff/derive/tuning/constrained_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/core/linear/lu.hpp>

namespace pfaff {

namespace {

using Doubles = std::vector<double>;

// Minimises |r(x)| under the conditions g(x) = 0 by Gauss and Newton: each step minimises the linearised sum
// of squares under the linearised conditions, with a damping that grows while steps do not lead down. From
// each start this is done in two ways, which find different minima: on a path off the conditions, that
// approaches them by and by, and on one that first goes to them, by the method of Levenberg, and then along
// them, each step being followed by corrections.
class ConstrainedSearch {
 public:
  explicit ConstrainedSearch(const ConstrainedProblem& problem) : problem_(problem) {}

  struct Point {
    Doubles x, conditions, residuals;
  };
  [[nodiscard]] Point at(Doubles x) const {
    spend(0, 1);
    auto values = problem_.values(x);
    return {std::move(x), std::move(values.conditions), std::move(values.residuals)};
  }
  // The derivatives of conditions and residuals, each one row for a variable.
  struct Slopes {
    std::vector<Doubles> conditions, residuals;
  };
  [[nodiscard]] Slopes slopes(const Point& point) const {
    constexpr double offset = 1e-6;  // a central difference of it is good to 1e-10
    Slopes slopes;
    for (std::size_t k = 0; k < point.x.size(); ++k) {
      Doubles forward = point.x, backward = point.x;
      forward[k] += offset;
      backward[k] -= offset;
      Point a = at(std::move(forward)), b = at(std::move(backward));
      for (std::size_t i = 0; i < a.conditions.size(); ++i)
        a.conditions[i] = (a.conditions[i] - b.conditions[i]) / (2 * offset);
      for (std::size_t i = 0; i < a.residuals.size(); ++i)
        a.residuals[i] = (a.residuals[i] - b.residuals[i]) / (2 * offset);
      slopes.conditions.push_back(std::move(a.conditions));
      slopes.residuals.push_back(std::move(a.residuals));
    }
    return slopes;
  }

  // The better end of the two paths from x, and nothing where neither reaches the conditions or both are too
  // long.
  [[nodiscard]] std::optional<Point> from(const Doubles& x) const {
    std::optional<Point> best;
    for (const bool off : {true, false}) {
      std::optional<Point> end = along_conditions(off ? approaching(at(x)) : on_conditions(at(x)));
      if (end && (!best || norm_of(end->residuals) < norm_of(best->residuals))) best = std::move(end);
    }
    return best;
  }

  // Moves the numbers, by as little as possible, to where the conditions hold to round-off of quad. The
  // slopes of double are good enough: each iteration divides what is left by a million or more.
  [[nodiscard]] std::optional<std::vector<Quad>> in_quad(const Point& point) const {
    const auto rows = slopes(point).conditions;
    const std::size_t n = point.x.size(), m = point.conditions.size();
    LU<Quad> normal(m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        Quad sum(0);
        for (std::size_t k = 0; k < n; ++k) sum += Quad(rows[k][i]) * Quad(rows[k][j]);
        normal(i, j) = sum;
      }
    if (!normal.factor()) return std::nullopt;
    std::vector<Quad> x(point.x.begin(), point.x.end()), multipliers(m);
    constexpr int enough = 12;
    for (int iteration = 0; iteration < enough; ++iteration) {
      if (problem_.holds(x)) return x;
      std::vector<Quad> right = problem_.conditions(x);
      for (Quad& residual : right) residual = -residual;
      normal.solve(right.data(), multipliers.data());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < m; ++j) x[i] += Quad(rows[i][j]) * multipliers[j];
    }
    return std::nullopt;
  }

 private:
  static constexpr double most_damped = 1e6;

  [[nodiscard]] bool good(const Point& point) const {
    return norm_of(point.conditions) < 1e-8 && problem_.length(point.x) <= problem_.longest;
  }

  // x less A^T y, for the rows of slopes that are the columns of A.
  static Doubles corrected(Doubles x, const std::vector<Doubles>& slopes, const Doubles& multipliers) {
    for (std::size_t k = 0; k < x.size(); ++k)
      for (std::size_t i = 0; i < multipliers.size(); ++i) x[k] -= slopes[k][i] * multipliers[i];
    return x;
  }
  // A A^T + damping.
  static LU<double> normal_matrix(const std::vector<Doubles>& slopes, std::size_t m, double damping) {
    LU<double> normal(m);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        double sum = i == j ? damping : 0;
        for (const Doubles& row : slopes) sum += row[i] * row[j];
        normal(i, j) = sum;
      }
    return normal;
  }

  // Conditions count so much more than residuals that no valley of the sum lies far from them.
  static double merit(const Point& point) {
    return norm_of(point.residuals) + 1e3 * norm_of(point.conditions);
  }
  // The end of the path off the conditions.
  [[nodiscard]] Point approaching(Point point) const {
    constexpr double longest_step = 0.3;
    double damping = 1e-3;
    int idle = 0;
    for (int iteration = 0; iteration < 200 && idle < 12; ++iteration) {
      const std::optional<Doubles> step = step_of(point, slopes(point), damping);
      if (!step) break;
      const double length = norm_of(*step), factor = length > longest_step ? longest_step / length : 1;
      Doubles x = point.x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += factor * (*step)[k];
      Point next = at(std::move(x));
      const double now = merit(point), then = merit(next);
      if (then < now) {
        idle = then > now * (1 - 1e-10) ? idle + 1 : 0;
        point = std::move(next);
        damping = std::max(damping / 3, 1e-12);
      } else {
        damping *= 4;
        ++idle;
      }
    }
    return point;
  }

  // From a point on the conditions along them to a minimum; nothing from other points.
  [[nodiscard]] std::optional<Point> along_conditions(Point point) const {
    if (!good(point)) return std::nullopt;
    double damping = 1e-3;
    for (int iteration = 0; iteration < 100; ++iteration) {
      std::optional<Point> next = moved(point, damping);
      if (!next) break;
      const double before = norm_of(point.residuals), after = norm_of(next->residuals);
      point = std::move(*next);
      if (after > before * (1 - 1e-4)) break;
      damping = std::max(damping / 5, 1e-12);
    }
    return point;
  }

  // Where the conditions hold, or as far as sixty steps lead towards that.
  [[nodiscard]] Point on_conditions(Point point) const {
    const std::size_t m = point.conditions.size();
    Doubles multipliers(m);
    double damping = 1e-2;
    for (int iteration = 0; iteration < 60 && norm_of(point.conditions) > 1e-9; ++iteration) {
      const auto rows = slopes(point).conditions;
      LU<double> normal = normal_matrix(rows, m, damping);
      if (!normal.factor()) break;
      normal.solve(point.conditions.data(), multipliers.data());
      Point next = at(corrected(point.x, rows, multipliers));
      if (norm_of(next.conditions) < norm_of(point.conditions)) {
        point = std::move(next);
        damping /= 4;
      } else {
        damping *= 5;
      }
    }
    return point;
  }

  // The next point on the conditions, with smaller residuals; nothing where no step leads to one.
  [[nodiscard]] std::optional<Point> moved(const Point& point, double& damping) const {
    const Slopes s = slopes(point);
    const std::size_t m = point.conditions.size();
    LU<double> normal = normal_matrix(s.conditions, m, 0);
    if (!normal.factor()) return std::nullopt;
    Doubles multipliers(m);
    constexpr double longest_step = 0.3;
    for (; damping < most_damped; damping *= 4) {
      const std::optional<Doubles> step = step_of(point, s, damping);
      if (!step || !(norm_of(*step) < longest_step)) continue;
      Doubles x = point.x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += (*step)[k];
      Point next = at(std::move(x));
      // The slopes are those of the point before: five corrections are enough where the step is not too long.
      for (int k = 0; k < 5 && norm_of(next.conditions) > 1e-11; ++k) {
        normal.solve(next.conditions.data(), multipliers.data());
        next = at(corrected(next.x, s.conditions, multipliers));
      }
      if (good(next) && norm_of(next.residuals) < norm_of(point.residuals)) return next;
    }
    return std::nullopt;
  }

  // d that minimises |r + J d|^2 + damping |d|^2 under g + A d = 0.
  static std::optional<Doubles> step_of(const Point& point, const Slopes& s, double damping) {
    const std::size_t n = point.x.size(), m = point.conditions.size();
    double scale = 0;
    for (const Doubles& row : s.residuals) scale = std::max(scale, norm_of(row));
    LU<double> matrix(n + m);
    Doubles right(n + m, 0.0), solution(n + m);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        double sum = i == j ? damping * scale * scale + 1e-14 : 0;
        for (std::size_t k = 0; k < point.residuals.size(); ++k) sum += s.residuals[i][k] * s.residuals[j][k];
        matrix(i, j) = sum;
      }
      for (std::size_t k = 0; k < point.residuals.size(); ++k)
        right[i] -= s.residuals[i][k] * point.residuals[k];
      for (std::size_t k = 0; k < m; ++k) matrix(i, n + k) = matrix(n + k, i) = s.conditions[i][k];
    }
    for (std::size_t k = 0; k < m; ++k) {
      for (std::size_t j = 0; j < m; ++j) matrix(n + k, n + j) = 0;
      right[n + k] = -point.conditions[k];
    }
    if (!matrix.factor()) return std::nullopt;
    matrix.solve(right.data(), solution.data());
    solution.resize(n);
    if (!std::isfinite(norm_of(solution))) return std::nullopt;
    return solution;
  }

  const ConstrainedProblem& problem_;
};

Doubles rounded(const std::vector<Quad>& x) {
  Doubles result;
  for (const Quad& number : x) result.push_back(static_cast<double>(number));
  return result;
}

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) / 9007199254740992.0; }

double norm_of(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

std::optional<std::vector<Quad>> least_squares(const ConstrainedProblem& problem, std::mt19937_64& random,
                                               int starts,
                                               const std::function<void(double fraction)>& progress) {
  const ConstrainedSearch search(problem);
  std::optional<std::vector<Quad>> best;
  double smallest = std::numeric_limits<double>::infinity();
  int start = 0;
  const auto next = [&] {
    const auto end = search.from(problem.start(random));
    if (!end || !(norm_of(end->residuals) < smallest)) return;
    auto exact = search.in_quad(*end);
    if (!exact) return;
    smallest = norm_of(problem.values(rounded(*exact)).residuals);
    best = std::move(exact);
  };
  try {
    for (; start < starts; ++start) {
      if (progress) progress(static_cast<double>(start) / starts);
      next();
    }
  } catch (const BudgetSpent& spent) {
    end_interrupted(spent, std::to_string(start) + " of " + std::to_string(starts) +
                               " starts of a search were tried, and nothing is written");
  }
  return best;
}

}  // namespace pfaff
