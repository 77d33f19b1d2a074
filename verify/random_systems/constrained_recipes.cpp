// Systems with constraints. Those of positions are phi = psi(q) - psi(q0), so that they hold at the start,
// and the momenta there are made tangent in exact arithmetic: velocities lose their components along the
// gradients.
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace {

using detail::half_square;
using detail::keep;
using Vector = std::vector<Real>;

Real dot_product(const Vector& a, const Vector& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum = sum + a[k] * b[k];
  return sum;
}

// What is left of v when its components along the rows are removed.
Vector tangent(Vector v, std::vector<Vector> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Real square = dot_product(rows[i], rows[i]);
    if (square.is(0)) continue;
    const auto remove = [&](Vector& from) {
      const Real share = dot_product(rows[i], from) / square;
      for (std::size_t k = 0; k < from.size(); ++k) from[k] = from[k] - share * rows[i][k];
    };
    for (std::size_t j = i + 1; j < rows.size(); ++j) remove(rows[j]);
    remove(v);
  }
  return v;
}

Vector values_at(const Polynomials& polynomials, const Vector& q) {
  Vector values;
  for (const SparsePolynomial& p : polynomials) values.push_back(p.exactly(0, q));
  return values;
}

Polynomials gradient(const SparsePolynomial& p) {
  Polynomials slopes;
  for (std::size_t k = 0; k < p.variables(); ++k) slopes.push_back(p.derivative(k));
  return slopes;
}

// The state with momenta m v, v being what the rows leave of the recipe's momenta.
Vector with_tangent_momenta(const Recipe& recipe, const std::vector<Vector>& rows) {
  const std::size_t d = recipe.dimension / 2;
  Vector state = recipe.state;
  const Vector v = tangent({state.begin() + static_cast<std::ptrdiff_t>(d), state.end()}, rows);
  for (std::size_t k = 0; k < d; ++k) state[d + k] = recipe.masses[k] * v[k];
  return state;
}

SparsePolynomial kinetic_of(const Vector& masses) {
  SparsePolynomial kinetic(masses.size());
  for (std::size_t k = 0; k < masses.size(); ++k) {
    Powers powers(masses.size() + 1);
    powers[k] = 2;
    kinetic.add(powers, Real(1) / (Real(2) * masses[k]));
  }
  return kinetic;
}

// Sets constraints psi(q) = psi(q0) and a state on both levels of them.
void restrict_to(PolynomialSystem& system, const Recipe& recipe, const Polynomials& surfaces) {
  const std::size_t d = recipe.dimension / 2;
  const Vector q(recipe.state.begin(), recipe.state.begin() + static_cast<std::ptrdiff_t>(d));
  Polynomials constraints;
  std::vector<Vector> rows;
  for (const SparsePolynomial& psi : surfaces) {
    constraints.push_back(psi - SparsePolynomial::constant(d, psi.exactly(0, q)));
    rows.push_back(values_at(gradient(psi), q));
  }
  system.formulas[Formula::holonomic] = constraints;
  system.initial = with_tangent_momenta(recipe, rows);
}

void keep_angular_momentum(PolynomialSystem& system, std::size_t beads, std::size_t axes) {
  const std::size_t n = system.dimension, d = n / 2;
  SparsePolynomial sum(n);
  const auto x = [n](std::size_t k) { return SparsePolynomial::variable(n, k); };
  for (std::size_t bead = 0; bead < beads; ++bead) {
    const std::size_t k = bead * axes;
    sum = sum + x(k) * x(d + k + 1) - x(k + 1) * x(d + k);
  }
  keep(system, "angular-momentum", sum);
}

// Parts: V in one variable, put in |q|^2/2; beads are of equal mass in all directions.
void make_rods(PolynomialSystem& system, const Recipe& recipe) {
  const std::size_t d = recipe.dimension / 2, beads = d / 2;
  Polynomials surfaces;
  for (const auto& [first, second] : recipe.rods) {
    SparsePolynomial square(d);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      SparsePolynomial along = SparsePolynomial::variable(d, 2 * first + axis);
      if (second < beads) along = along - SparsePolynomial::variable(d, 2 * second + axis);
      square = square + along * along;
    }
    surfaces.push_back(Real::fraction(1, 2) * square);
  }
  system.formulas[Formula::potential] = {recipe.parts[0].front().at({half_square(d, 0, d)})};
  restrict_to(system, recipe, surfaces);
  keep_angular_momentum(system, beads, 2);
}

// Parts: V and psi in two variables, those of (x^2 + y^2)/2 and z.
void make_revolution(PolynomialSystem& system, const Recipe& recipe) {
  constexpr std::size_t d = 3;
  const Polynomials invariants{half_square(d, 0, 2), SparsePolynomial::variable(d, 2)};
  system.formulas[Formula::potential] = {recipe.parts[0].front().at(invariants)};
  restrict_to(system, recipe, {recipe.parts[1].front().at(invariants)});
  keep_angular_momentum(system, 1, d);
}

// Parts: H, f and g, each in 2 d variables; f and g do not contain the last position and momentum.
void make_second_class(PolynomialSystem& system, const Recipe& recipe) {
  const std::size_t n = recipe.dimension, d = n / 2;
  system.formulas[Formula::hamiltonian] = recipe.parts[0];
  for (const auto& [index, part] : {std::pair{d - 1, 1}, std::pair{n - 1, 2}}) {
    const SparsePolynomial psi =
        SparsePolynomial::variable(n, index) + recipe.parts[static_cast<std::size_t>(part)].front();
    system.formulas[Formula::constraints].push_back(
        psi - SparsePolynomial::constant(n, psi.exactly(0, recipe.state)));
  }
}

// Parts: V, and the rows of A one after the other, all in d variables.
void make_rolling(PolynomialSystem& system, const Recipe& recipe) {
  const std::size_t d = recipe.dimension / 2;
  const Vector q(recipe.state.begin(), recipe.state.begin() + static_cast<std::ptrdiff_t>(d));
  system.formulas[Formula::potential] = recipe.parts[0];
  system.formulas[Formula::velocity_constraints] = recipe.parts[1];
  const Vector entries = values_at(recipe.parts[1], q);
  std::vector<Vector> rows;
  for (std::size_t k = 0; k < entries.size(); k += d)
    rows.emplace_back(entries.begin() + static_cast<std::ptrdiff_t>(k),
                      entries.begin() + static_cast<std::ptrdiff_t>(k + d));
  system.initial = with_tangent_momenta(recipe, rows);
}

}  // namespace

// Parts of surfaces: V in d variables, and one psi for each constraint.
PolynomialSystem detail::constrained_system(const Recipe& recipe) {
  PolynomialSystem system;
  system.dimension = recipe.dimension;
  system.canonical = true;
  if (recipe.kind == SystemKind::second_class) {
    make_second_class(system, recipe);
    return system;
  }
  SparsePolynomial kinetic = kinetic_of(recipe.masses);
  if (recipe.kind == SystemKind::breathing_surface) {
    // A factor leaves momenta tangent that are tangent at time 0.
    const std::size_t d = kinetic.variables(), time = d;
    kinetic =
        (SparsePolynomial::constant(d, 1) + recipe.rate * SparsePolynomial::variable(d, time)) * kinetic;
  }
  system.formulas[Formula::kinetic] = {kinetic};
  if (recipe.kind == SystemKind::rods) {
    make_rods(system, recipe);
  } else if (recipe.kind == SystemKind::revolution) {
    make_revolution(system, recipe);
  } else if (recipe.kind == SystemKind::rolling) {
    make_rolling(system, recipe);
  } else {
    system.formulas[Formula::potential] = recipe.parts[0];
    restrict_to(system, recipe, recipe.parts[1]);
  }
  return system;
}

}  // namespace pfaff
