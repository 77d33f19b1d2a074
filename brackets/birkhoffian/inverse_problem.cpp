#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>

#include <vector>

#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using FormArguments = std::span<const Recorded>;
using FormResults = std::span<Recorded>;

// Calls term(s, weight, x, z* + s x) at every node.
template <class Term>
void along_ray(std::span<const Real> centre, const std::vector<QuadratureNode>& nodes, FormArguments z,
               Term&& term) {
  std::vector<Recorded> x, point(z.size());
  for (std::size_t k = 0; k < z.size(); ++k) x.push_back(z[k] - Recorded(centre[k]));
  for (const QuadratureNode& node : nodes) {
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
  form.one_form = record(n, n, [&](const Recorded& t, FormArguments z, FormResults out) {
    along_ray(centre, places, z,
              [&](const Recorded& s, const Recorded& weight, FormArguments x, FormArguments at) {
                const auto k = evaluate(structure, t, at);
                for (std::size_t i = 0; i < size; ++i) {
                  Recorded sum(0);
                  for (std::size_t j = 0; j < size; ++j) sum = sum + x[j] * k[j * size + i];
                  out[i] = out[i] + weight * s * sum;
                }
              });
  });
  form.birkhoffian = record(n, 1, [&](const Recorded& t, FormArguments z, FormResults out) {
    along_ray(centre, places, z,
              [&](const Recorded& /*s*/, const Recorded& weight, FormArguments x, FormArguments at) {
                const auto d = evaluate(covector, t, at);
                Recorded sum(0);
                for (std::size_t i = 0; i < size; ++i) sum = sum + x[i] * d[i];
                out[0] = out[0] - weight * sum;
              });
  });
  return form;
}

}  // namespace pfaff
