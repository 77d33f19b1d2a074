// Nonholonomic motion by Lagrange's multipliers, recorded from the formulas of a system and solved by
// Cramer's rule: an oracle that shares nothing with the formulations and the evaluators of constraints.
#pragma once

#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff::testing {

/// The field (q', p') of a system with one or two velocity constraints, followed by q'': M q'' + A^T lambda =
/// forces and A q'' + A' q' + b' = 0, with M^-1 = H_pp.
inline Tape multiplier_field(const Model& model) {
  const auto gradient = model.tape(Formula::hamiltonian_gradient);
  const auto rows = model.tape(Formula::velocity_constraints),
             offsets = model.tape(Formula::velocity_offsets);
  const auto n = static_cast<std::size_t>(model.dimension()), half = n / 2, count = offsets->outputs.size();
  return record(
      model.dimension(), static_cast<int>(n + half),
      [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
        const auto slopes = evaluate(*gradient, t, z), second = jacobian(*gradient, t, z);
        const auto q = z.first(half), v = std::span<const Recorded>(slopes).subspan(half);
        const auto a = evaluate(*rows, t, q), a_rate = directional_derivative(*rows, t, Recorded(1), q, v);
        const auto b_rate = directional_derivative(*offsets, t, Recorded(1), q, v);
        const auto by_momentum = [&](std::size_t i, std::size_t j) {
          return second[(half + i) * n + half + j];
        };
        // q'' without reactions, H_pq q' - H_pp H_q
        std::vector<Recorded> free(half, Recorded(0)), right, s(count * count, Recorded(0)), lambda;
        for (std::size_t i = 0; i < half; ++i)
          for (std::size_t j = 0; j < half; ++j)
            free[i] = free[i] + second[(half + i) * n + j] * v[j] - by_momentum(i, j) * slopes[j];
        for (std::size_t k = 0; k < count; ++k) {
          right.push_back(b_rate[k]);
          for (std::size_t i = 0; i < half; ++i) {
            right[k] = right[k] + a[k * half + i] * free[i] + a_rate[k * half + i] * v[i];
            for (std::size_t l = 0; l < count; ++l)
              for (std::size_t j = 0; j < half; ++j)
                s[k * count + l] = s[k * count + l] + a[k * half + i] * by_momentum(i, j) * a[l * half + j];
          }
        }
        if (count == 1) {
          lambda = {right[0] / s[0]};
        } else {
          const Recorded determinant = s[0] * s[3] - s[1] * s[2];
          lambda = {(right[0] * s[3] - right[1] * s[1]) / determinant,
                    (right[1] * s[0] - right[0] * s[2]) / determinant};
        }
        for (std::size_t i = 0; i < half; ++i) {
          out[i] = v[i];
          out[half + i] = -slopes[i];
          for (std::size_t k = 0; k < count; ++k) out[half + i] = out[half + i] - a[k * half + i] * lambda[k];
        }
        for (std::size_t i = 0; i < half; ++i) {
          out[n + i] = Recorded(0);
          for (std::size_t j = 0; j < half; ++j)
            out[n + i] = out[n + i] + second[(half + i) * n + j] * v[j] + by_momentum(i, j) * out[half + j];
        }
      });
}

}  // namespace pfaff::testing
