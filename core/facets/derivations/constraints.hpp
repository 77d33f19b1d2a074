// All constraints of the phase space and their gradients. Every holonomic constraint phi(q, t) = 0 is
// followed by the hidden one it implies, phi~ = {phi, H} + phi_t; constraints of velocities come after all of
// those, as psi(q, p, t) = A(q, t) v + b(q, t) with v = H_p.
#pragma once

#include <pfaff/core/facets/derivations/derivation.hpp>

namespace pfaff::derivations {

inline std::shared_ptr<const Tape> with_hidden_constraints(const Model& model) {
  const auto phi = model.tape(Formula::holonomic), slopes = model.tape(Formula::hamiltonian_gradient);
  const auto count = static_cast<int>(phi->outputs.size());
  return shared(record(model.dimension(), 2 * count, [&](const Recorded& t, Arguments z, Results out) {
    const std::size_t half = z.size() / 2;
    const auto q = z.first(half);
    const auto values = evaluate(*phi, t, q), slope = evaluate(*slopes, t, z);
    const auto rates = directional_derivative(*phi, t, Recorded(1), q, Arguments(slope).subspan(half));
    for (std::size_t k = 0; k < values.size(); ++k) {
      out[2 * k] = values[k];
      out[2 * k + 1] = rates[k];
    }
  }));
}

inline std::shared_ptr<const Tape> no_offsets(const Model& model) {
  const Tape& rows = *model.tape(Formula::velocity_constraints);
  const auto count = static_cast<int>(rows.outputs.size()) / rows.inputs;
  return shared(record(rows.inputs, count, [](const Recorded&, Arguments, Results) {}));
}
inline std::shared_ptr<const Tape> with_velocity_constraints(const Model& model) {
  const auto rows = model.tape(Formula::velocity_constraints),
             offsets = model.tape(Formula::velocity_offsets),
             slopes = model.tape(Formula::hamiltonian_gradient);
  const auto holonomic = has<Facet::holonomic>(model) ? with_hidden_constraints(model) : nullptr;
  const std::size_t before = holonomic == nullptr ? 0 : holonomic->outputs.size(),
                    count = offsets->outputs.size();
  return shared(record(model.dimension(), static_cast<int>(before + count),
                       [&](const Recorded& t, Arguments z, Results out) {
                         const std::size_t half = z.size() / 2;
                         if (holonomic != nullptr) copy(evaluate(*holonomic, t, z), out);
                         const auto a = evaluate(*rows, t, z.first(half)), slope = evaluate(*slopes, t, z);
                         copy(evaluate(*offsets, t, z.first(half)), out.subspan(before));
                         for (std::size_t i = 0; i < count; ++i)
                           for (std::size_t k = 0; k < half; ++k)
                             out[before + i] = out[before + i] + a[i * half + k] * slope[half + k];
                       }));
}
inline bool restricted(const Model& model) { return model.restricted(); }

inline constexpr std::array constraints{
    Derivation{Formula::velocity_offsets,
               {Formula::velocity_constraints, none, none},
               &has<Facet::velocity_constraints>,
               &no_offsets},
    Derivation{Formula::constraints,
               {Formula::velocity_constraints, Formula::velocity_offsets, Formula::hamiltonian_gradient},
               &has<Facet::velocity_constraints>,
               &with_velocity_constraints},
    Derivation{Formula::constraints,
               {Formula::holonomic, Formula::hamiltonian_gradient, none},
               &has<Facet::holonomic>,
               &with_hidden_constraints},
    Derivation{Formula::constraint_gradients,
               {Formula::constraints, none, none},
               &restricted,
               &jacobian_of<Formula::constraints>},
};

}  // namespace pfaff::derivations
