// Systems that are not canonical: with a Poisson bracket of their own, with a second bracket, or with a field
// alone.
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

// Parts: the Casimir C and H, each in three variables. Pi_ij = eps_ijk C_k obeys Jacobi's identity whatever C
// is, and the field is free of divergence. With the second bracket G = alpha (|H_z|^2 I - H_z H_z^T), which
// does not move H, the entropy S = C grows, or S = -C.
PolynomialSystem detail::bracket_system(const Recipe& recipe) {
  PolynomialSystem system;
  constexpr std::size_t n = 3;
  system.dimension = n;
  const SparsePolynomial &casimir = recipe.parts[0].front(), &energy = recipe.parts[1].front();
  Polynomials tensor(n * n, SparsePolynomial(n));
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (k + 1) % n, j = (k + 2) % n;
    tensor[i * n + j] = casimir.derivative(k);
    tensor[j * n + i] = Real(-1) * casimir.derivative(k);
  }
  system.formulas[Formula::poisson_tensor] = tensor;
  system.formulas[Formula::hamiltonian] = {energy};
  keep(system, "energy", energy);
  if (recipe.kind == SystemKind::casimir_bracket) {
    system.formulas[Formula::casimirs] = {casimir};
    keep(system, "casimir", casimir);
    return system;
  }
  SparsePolynomial square(n);
  Polynomials slope, symmetric;
  for (std::size_t k = 0; k < n; ++k) {
    slope.push_back(energy.derivative(k));
    square = square + slope[k] * slope[k];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      symmetric.push_back(recipe.rate * ((i == j ? square : SparsePolynomial(n)) - slope[i] * slope[j]));
  system.formulas[Formula::symmetric_tensor] = symmetric;
  system.formulas[Formula::entropy] = {Real(recipe.kind == SystemKind::metriplectic ? 1 : -1) * casimir};
  return system;
}

// Parts: the n components of the field, or the n (n - 1)/2 entries above the diagonal of A, row by row.
PolynomialSystem detail::field_system(const Recipe& recipe) {
  PolynomialSystem system;
  const std::size_t n = recipe.dimension;
  system.dimension = n;
  if (recipe.kind == SystemKind::field) {
    system.formulas[Formula::field] = recipe.parts[0];
    return system;
  }
  Polynomials field(n, SparsePolynomial(n));
  std::size_t entry = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j, ++entry) {
      field[i] = field[i] + recipe.parts[0][entry] * SparsePolynomial::variable(n, j);
      field[j] = field[j] - recipe.parts[0][entry] * SparsePolynomial::variable(n, i);
    }
  system.formulas[Formula::field] = field;
  keep(system, "square", Real(2) * detail::half_square(n, 0, n));
  return system;
}

}  // namespace pfaff
