#include <pfaff/derive/derivation/redundancy.hpp>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/derive/derivation/witness.hpp>

namespace pfaff {

namespace {

class Probe final : public TapedConstraints<double> {
 public:
  using TapedConstraints<double>::TapedConstraints;

  // True where S, as last placed, is singular to round-off.
  [[nodiscard]] bool singular() const {
    StructuredLDLT<double> factors(
        std::shared_ptr<const SymmetricPattern>(std::shared_ptr<const void>(), &pattern()));
    std::copy(diagonal().begin(), diagonal().end(), factors.diagonal());
    std::copy(couplings().begin(), couplings().end(), factors.couplings());
    return factors.factor_semidefinite() == Status::converged && factors.dropped() > 0;
  }
};

// The first row of P diag(weight) P^T that depends on those before it; the number of rows where none does.
std::size_t first_dependent(const Probe& probe, const std::vector<double>& weight) {
  const std::size_t count = probe.count(), n = probe.degrees();
  std::vector<std::vector<double>> directions;
  std::vector<double> unit(count), row(n);
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = 1;
    probe.hidden_by_momentum_transpose(unit, row);
    unit[i] = 0;
    for (std::size_t a = 0; a < n; ++a) row[a] *= std::sqrt(weight[a]);
    const auto square = [&] {
      double sum = 0;
      for (const double x : row) sum += x * x;
      return sum;
    };
    const double whole = square();
    // Twice: what is left of a nearly dependent row is not orthogonal to round-off the first time.
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& direction : directions) {
        double along = 0;
        for (std::size_t a = 0; a < n; ++a) along += row[a] * direction[a];
        for (std::size_t a = 0; a < n; ++a) row[a] -= along * direction[a];
      }
    const double left = std::sqrt(square());
    constexpr double dependence = 1e-12;  // far above round-off, far below what generic numbers leave
    if (!(left > dependence * std::sqrt(whole))) return i;
    for (double& x : row) x /= left;
    directions.push_back(row);
  }
  return count;
}

}  // namespace

void refuse_redundant(const std::shared_ptr<const HolonomicTapes>& tapes, const SymbolicFormulas& source,
                      const Model& model, bool recursion) {
  std::vector<double> parameters;
  for (const Real& x : source.values) parameters.push_back(x.value());
  Probe probe(tapes, parameters);
  std::vector<double> z;
  for (const Real& x : generic_numbers(2 * probe.degrees())) z.push_back(x.value());
  const In<double> q = In<double>(z).first(probe.degrees()), p = In<double>(z).subspan(probe.degrees());
  (void)probe.place(0, q, p);
  const auto name = [&](std::size_t i) { return model.source().constraint_names[i]; };
  if (probe.singular()) {
    const std::size_t i = first_dependent(probe, std::vector<double>(probe.degrees(), 1));
    if (i < probe.count())
      throw InputError("system " + model.name() + ": constraint " + name(i) +
                       " is redundant, its pivot in S vanishes whatever the state; leave it out");
  }
  if (!recursion || probe.friction().empty()) return;
  const std::vector<double> lambda(probe.friction().begin(), probe.friction().end());
  if (const std::size_t i = first_dependent(probe, lambda); i < probe.count())
    throw InputError("system " + model.name() + ": the recursion breaks down at the friction of constraint " +
                     name(i) + ", whose pivot vanishes whatever the state; expected method ldl, or " +
                     "friction-form=none");
}

}  // namespace pfaff
