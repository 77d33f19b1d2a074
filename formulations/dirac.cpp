// Dirac's formulation: the vector field {z, H}_D - <z, H>_D of the skew and the symmetric Dirac bracket.
// Symbols are those of core/facets/holonomic.hpp.
//
// Holonomic constraints (nguyen-turski (4.2)): formulations/hamiltonian_reactions.hpp. phi and phi~ are
// Casimirs: they are kept off the constraint surface too, and without friction H is. Constraints phi(z, t) of
// the phase space (1.2), X_i = Pi dphi_i, W_ij = dphi_i.X_j:
//   z' = Pi dH - sum_i X_i c_i,   W c = dphi Pi dH + phi_t,
// The field of a symmetric bracket is treated in the same way. In both, constraints that are Casimirs of the
// bracket already are left out: their X_i vanish, and W would be singular.
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/formulations/hamiltonian_reactions.hpp>

namespace {
using namespace pfaff;
using Numbers = std::vector<Recorded>;

// Where `vector` is the sharp of a covector with a bracket's `tensor`, returns its sharp with the Dirac
// bracket: `vector` minus sum_i X_i c_i with W c = dphi vector + shift.
Numbers dirac_projection(const Numbers& tensor, const Numbers& gradients, const Numbers& shift,
                         Numbers vector) {
  const std::size_t n = vector.size();
  Numbers sharps, rows;  // X_i and dphi_i of the constraints that are not Casimirs
  Numbers right;
  for (std::size_t i = 0; i * n < gradients.size(); ++i) {
    Numbers x(n);
    bool casimir = true;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) x[a] = x[a] + tensor[a * n + b] * gradients[i * n + b];
      casimir = casimir && structurally_zero(x[a]);
    }
    if (casimir) continue;
    sharps.insert(sharps.end(), x.begin(), x.end());
    Recorded r = shift.empty() ? Recorded(0) : shift[i];
    for (std::size_t a = 0; a < n; ++a) {
      rows.push_back(gradients[i * n + a]);
      r = r + gradients[i * n + a] * vector[a];
    }
    right.push_back(r);
  }
  const std::size_t count = right.size();
  if (count == 0) return vector;
  Numbers w(count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t a = 0; a < n; ++a)
        w[i * count + j] = w[i * count + j] + rows[i * n + a] * sharps[j * n + a];
  const Numbers c = solve(w, right);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < n; ++a) vector[a] = vector[a] - sharps[i * n + a] * c[i];
  return vector;
}

Numbers times(const Numbers& matrix, const Numbers& vector) {
  const std::size_t n = vector.size();
  Numbers product(n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) product[a] = product[a] + matrix[a * n + b] * vector[b];
  return product;
}

struct Dirac : WithFriction {
  Dirac() : WithFriction(FrictionForm::metriplectic) {}
  static std::vector<Parameter> parameters() { return {friction_parameter<Dirac>()}; }

  template <class T>
  struct Work {
    Work(const Dirac& formulation, HolonomicConstraints<T>& constraints)
        : rates(formulation.friction(), constraints) {}
    HamiltonianReactions<T> rates;
  };

  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    return w.rates(constraints, t, q, p, q_rate, p_rate);
  }

  [[nodiscard]] Tape field_tape(const Model& model) const {
    const auto poisson = model.tape(Formula::poisson_tensor),
               slopes = model.tape(Formula::constraint_gradients),
               energy = model.tape(Formula::hamiltonian_gradient), phi = model.tape(Formula::constraints);
    const bool dissipates = model.given(Formula::symmetric_tensor) && friction() != FrictionForm::none;
    const auto symmetric = dissipates ? model.tape(Formula::symmetric_tensor) : nullptr;
    const auto entropy = dissipates && model.given(Formula::entropy) ? model.tape(Formula::entropy) : nullptr;
    return record(model.dimension(), model.dimension(),
                  [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
                    const Numbers pi = evaluate(*poisson, t, z), dphi = evaluate(*slopes, t, z),
                                  dh = evaluate(*energy, t, z);
                    Numbers rate = dirac_projection(pi, dphi, time_derivative(*phi, t, z), times(pi, dh));
                    if (symmetric != nullptr) {
                      const Numbers g = evaluate(*symmetric, t, z), one{Recorded(1)};
                      Numbers direction = dh;
                      for (Recorded& x : direction) x = -x;
                      if (entropy != nullptr) direction = gradient(*entropy, t, z, one);
                      const Numbers friction = dirac_projection(g, dphi, {}, times(g, direction));
                      for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = rate[k] + friction[k];
                    }
                    for (std::size_t k = 0; k < rate.size(); ++k) out[k] = rate[k];
                  });
  }
};

const Formulation<Dirac> registered{
    {.name = "dirac",
     .title = "Dirac brackets: constraints are Casimirs, on and off the surface",
     .reference = "nguyen-turski (1.2), (4.2)",
     .description =
         "The field of the Hamiltonian in the Dirac bracket of the constraints, defined on and off their "
         "surface. Take it with methods for vector fields: constraints and hidden constraints are Casimirs, "
         "and without friction the energy is kept too, wherever the state is, so that rounding and "
         "truncation errors are not amplified. Each right-hand side costs two solves with S for holonomic "
         "constraints, and a dense solve for constraints of the phase space, which must be second class.",
     .reactions = Reactions::hamiltonian,
     .keeps = {FormulationClaim::tangent, FormulationClaim::hidden_constraints, FormulationClaim::constraints,
               FormulationClaim::energy}}};
}  // namespace
