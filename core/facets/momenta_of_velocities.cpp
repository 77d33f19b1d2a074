#include <pfaff/core/facets/momenta_of_velocities.hpp>

#include <algorithm>
#include <optional>
#include <string>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
// The size of the largest number; not-a-number where one is.
Quad largest_of(const std::vector<Quad>& x) {
  Quad largest(0);
  for (const Quad& one : x) largest = isnan(one) ? one : std::max(largest, abs(one));
  return largest;
}

// H_p - v, and the matrix H_pp, at positions that stay the same.
class VelocityEquations {
 public:
  VelocityEquations(const std::shared_ptr<const Tape>& energy, const Real& time, const std::vector<Real>& q,
                    const std::vector<Real>& v)
      : m_(v.size()),
        time_(time.quad()),
        point_(static_cast<std::size_t>(energy->inputs)),
        values_(m_ * (1 + point_.size())) {
    for (const Real& x : v) wanted_.push_back(x.quad());
    first_ = point_.size() - m_;
    for (std::size_t k = 0; k < first_; ++k) point_[k] = q[k].quad();
    const int inputs = energy->inputs, results = static_cast<int>(m_);
    const Tape slopes = record(inputs, results, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
      const std::vector<Recorded> one{Recorded(1)}, gradient = pfaff::gradient(*energy, t, z, one);
      std::copy(gradient.begin() + static_cast<std::ptrdiff_t>(first_), gradient.end(), out.begin());
    });
    replay_.emplace(std::make_shared<const Tape>(
        record(inputs, results * (1 + inputs), [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
          const std::vector<Recorded> value = evaluate(slopes, t, z), slope = jacobian(slopes, t, z);
          std::copy(slope.begin(), slope.end(), std::copy(value.begin(), value.end(), out.begin()));
        })));
  }

  // H_p - v at these momenta.
  std::vector<Quad> residual(const std::vector<Quad>& p) {
    std::copy(p.begin(), p.end(), point_.begin() + static_cast<std::ptrdiff_t>(first_));
    (*replay_)(time_, point_.data(), values_.data());
    std::vector<Quad> out(m_);
    for (std::size_t k = 0; k < m_; ++k) out[k] = values_[k] - wanted_[k];
    return out;
  }
  // The change of momenta that would remove a residual at those of the last call; nothing where H_pp is
  // singular.
  [[nodiscard]] std::vector<Quad> change(const std::vector<Quad>& residual) const {
    LU<Quad> lu(m_);
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t j = 0; j < m_; ++j) lu(i, j) = values_[m_ + i * point_.size() + first_ + j];
    if (!lu.factor()) return {};
    std::vector<Quad> out(m_);
    lu.solve(residual.data(), out.data());
    return out;
  }
  [[nodiscard]] Quad scale() const { return largest_of(wanted_); }

 private:
  std::size_t m_, first_ = 0;
  Quad time_;
  std::vector<Quad> point_, values_, wanted_;
  std::optional<Replay<Quad>> replay_;
};
}  // namespace

std::shared_ptr<const Tape> energy_of_velocities(const Model& model) {
  const FacetSet content = model.content();
  const bool in_phase_space = content.has(Facet::constraints) && !content.has(Facet::holonomic);
  if (in_phase_space || content.has(Facet::metriplectic)) return nullptr;
  if (content.meets(facets(Facet::separable, Facet::conformal))) return model.tape(Formula::kinetic);
  return model.canonical() && model.has_energy() ? model.tape(Formula::hamiltonian) : nullptr;
}

std::vector<Real> momenta_of_velocities(const std::shared_ptr<const Tape>& energy, const Real& t,
                                        const std::vector<Real>& q, const std::vector<Real>& v) {
  constexpr int most_iterations = 100, most_halvings = 30;
  constexpr std::size_t most = 2000;  // the matrix H_pp is dense
  if (v.size() > most)
    throw InputError("expected at most " + std::to_string(most) + " positions beside velocities, got " +
                     std::to_string(v.size()) + "; give momenta instead");
  constexpr double round_off = 1e-28;
  VelocityEquations velocities(energy, t, q, v);
  std::vector<Quad> p(v.size()), residual = velocities.residual(p);
  const Quad scale = std::max(velocities.scale(), largest_of(residual));
  bool better = true;
  for (int k = 0; k < most_iterations && better; ++k) {
    const std::vector<Quad> change = velocities.change(residual);
    // Far from the solution a whole step may lead further away, to where a root has no value, too.
    Quad part(1);
    better = false;
    for (int halved = 0; halved < most_halvings && !better && !change.empty(); ++halved, part = part / 2) {
      std::vector<Quad> next = p;
      for (std::size_t i = 0; i < p.size(); ++i) next[i] -= part * change[i];
      std::vector<Quad> left = velocities.residual(next);
      better = largest_of(left) < largest_of(residual);
      if (better) p = std::move(next), residual = std::move(left);
    }
  }
  if (!(largest_of(residual) <= Quad(round_off) * scale))
    throw InputError(
        "no momenta p with H_p = v were found from p = 0; expected momenta in `initial` instead");
  return {p.begin(), p.end()};
}

}  // namespace pfaff
