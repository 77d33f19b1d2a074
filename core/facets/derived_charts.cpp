#include <pfaff/core/facets/derived_charts.hpp>

#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

namespace {
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

void copy(const std::vector<Recorded>& from, Results to) {
  for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[k];
}
std::vector<Recorded> gradient_of(const Tape& scalar, const Recorded& t, Arguments z) {
  const std::vector<Recorded> one{Recorded(1)};
  return gradient(scalar, t, z, one);
}
}  // namespace

void canonical_sharp(Arguments covector, Results vector) {
  const std::size_t half = covector.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    vector[k] = covector[half + k];
    vector[half + k] = -covector[k];
  }
}

// Pulls the action form F.dz - B dt back through the chart's inverse z = zeta(y, t). There the structure is
// constant and canonical, so the field is J (grad_y B~ + d_t F~) with F~_i = F_j d zeta_j / d y_i and B~ = B
// - F.d_t zeta.
Tape pulled_back_field(const Tape& one_form, const Tape& birkhoffian, const Tape& inverse) {
  const int n = inverse.inputs;
  const auto size = static_cast<std::size_t>(n);
  const Tape form = record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto f = evaluate(one_form, t, z);
    copy(gradient(inverse, t, y, f), out);
  });
  const Tape function = record(n, 1, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto f = evaluate(one_form, t, z);
    const auto z_t = time_derivative(inverse, t, y);
    out[0] = evaluate(birkhoffian, t, z)[0];
    for (std::size_t k = 0; k < size; ++k) out[0] = out[0] - f[k] * z_t[k];
  });
  return record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    auto covector = gradient_of(function, t, y);
    const auto form_t = time_derivative(form, t, y);
    for (std::size_t k = 0; k < size; ++k) covector[k] = covector[k] + form_t[k];
    canonical_sharp(covector, out);
  });
}

// The same from K zdot + D = 0: with z = zeta(y, t) and K_c = zeta_y^T K zeta_y, y' = -K_c^-1 zeta_y^T (D +
// K zeta_t). Nothing is solved.
Tape pulled_back_equations(const Tape& structure, const Tape& covector, const Tape& inverse) {
  const int n = inverse.inputs;
  const auto size = static_cast<std::size_t>(n);
  return record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto z_t = time_derivative(inverse, t, y);
    const auto k = evaluate(structure, t, z);
    auto d = evaluate(covector, t, z);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) d[i] = d[i] + k[i * size + j] * z_t[j];
      d[i] = -d[i];
    }
    canonical_sharp(gradient(inverse, t, y, d), out);
  });
}

Tape linear_chart(const Tape& structure, const PivotPairs& pairs) {
  return record(structure.inputs, structure.inputs, [&](const Recorded& t, Arguments z, Results y) {
    const auto k = evaluate(structure, t, z);
    const auto basis = symplectic_basis<Recorded>(k, pairs);
    copy(symplectic_coordinates<Recorded>(k, basis, z), y);
  });
}
Tape linear_chart_inverse(const Tape& structure, const PivotPairs& pairs) {
  return record(structure.inputs, structure.inputs, [&](const Recorded& t, Arguments y, Results z) {
    const auto k = evaluate(structure, t, y);
    const auto basis = symplectic_basis<Recorded>(k, pairs);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t j = 0; j < y.size(); ++j) z[i] = z[i] + basis[i * y.size() + j] * y[j];
  });
}

}  // namespace pfaff
