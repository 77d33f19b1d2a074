// The field of an energy H with two brackets, the skew Pi and the symmetric G. With an entropy S it is
// Pi dH + G dS, without one Pi dH - G dH.
#pragma once

#include <pfaff/core/facets/derivations/derivation.hpp>

namespace pfaff::derivations {

inline std::shared_ptr<const Tape> metriplectic_field(const Model& model) {
  const auto energy = model.tape(Formula::hamiltonian_gradient),
             poisson = model.tape(Formula::poisson_tensor), symmetric = model.tape(Formula::symmetric_tensor);
  const auto entropy = model.given(Formula::entropy) ? model.tape(Formula::entropy) : nullptr;
  const auto n = static_cast<std::size_t>(model.dimension());
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto slope = evaluate(*energy, t, z), pi = evaluate(*poisson, t, z),
                   g = evaluate(*symmetric, t, z);
        auto friction = slope;
        for (Recorded& x : friction) x = -x;
        if (entropy != nullptr) friction = gradient_of(*entropy, t, z);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            out[i] = out[i] + pi[i * n + j] * slope[j] + g[i * n + j] * friction[j];
      }));
}

inline constexpr std::array metriplectic{
    Derivation{Formula::field,
               {Formula::hamiltonian, Formula::poisson_tensor, Formula::symmetric_tensor},
               &has<Facet::metriplectic>,
               &metriplectic_field},
};

}  // namespace pfaff::derivations
