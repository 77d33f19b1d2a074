// The Birkhoffian form of a system at one point: K, D, F, B, whether K is regular, and the class of the
// system.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>
#include <pfaff/brackets/birkhoffian/self_adjointness.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// The classes of su-qin, definition 2.1: autonomous where neither F nor B depends on time, semi-autonomous
/// where only B does, nonautonomous where F does.
enum class BirkhoffianClass { autonomous, semi_autonomous, nonautonomous };

std::string_view to_string(BirkhoffianClass kind);

/// The class of the model's action form, read from the formulas with the parameters' values. It belongs to F
/// and B and not to the equations: a gauge that brings time into F makes the same equations nonautonomous.
/// Where the model has no F and B it is read from K and D, because the F and B that inverse_problem makes of
/// them depend on time as they do. Expects the facet `structure`.
BirkhoffianClass birkhoffian_class(const Model& model);

/// Degeneracy of a square matrix.
template <class T>
struct Degeneracy {
  bool regular = false;
  T condition{};                       // largest over smallest singular value; infinite for a singular matrix
  std::vector<std::vector<T>> kernel;  // a basis in echelon form, the largest component of each 1
};

/// Regular when no singular value is below n roundings of the largest. Before that, rows and columns are
/// scaled by the same factors to largest entries of 1, so that the units of the coordinates do not matter. A
/// matrix that is not finite is not regular, has no kernel and a condition that is not a number.
template <class T>
Degeneracy<T> degeneracy(const Matrix<T>& k);

/// A system in Birkhoff's form at one point, K zdot + D = 0 with K = dF, D = -(grad B + F_t) (su-qin (4),
/// (5)).
template <class T>
struct BirkhoffianForm {
  Matrix<T> structure;              // K
  std::vector<T> covector;          // D
  std::vector<T> one_form;          // F
  std::vector<T> one_form_rate;     // F_t
  T birkhoffian{};                  // B
  Degeneracy<T> degeneracy;         // of K
  SelfAdjointness<T> self_adjoint;  // of K and D
};

/// Measures it at (t, z). F and B are the author's, or, where `centre` is given or there are none, those of
/// inverse_problem about `centre`; std::invalid_argument when it is needed and missing. Expects the facet
/// `structure`. Tapes are derived anew at every call.
template <class T>
BirkhoffianForm<T> birkhoffian_form(const Model& model, const std::optional<std::vector<Real>>& centre,
                                    const T& t, In<T> z);

}  // namespace pfaff
