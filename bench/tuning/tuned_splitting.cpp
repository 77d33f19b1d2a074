#include <pfaff/bench/tuning/tuned_splitting.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include <pfaff/core/linear/lu.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<double>;

// The number of order conditions of the odd degrees below `order` + 1, by Witt's formula: 2, 2, 6, 18 of
// degree 1, 3, 5, 7.
int conditions_of(int order) {
  int count = 0;
  for (int degree = 1; degree < order; degree += 2)
    count += static_cast<int>(Words({1, 1}, degree).lyndon(degree).size());
  return count;
}

// The lengths of a palindrome with so many kicks: first those of its first drifts, then those of its first
// kicks.
template <class T>
std::vector<PartialFlow> palindrome(const std::vector<T>& x, int stages) {
  const auto s = static_cast<std::size_t>(stages);
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k <= s; ++k) {
    flows.push_back({0, Quad(x[std::min(k, s - k)])});
    if (k < s) flows.push_back({1, Quad(x[s / 2 + 1 + std::min(k, s - 1 - k)])});
  }
  return flows;
}

double length_of(const std::vector<PartialFlow>& flows) {
  double sum = 0;
  for (const PartialFlow& flow : flows) sum += std::abs(static_cast<double>(flow.length));
  return sum;
}

double norm_of(const Numbers& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum);
}

// Minimises |R c(x)| under the order conditions g(x) = 0 by Gauss and Newton: each step minimises the
// linearised sum of squares under the linearised conditions, with a damping that grows while steps do not
// lead down.
class Search {
 public:
  Search(const ShadowTerms& terms, const SplittingLogarithm& logarithm, const TuningSettings& settings)
      : terms_(terms), logarithm_(logarithm), settings_(settings) {}

  struct Point {
    Numbers x, conditions, residuals;
  };
  [[nodiscard]] Point at(Numbers x) const {
    auto values = logarithm_.of(palindrome(x, settings_.stages));
    return {std::move(x), std::move(values.conditions), terms_.weighted(values.brackets)};
  }
  // The derivatives of conditions and residuals, each one row for a variable.
  struct Slopes {
    std::vector<Numbers> conditions, residuals;
  };
  [[nodiscard]] Slopes slopes(const Point& point) const {
    constexpr double offset = 1e-6;  // a central difference of it is good to 1e-10
    Slopes slopes;
    for (std::size_t k = 0; k < point.x.size(); ++k) {
      Numbers forward = point.x, backward = point.x;
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

  // The end of a search from x, and nothing where it does not reach the order conditions or its steps are too
  // long.
  [[nodiscard]] std::optional<Point> from(Numbers x) const {
    Point point = at(std::move(x));
    double damping = 1e-3;
    int idle = 0;
    for (int iteration = 0; iteration < 200 && idle < 12; ++iteration) {
      const std::optional<Numbers> step = step_of(point, damping);
      if (!step) return std::nullopt;
      Numbers moved = point.x;
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += (*step)[k];
      Point next = at(std::move(moved));
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
    if (!(norm_of(point.conditions) < 1e-8) ||
        length_of(palindrome(point.x, settings_.stages)) > settings_.longest)
      return std::nullopt;
    return point;
  }

 private:
  // Conditions count so much more than residuals that no valley of the sum lies far from them.
  static double merit(const Point& point) {
    return norm_of(point.residuals) + 1e3 * norm_of(point.conditions);
  }

  // d that minimises |r + J d|^2 + damping |d|^2 under g + A d = 0.
  [[nodiscard]] std::optional<Numbers> step_of(const Point& point, double damping) const {
    const Slopes s = slopes(point);
    const std::size_t n = point.x.size(), m = point.conditions.size();
    double scale = 0;
    for (const Numbers& row : s.residuals) scale = std::max(scale, norm_of(row));
    LU<double> matrix(n + m);
    Numbers right(n + m, 0.0), solution(n + m);
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
    const double length = norm_of(solution), most = 0.3;
    if (!std::isfinite(length)) return std::nullopt;
    if (length > most)
      for (double& x : solution) x *= most / length;
    return solution;
  }

  const ShadowTerms& terms_;
  const SplittingLogarithm& logarithm_;
  const TuningSettings& settings_;
};

// Moves the lengths, by as little as possible, to where the order conditions hold to round-off of quad. The
// slopes of double are good enough: each iteration divides what is left by a million or more.
std::optional<std::vector<Quad>> in_quad(const Search& search, const Search::Point& point,
                                         const TuningSettings& settings) {
  const auto slopes = search.slopes(point).conditions;
  const std::size_t n = point.x.size(), m = point.conditions.size();
  LU<Quad> normal(m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < m; ++j) {
      Quad sum(0);
      for (std::size_t k = 0; k < n; ++k) sum += Quad(slopes[k][i]) * Quad(slopes[k][j]);
      normal(i, j) = sum;
    }
  if (!normal.factor()) return std::nullopt;
  std::vector<Quad> x(point.x.begin(), point.x.end()), right(m), multipliers(m);
  constexpr int enough = 12;
  for (int iteration = 0; iteration < enough; ++iteration) {
    const auto conditions = splitting_conditions(palindrome(x, settings.stages), settings.order);
    if (first_violated(conditions, settings.order, precision_of_quad_coefficients / Quad(4)) == nullptr)
      return x;
    std::size_t k = 0;
    for (const OrderCondition& condition : conditions)
      if (condition.order % 2 == 1) right[k++] = -condition.residual;
    normal.solve(right.data(), multipliers.data());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j) x[i] += Quad(slopes[i][j]) * multipliers[j];
  }
  return std::nullopt;
}

}  // namespace

int free_coefficients(int order, int stages) { return stages + 1 - conditions_of(order); }

void check(const TuningSettings& settings) {
  constexpr int largest_order = 6;
  if (settings.order < 2 || settings.order > largest_order || settings.order % 2 != 0)
    throw InputError("order " + std::to_string(settings.order) + ": expected 2, 4 or 6");
  if (const int number = free_coefficients(settings.order, settings.stages); number < 1)
    throw InputError("a palindrome of order " + std::to_string(settings.order) + " with " +
                     std::to_string(settings.stages) +
                     " forces a step has no free coefficient; expected at least " +
                     std::to_string(settings.stages + 1 - number) + " forces");
}

TunedSplitting tuned_splitting(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings,
                               const std::function<void(double fraction)>& progress) {
  const Search search(terms, logarithm, settings);
  std::mt19937_64 random(settings.seed);
  TunedSplitting best;
  best.error = std::numeric_limits<double>::infinity();
  for (int start = 0; start < settings.starts; ++start) {
    if (progress) progress(static_cast<double>(start) / settings.starts);
    // Lengths about those of equal steps, back and forth.
    Numbers x;
    for (int k = 0; k <= settings.stages; ++k) {
      const double uniform = static_cast<double>(random() >> 11U) / 9007199254740992.0;
      x.push_back((3 * uniform - 1) * 2 / settings.stages);
    }
    const auto end = search.from(std::move(x));
    if (!end || !(norm_of(end->residuals) < best.error)) continue;
    const auto exact = in_quad(search, *end, settings);
    if (!exact) continue;
    best.flows = palindrome(*exact, settings.stages);
    best.error = terms.of(logarithm.of(best.flows).brackets);
  }
  if (best.flows.empty())
    throw RunError("none of " + std::to_string(settings.starts) + " starts leads to a splitting of order " +
                   std::to_string(settings.order) + " with " + std::to_string(settings.stages) +
                   " forces; more starts or forces may");
  return best;
}

}  // namespace pfaff
