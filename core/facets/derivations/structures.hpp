// What follows from structures. The action form F.dz - B dt gives K = dF and D = -(grad B + F_t), su-qin (4),
// (5), (67); K zdot + D = 0 gives the field and the Poisson tensor K^-1, by solving; for canonical
// coordinates K and its inverse are known.
#pragma once

#include <pfaff/core/facets/derivations/derivation.hpp>

namespace pfaff::derivations {

/// K_ij = d_i F_j - d_j F_i.
inline std::shared_ptr<const Tape> exterior_derivative(const Model& model) {
  const auto form = model.tape(Formula::one_form);
  const int n = model.dimension();
  return shared(record(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto slope = jacobian(*form, t, z);  // slope[j][i] = d_i F_j
    const std::size_t size = z.size();
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) out[i * size + j] = slope[j * size + i] - slope[i * size + j];
  }));
}
inline bool canonical(const Model& model) { return model.canonical(); }
/// The structure of canonical coordinates, K = [[0, -1], [1, 0]], which is dF of F = (p, 0).
inline std::shared_ptr<const Tape> canonical_structure(const Model& model) {
  return canonical_matrix(model, -1);
}
inline std::shared_ptr<const Tape> canonical_tensor(const Model& model) { return canonical_matrix(model, 1); }

inline std::shared_ptr<const Tape> covector_of_action(const Model& model) {
  const auto function = model.tape(Formula::birkhoffian), form = model.tape(Formula::one_form);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto slope = gradient_of(*function, t, z);
        const auto form_t = time_derivative(*form, t, z);
        for (std::size_t k = 0; k < z.size(); ++k) out[k] = -(slope[k] + form_t[k]);
      }));
}
inline std::shared_ptr<const Tape> inverse_structure(const Model& model) {
  const auto structure = model.tape(Formula::structure);
  const int n = model.dimension();
  return shared(record(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto k = evaluate(*structure, t, z);
    for (std::size_t column = 0, size = z.size(); column < size; ++column) {
      std::vector<Recorded> unit(size);
      unit[column] = Recorded(1);
      const auto x = solve(k, unit);
      for (std::size_t row = 0; row < size; ++row) out[row * size + column] = x[row];
    }
  }));
}
inline std::shared_ptr<const Tape> field_of_structure(const Model& model) {
  const auto structure = model.tape(Formula::structure), covector = model.tape(Formula::covector);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        auto right = evaluate(*covector, t, z);
        for (Recorded& x : right) x = -x;
        copy(solve(evaluate(*structure, t, z), right), out);
      }));
}

inline constexpr std::array structures{
    Derivation{
        Formula::structure, {Formula::one_form, none, none}, &has<Facet::birkhoffian>, &exterior_derivative},
    Derivation{Formula::structure, {none, none, none}, &canonical, &canonical_structure},
    Derivation{Formula::covector,
               {Formula::birkhoffian, Formula::one_form, none},
               &has<Facet::birkhoffian>,
               &covector_of_action},
    Derivation{Formula::poisson_tensor, {none, none, none}, &canonical, &canonical_tensor},
    Derivation{Formula::poisson_tensor,
               {Formula::structure, none, none},
               &has<Facet::structure>,
               &inverse_structure},
    Derivation{Formula::field,
               {Formula::structure, Formula::covector, none},
               &has<Facet::structure>,
               &field_of_structure},
};

}  // namespace pfaff::derivations
