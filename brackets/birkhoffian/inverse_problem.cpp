#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

struct Node {
  Real place, weight;
};

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

// Gauss-Legendre on [0, 1]: Newton's method on P_n from the asymptotic places of its roots.
std::vector<Node> gauss_legendre(int n) {
  std::vector<Node> nodes;
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

// Calls term(s, weight, x, z* + s x) at every node.
template <class Term>
void along_ray(std::span<const Real> centre, const std::vector<Node>& nodes, Arguments z, Term&& term) {
  std::vector<Recorded> x, point(z.size());
  for (std::size_t k = 0; k < z.size(); ++k) x.push_back(z[k] - Recorded(centre[k]));
  for (const Node& node : nodes) {
    const Recorded s(node.place);
    for (std::size_t k = 0; k < z.size(); ++k) point[k] = Recorded(centre[k]) + s * x[k];
    term(s, Recorded(node.weight), x, point);
  }
}
}  // namespace

ActionForm inverse_problem(const Tape& structure, const Tape& covector, std::span<const Real> centre,
                           int nodes) {
  const auto places = gauss_legendre(nodes);
  const int n = structure.inputs;
  const auto size = static_cast<std::size_t>(n);
  ActionForm form;
  form.one_form = record(n, n, [&](const Recorded& t, Arguments z, Results out) {
    along_ray(centre, places, z, [&](const Recorded& s, const Recorded& weight, Arguments x, Arguments at) {
      const auto k = evaluate(structure, t, at);
      for (std::size_t i = 0; i < size; ++i) {
        Recorded sum(0);
        for (std::size_t j = 0; j < size; ++j) sum = sum + x[j] * k[j * size + i];
        out[i] = out[i] + weight * s * sum;
      }
    });
  });
  form.birkhoffian = record(n, 1, [&](const Recorded& t, Arguments z, Results out) {
    along_ray(centre, places, z,
              [&](const Recorded& /*s*/, const Recorded& weight, Arguments x, Arguments at) {
                const auto d = evaluate(covector, t, at);
                Recorded sum(0);
                for (std::size_t i = 0; i < size; ++i) sum = sum + x[i] * d[i];
                out[0] = out[0] - weight * sum;
              });
  });
  return form;
}

}  // namespace pfaff
