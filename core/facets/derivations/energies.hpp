// What follows from energies: H = T + V, its gradient, forces and velocities, the field Pi grad H, and the
// field with friction, p' = -V_q - nu p.
#pragma once

#include <pfaff/core/facets/derivations/derivation.hpp>
#include <pfaff/core/facets/taped_parts.hpp>

namespace pfaff::derivations {

inline std::shared_ptr<const Tape> sum_of_energies(const Model& model) {
  const auto kinetic = model.tape(Formula::kinetic), potential = model.tape(Formula::potential);
  return shared(record(model.dimension(), 1, [&](const Recorded& t, Arguments z, Results out) {
    const std::size_t half = z.size() / 2;
    out[0] = evaluate(*kinetic, t, z.subspan(half))[0] + evaluate(*potential, t, z.first(half))[0];
  }));
}
inline std::shared_ptr<const Tape> gradient_of_hamiltonian(const Model& model) {
  const auto energy = model.tape(Formula::hamiltonian);
  const int n = model.dimension();
  return shared(record(
      n, n, [&](const Recorded& t, Arguments z, Results out) { copy(gradient_of(*energy, t, z), out); }));
}

inline bool separates(const Model& model) {
  return has<Facet::separable>(model) || has<Facet::conformal>(model);
}
/// dT/dp of the kinetic energy, or -dV/dq of the potential one.
template <Formula Energy>
std::shared_ptr<const Tape> slope_of(const Model& model) {
  const auto energy = model.tape(Energy);
  const int half = model.dimension() / 2;
  return shared(record(half, half, [&](const Recorded& t, Arguments x, Results out) {
    const auto slope = gradient_of(*energy, t, x);
    for (std::size_t k = 0; k < slope.size(); ++k)
      out[k] = Energy == Formula::potential ? -slope[k] : slope[k];
  }));
}

/// The field (T_p, -V_q), with the author's force and velocity where there are any.
inline std::shared_ptr<const Tape> separable_field(const Model& model) {
  const auto velocity = model.tape(Formula::velocity), force = model.tape(Formula::force);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const std::size_t half = z.size() / 2;
        copy(evaluate(*velocity, t, z.subspan(half)), out.first(half));
        copy(evaluate(*force, t, z.first(half)), out.subspan(half));
      }));
}
inline bool canonical_energy(const Model& model) {
  return has<Facet::hamiltonian>(model) && model.canonical();
}
inline std::shared_ptr<const Tape> canonical_field(const Model& model) {
  const auto energy = model.tape(Formula::hamiltonian);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        canonical_sharp(gradient_of(*energy, t, z), out);
      }));
}
inline std::shared_ptr<const Tape> bracket_field(const Model& model) {
  const auto energy = model.tape(Formula::hamiltonian), tensor = model.tape(Formula::poisson_tensor);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto slope = gradient_of(*energy, t, z), pi = evaluate(*tensor, t, z);
        for (std::size_t i = 0, size = z.size(); i < size; ++i) {
          out[i] = Recorded(0);
          for (std::size_t j = 0; j < size; ++j) out[i] = out[i] + pi[i * size + j] * slope[j];
        }
      }));
}
inline bool is_forced(const Model& model) { return model.forced() && canonical_energy(model); }
/// (H_p, -H_q + Q) with applied forces Q.
inline std::shared_ptr<const Tape> forced_field(const Model& model) {
  const auto slopes = slopes_of_motion(model);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        copy(flow_of(*slopes, t, {z.begin(), z.end()}), out);
      }));
}
/// (T_p, -V_q - nu p), which the conformal facet stands for.
inline std::shared_ptr<const Tape> damped_field(const Model& model) {
  const auto velocity = model.tape(Formula::velocity), force = model.tape(Formula::force);
  const auto half = static_cast<std::size_t>(velocity->inputs);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto rate = evaluate(*velocity, t, z.subspan(half)), slope = evaluate(*force, t, z.first(half));
        for (std::size_t k = 0; k < half; ++k) {
          out[k] = rate[k];
          out[half + k] = slope[k] - model.damping() * z[half + k];
        }
      }));
}

inline bool has_field(const Model& model) { return gives<Formula::field>(model); }

inline constexpr std::array energies{
    Derivation{Formula::hamiltonian,
               {Formula::kinetic, Formula::potential, none},
               &has<Facet::separable>,
               &sum_of_energies},
    Derivation{Formula::hamiltonian_gradient,
               {Formula::hamiltonian, none, none},
               &has<Facet::hamiltonian>,
               &gradient_of_hamiltonian},
    Derivation{Formula::velocity, {Formula::kinetic, none, none}, &separates, &slope_of<Formula::kinetic>},
    Derivation{Formula::force, {Formula::potential, none, none}, &separates, &slope_of<Formula::potential>},
    Derivation{Formula::field,
               {Formula::hamiltonian_gradient, Formula::applied_force, none},
               &is_forced,
               &forced_field},
    Derivation{
        Formula::field, {Formula::velocity, Formula::force, none}, &has<Facet::separable>, &separable_field},
    Derivation{Formula::field, {Formula::hamiltonian, none, none}, &canonical_energy, &canonical_field},
    Derivation{Formula::field,
               {Formula::hamiltonian, Formula::poisson_tensor, none},
               &has<Facet::hamiltonian>,
               &bracket_field},
    Derivation{
        Formula::field_jacobian, {Formula::field, none, none}, &has_field, &jacobian_of<Formula::field>},
};
/// Friction stands after the structures (derivations.cpp), so that a structure written beside it makes the
/// field.
inline constexpr std::array damped_energies{
    Derivation{
        Formula::field, {Formula::velocity, Formula::force, none}, &has<Facet::conformal>, &damped_field},
};

}  // namespace pfaff::derivations
