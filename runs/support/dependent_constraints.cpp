// Which rows of A of velocity constraints A v + b = 0 depend on each other.
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff {

namespace {

Quad dot(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  Quad sum(0);
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

// Orthonormal vectors, each with the combination of rows that it is.
struct Direction {
  std::vector<Quad> vector, combination;
};

// What remains of row i beside the directions found so far, as a combination of rows too. It is taken twice,
// because the first remainder of nearly dependent rows is not orthogonal to round-off.
Direction remainder(std::vector<Quad> row, std::size_t i, std::size_t count,
                    const std::vector<Direction>& found) {
  Direction rest{std::move(row), std::vector<Quad>(count)};
  rest.combination[i] = Quad(1);
  for (int pass = 0; pass < 2; ++pass)
    for (const Direction& d : found) {
      const Quad along = dot(rest.vector, d.vector);
      for (std::size_t k = 0; k < rest.vector.size(); ++k) rest.vector[k] -= along * d.vector[k];
      for (std::size_t k = 0; k < count; ++k) rest.combination[k] -= along * d.combination[k];
    }
  return rest;
}

// Rows are dependent where one differs from a combination of others by a unit of round-off of doubles, in
// which states are given.
constexpr double dependence = 1e-14;

// The sentence about row i, which is a combination of earlier rows.
std::string dependent_row(const Direction& rest, std::size_t i, const std::vector<Quad>& b, const Quad& size,
                          const std::vector<std::string>& names) {
  std::string others;
  Quad sum(0), terms(0);
  for (std::size_t k = 0; k <= i; ++k) {
    if (!(abs(rest.combination[k]) > Quad(dependence))) continue;
    if (k < i) others += (others.empty() ? "" : " and ") + names[k];
    sum += rest.combination[k] * b[k];
    terms += abs(rest.combination[k] * b[k]);
  }
  if (abs(sum) > Quad(dependence) * (terms + size))
    return others.empty()
               ? "velocity constraint " + names[i] + " is kept by no velocity: its row of A is zero"
               : "velocity constraint " + names[i] + " contradicts " + others +
                     ": no velocity keeps them all";
  return others.empty() ? "the row of A of velocity constraint " + names[i] + " is zero"
                        : "the row of A of velocity constraint " + names[i] + " depends on that of " + others;
}

}  // namespace

std::string dependent_velocity_constraints(const Model& model, const Quad& t, const std::vector<Quad>& z) {
  const auto constraints = model.velocity_constraints<Quad>();
  const std::size_t n = constraints->degrees(), count = constraints->count();
  const In<Quad> q = In<Quad>(z).first(n), p = In<Quad>(z).subspan(n);
  const Status status = constraints->linearise(t, q, p);
  // The work grows with the square of the number of constraints; of many, only those that fail are looked at.
  constexpr std::size_t many = 100;
  if (count > many && status == Status::converged) return {};
  const std::vector<std::string> names = velocity_constraint_names(model);
  std::vector<Quad> psi(count), b(count), unit(count), row(n), v(n);
  constraints->values(t, q, p, psi);
  constraints->velocity(t, q, p, v);
  constraints->apply(v, b);
  for (std::size_t i = 0; i < count; ++i) b[i] = psi[i] - b[i];
  std::vector<Direction> found;
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = Quad(1);
    constraints->apply_transpose(unit, row);
    unit[i] = Quad(0);
    const Quad size = sqrt(dot(row, row));
    if (!isfinite(size)) return {};  // a state outside the domain of the formulas is told apart elsewhere
    Direction rest = remainder(row, i, count, found);
    const Quad left = sqrt(dot(rest.vector, rest.vector));
    if (!(left > Quad(dependence) * size)) return dependent_row(rest, i, b, size, names);
    for (Quad& x : rest.vector) x /= left;
    for (Quad& x : rest.combination) x /= left;
    found.push_back(std::move(rest));
  }
  if (status == Status::converged) return {};
  return "the mass matrix is degenerate along the velocity constraints (A H_pp A^T is singular)";
}

}  // namespace pfaff
