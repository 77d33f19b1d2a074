// Unconstrained systems in canonical coordinates z = (q, p), and what all kinds share.
#include <array>

#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace detail {

SparsePolynomial moved(const SparsePolynomial& p, std::size_t variables, std::size_t first) {
  std::vector<SparsePolynomial> values;
  for (std::size_t k = 0; k < p.variables(); ++k)
    values.push_back(SparsePolynomial::variable(variables, first + k));
  return p.at(values);
}

SparsePolynomial half_square(std::size_t variables, std::size_t first, std::size_t count) {
  SparsePolynomial sum(variables);
  for (std::size_t k = first; k < first + count; ++k) {
    Powers powers(variables + 1);
    powers[k] = 2;
    sum.add(powers, Real::fraction(1, 2));
  }
  return sum;
}

void keep(PolynomialSystem& system, const char* name, const SparsePolynomial& invariant) {
  system.invariants.push_back({name, "", Behaviour::conserved, invariant.homogeneous(2)});
  system.formulas[Formula::invariants].push_back(invariant);
}

}  // namespace detail

namespace {

using detail::keep;

// With H(q, -p) = H(q, p), and no time, turning the momenta reverses the motion.
void add_reversal(PolynomialSystem& system, const SparsePolynomial& energy) {
  const std::size_t n = system.dimension;
  std::vector<SparsePolynomial> reversed;
  for (std::size_t k = 0; k < n; ++k)
    reversed.push_back(Real(k < n / 2 ? 1 : -1) * SparsePolynomial::variable(n, k));
  if (!energy.depends_on(n) && energy.at(reversed) == energy)
    system.formulas.emplace(Formula::reversal, std::move(reversed));
}

void add_energy(PolynomialSystem& system, const SparsePolynomial& energy) {
  if (!energy.depends_on(system.dimension)) keep(system, "energy", energy);
  add_reversal(system, energy);
}

}  // namespace

// Parts: T and V, each in d variables; of nonseparable systems H, in 2 d.
PolynomialSystem detail::canonical_system(const Recipe& recipe) {
  PolynomialSystem system;
  const std::size_t n = recipe.dimension, d = n / 2;
  system.dimension = n;
  system.canonical = recipe.kind != SystemKind::damped;
  if (recipe.kind == SystemKind::nonseparable) {
    system.formulas[Formula::hamiltonian] = recipe.parts[0];
    add_energy(system, recipe.parts[0].front());
    return system;
  }
  system.formulas[Formula::kinetic] = recipe.parts[0];
  system.formulas[Formula::potential] = recipe.parts[1];
  if (recipe.kind == SystemKind::damped) {
    system.damping = recipe.rate;
    return system;
  }
  add_energy(system, moved(recipe.parts[0].front(), n, d) + moved(recipe.parts[1].front(), n, 0));
  return system;
}

// Parts: T and V, each in one variable, or H in the three of (|q|^2/2, |p|^2/2, q.p). The angular momentum of
// every pair of axes is kept.
PolynomialSystem detail::central_system(const Recipe& recipe) {
  PolynomialSystem system;
  const std::size_t n = recipe.dimension, d = n / 2;
  system.dimension = n;
  system.canonical = true;
  if (recipe.kind == SystemKind::central) {
    const SparsePolynomial square = half_square(d, 0, d);
    const SparsePolynomial kinetic = recipe.parts[0].front().at({square});
    const SparsePolynomial potential = recipe.parts[1].front().at({square});
    system.formulas[Formula::kinetic] = {kinetic};
    system.formulas[Formula::potential] = {potential};
    add_energy(system, moved(kinetic, n, d) + moved(potential, n, 0));
  } else {
    SparsePolynomial product(n);
    for (std::size_t k = 0; k < d; ++k)
      product = product + SparsePolynomial::variable(n, k) * SparsePolynomial::variable(n, d + k);
    const SparsePolynomial energy =
        recipe.parts[0].front().at({half_square(n, 0, d), half_square(n, d, d), product});
    system.formulas[Formula::hamiltonian] = {energy};
    add_energy(system, energy);
  }
  const auto x = [n](std::size_t k) { return SparsePolynomial::variable(n, k); };
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = i + 1; j < d; ++j)
      keep(system, "angular-momentum", x(i) * x(d + j) - x(j) * x(d + i));
  return system;
}

namespace {

// T in p and functions of its components as a polynomial that is the same with -p, where it is.
bool even(const SparsePolynomial& kinetic, const std::vector<AppliedFunction>& applied) {
  const std::size_t read = kinetic.variables() - applied.size();
  Polynomials turned;
  for (std::size_t k = 0; k < kinetic.variables(); ++k) {
    const bool odd = k < read || applied[k - read].function == Function::sine;
    if (k >= read && applied[k - read].function == Function::exponential && kinetic.depends_on(k))
      return false;
    turned.push_back(Real(odd ? -1 : 1) * SparsePolynomial::variable(kinetic.variables(), k));
  }
  return kinetic.at(turned) == kinetic;
}

// A polynomial in so many first ones of `variables`, beginning with `first`, and in functions of them, which
// begin with `functions`, as a polynomial in all.
SparsePolynomial placed(const SparsePolynomial& p, std::size_t read, std::size_t variables, std::size_t first,
                        std::size_t functions) {
  Polynomials values;
  for (std::size_t k = 0; k < p.variables(); ++k)
    values.push_back(SparsePolynomial::variable(variables, k < read ? first + k : functions + k - read));
  return p.at(values);
}

}  // namespace

// Parts: T and V, each in d variables and in the functions of them that `applied` lists.
PolynomialSystem detail::transcendental_system(const Recipe& recipe) {
  PolynomialSystem system;
  const std::size_t n = recipe.dimension, d = n / 2;
  system.dimension = n;
  system.canonical = true;
  const SparsePolynomial &kinetic = recipe.parts[0].front(), &potential = recipe.parts[1].front();
  system.formulas[Formula::kinetic] = {kinetic};
  system.formulas[Formula::potential] = {potential};
  system.applied[Formula::kinetic] = recipe.applied[0];
  system.applied[Formula::potential] = recipe.applied[1];
  const std::size_t of_momenta = recipe.applied[0].size(), all = n + of_momenta + recipe.applied[1].size();
  std::vector<AppliedFunction>& applied = system.applied[Formula::invariants];
  for (const AppliedFunction& f : recipe.applied[0]) applied.push_back({f.function, d + f.variable});
  applied.insert(applied.end(), recipe.applied[1].begin(), recipe.applied[1].end());
  const SparsePolynomial energy =
      placed(kinetic, d, all, d, n) + placed(potential, d, all, 0, n + of_momenta);
  bool polynomial = true;
  for (std::size_t k = n; k < all; ++k) polynomial = polynomial && !energy.depends_on(k);
  system.invariants.push_back({"energy", "", Behaviour::conserved, polynomial && energy.homogeneous(2)});
  system.formulas[Formula::invariants] = {energy};
  if (even(kinetic, recipe.applied[0])) {
    Polynomials reversed;
    for (std::size_t k = 0; k < n; ++k)
      reversed.push_back(Real(k < d ? 1 : -1) * SparsePolynomial::variable(n, k));
    system.formulas[Formula::reversal] = std::move(reversed);
  }
  return system;
}

std::string_view to_string(SystemKind kind) {
  constexpr std::array<std::string_view, system_kinds.size()> names{"separable",
                                                                    "driven",
                                                                    "nonseparable",
                                                                    "damped",
                                                                    "central",
                                                                    "central-nonseparable",
                                                                    "scaled-form",
                                                                    "sheared-form",
                                                                    "casimir-bracket",
                                                                    "metriplectic",
                                                                    "field",
                                                                    "skew-field",
                                                                    "surface",
                                                                    "revolution",
                                                                    "rods",
                                                                    "second-class",
                                                                    "rolling",
                                                                    "transcendental",
                                                                    "breathing",
                                                                    "breathing-surface",
                                                                    "concave-metriplectic"};
  return names[static_cast<std::size_t>(kind)];
}

PolynomialSystem system_of(const Recipe& recipe) {
  PolynomialSystem system;
  switch (recipe.kind) {
    case SystemKind::separable:
    case SystemKind::driven:
    case SystemKind::nonseparable:
    case SystemKind::damped:
    case SystemKind::breathing:
      system = detail::canonical_system(recipe);
      break;
    case SystemKind::central:
    case SystemKind::central_nonseparable:
      system = detail::central_system(recipe);
      break;
    case SystemKind::transcendental:
      system = detail::transcendental_system(recipe);
      break;
    case SystemKind::scaled_form:
    case SystemKind::sheared_form:
      system = detail::birkhoffian_system(recipe);
      break;
    case SystemKind::casimir_bracket:
    case SystemKind::metriplectic:
    case SystemKind::concave_metriplectic:
      system = detail::bracket_system(recipe);
      break;
    case SystemKind::field:
    case SystemKind::skew_field:
      system = detail::field_system(recipe);
      break;
    case SystemKind::surface:
    case SystemKind::revolution:
    case SystemKind::rods:
    case SystemKind::second_class:
    case SystemKind::rolling:
    case SystemKind::breathing_surface:
      system = detail::constrained_system(recipe);
      break;
  }
  if (system.initial.empty()) system.initial = recipe.state;
  system.name = std::string("random-").append(to_string(recipe.kind));
  system.title = std::string("random system: ").append(to_string(recipe.kind));
  return system;
}

}  // namespace pfaff
