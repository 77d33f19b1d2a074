// Darboux charts and the fields in them. The chart of a structure K(t) is y = E^-1 z, z = E y, in which the
// structure is the constant K_c = E^T K E; the chart of canonical coordinates is the identity. The field in
// the chart follows from the chart's own energy, from the action form or from K zdot + D = 0.
#pragma once

#include <pfaff/core/facets/derivations/derivation.hpp>
#include <pfaff/core/linear/symplectic_basis.hpp>

namespace pfaff::derivations {

// Pulls the action form F.dz - B dt back through the chart's inverse z = zeta(y, t). There the structure is
// constant and canonical, so the field is J (grad_y B~ + d_t F~) with F~_i = F_j d zeta_j / d y_i and B~ = B
// - F.d_t zeta.
inline Tape pulled_back_field(const Tape& one_form, const Tape& birkhoffian, const Tape& inverse) {
  const int n = inverse.inputs;
  const auto size = static_cast<std::size_t>(n);
  const Tape form = record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto f = evaluate(one_form, t, z);
    copy(gradient(inverse, t, y, f), out);
  });
  const Tape function = record(n, 1, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto f = evaluate(one_form, t, z);
    const auto z_t = time_derivative(inverse, t, y);
    out[0] = evaluate(birkhoffian, t, z)[0];
    for (std::size_t k = 0; k < size; ++k) out[0] = out[0] - f[k] * z_t[k];
  });
  return record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    auto covector = gradient_of(function, t, y);
    const auto form_t = time_derivative(form, t, y);
    for (std::size_t k = 0; k < size; ++k) covector[k] = covector[k] + form_t[k];
    canonical_sharp(covector, out);
  });
}

// The field in the chart from K zdot + D = 0. With z = zeta(y, t) and K_c = zeta_y^T K zeta_y it is
// y' = -K_c^-1 zeta_y^T (D + K zeta_t). K_c is the canonical matrix, so that nothing has to be solved.
inline Tape pulled_back_equations(const Tape& structure, const Tape& covector, const Tape& inverse) {
  const int n = inverse.inputs;
  const auto size = static_cast<std::size_t>(n);
  return record(n, n, [&](const Recorded& t, Arguments y, Results out) {
    const auto z = evaluate(inverse, t, y);
    const auto z_t = time_derivative(inverse, t, y);
    const auto k = evaluate(structure, t, z);
    auto d = evaluate(covector, t, z);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) d[i] = d[i] + k[i * size + j] * z_t[j];
      d[i] = -d[i];
    }
    canonical_sharp(gradient(inverse, t, y, d), out);
  });
}

inline Tape linear_chart(const Tape& structure, const PivotPairs& pairs) {
  return record(structure.inputs, structure.inputs, [&](const Recorded& t, Arguments z, Results y) {
    const auto k = evaluate(structure, t, z);
    const auto basis = symplectic_basis<Recorded>(k, pairs);
    copy(symplectic_coordinates<Recorded>(k, basis, z), y);
  });
}
inline Tape linear_chart_inverse(const Tape& structure, const PivotPairs& pairs) {
  return record(structure.inputs, structure.inputs, [&](const Recorded& t, Arguments y, Results z) {
    const auto k = evaluate(structure, t, y);
    const auto basis = symplectic_basis<Recorded>(k, pairs);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t j = 0; j < y.size(); ++j) z[i] = z[i] + basis[i * y.size() + j] * y[j];
  });
}

inline bool linear(const Model& model) { return !model.chart_pivots().empty(); }
inline bool identical(const Model& model) {
  return has<Facet::darboux_chart>(model) && !model.given(Formula::chart) && !linear(model);
}
inline bool charted_energy(const Model& model) {
  return has<Facet::darboux_chart>(model) && model.given(Formula::chart_hamiltonian);
}
inline bool charted_action(const Model& model) {
  return has<Facet::darboux_chart>(model) && has<Facet::birkhoffian>(model);
}
inline bool has_chart_field(const Model& model) { return gives<Formula::chart_field>(model); }

inline std::shared_ptr<const Tape> chart_of_structure(const Model& model) {
  return shared(linear_chart(*model.tape(Formula::structure), model.chart_pivots()));
}
inline std::shared_ptr<const Tape> inverse_of_structure(const Model& model) {
  return shared(linear_chart_inverse(*model.tape(Formula::structure), model.chart_pivots()));
}
inline std::shared_ptr<const Tape> identity(const Model& model) {
  return shared(record(model.dimension(), model.dimension(), [](const Recorded&, Arguments z, Results out) {
    for (std::size_t k = 0; k < z.size(); ++k) out[k] = z[k];
  }));
}
inline std::shared_ptr<const Tape> field_itself(const Model& model) { return model.tape(Formula::field); }
inline std::shared_ptr<const Tape> field_of_chart_energy(const Model& model) {
  const auto energy = model.tape(Formula::chart_hamiltonian);
  return shared(
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments y, Results out) {
        canonical_sharp(gradient_of(*energy, t, y), out);
      }));
}
inline std::shared_ptr<const Tape> pulled_back_action(const Model& model) {
  return shared(pulled_back_field(*model.tape(Formula::one_form), *model.tape(Formula::birkhoffian),
                                  *model.tape(Formula::chart_inverse)));
}
inline std::shared_ptr<const Tape> pulled_back_structure(const Model& model) {
  return shared(pulled_back_equations(*model.tape(Formula::structure), *model.tape(Formula::covector),
                                      *model.tape(Formula::chart_inverse)));
}

inline constexpr std::array charts{
    Derivation{Formula::chart, {Formula::structure, none, none}, &linear, &chart_of_structure},
    Derivation{Formula::chart, {none, none, none}, &identical, &identity},
    Derivation{Formula::chart_inverse, {Formula::structure, none, none}, &linear, &inverse_of_structure},
    Derivation{Formula::chart_inverse, {none, none, none}, &identical, &identity},
    Derivation{Formula::chart_field, {Formula::field, none, none}, &identical, &field_itself},
    Derivation{Formula::chart_field,
               {Formula::chart_hamiltonian, none, none},
               &charted_energy,
               &field_of_chart_energy},
    Derivation{Formula::chart_field,
               {Formula::one_form, Formula::birkhoffian, Formula::chart_inverse},
               &charted_action,
               &pulled_back_action},
    Derivation{Formula::chart_field,
               {Formula::structure, Formula::covector, Formula::chart_inverse},
               &has<Facet::darboux_chart>,
               &pulled_back_structure},
    Derivation{Formula::chart_field_jacobian,
               {Formula::chart_field, none, none},
               &has_chart_field,
               &jacobian_of<Formula::chart_field>},
};

}  // namespace pfaff::derivations
