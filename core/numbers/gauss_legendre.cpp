#include <pfaff/core/numbers/gauss_legendre.hpp>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <utility>

namespace pfaff {

namespace {

// P_n and its derivative at x, by the three-term recurrence.
std::pair<Quad, Quad> legendre(int n, Quad x) {
  Quad previous(1), value = x;
  for (int k = 2; k <= n; ++k) {
    const Quad next = (Quad(2 * k - 1) * x * value - Quad(k - 1) * previous) / Quad(k);
    previous = value;
    value = next;
  }
  return {value, Quad(n) * (x * value - previous) / (x * x - Quad(1))};
}

// Newton's method on P_n from the asymptotic places of its roots.
std::vector<QuadratureNode> computed(int n) {
  std::vector<QuadratureNode> nodes;
  for (int k = 0; k < n; ++k) {
    Quad x(std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)));
    // From four digits, quadratic convergence reaches 34 in four rounds; two more cost nothing.
    for (int round = 0; round < 6; ++round) {
      const auto [value, slope] = legendre(n, x);
      x = x - value / slope;
    }
    const Quad slope = legendre(n, x).second;
    nodes.push_back({Real((Quad(1) + x) / Quad(2)), Real(Quad(1) / ((Quad(1) - x * x) * slope * slope))});
  }
  return nodes;
}

}  // namespace

// Every stepper of some methods asks for them.
std::vector<QuadratureNode> gauss_legendre(int n) {
  static std::mutex mutex;
  static std::map<int, std::vector<QuadratureNode>> known;
  const std::lock_guard lock(mutex);
  auto place = known.find(n);
  if (place == known.end()) place = known.emplace(n, computed(n)).first;
  return place->second;
}

}  // namespace pfaff
