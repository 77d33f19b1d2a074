// A system whose formulas are polynomials: the model that methods run on, and the same system as the source
// of a plug-in.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/random_systems/sparse_polynomial.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

struct PolynomialSystem {
  std::string name;   // kebab-case
  std::string title;  // one line
  std::size_t dimension = 0;
  bool canonical = false;       // the bracket is the canonical one on (q, p)
  std::optional<Real> damping;  // beside kinetic and potential energy
  /// The formulas, each result one polynomial in what the formula reads.
  std::map<Formula, std::vector<SparsePolynomial>> formulas;
  /// What the results of chart_inverse are divided by, one for each; empty where there is nothing.
  std::vector<SparsePolynomial> chart_divisors;
  std::vector<Invariant> invariants;  // of Formula::invariants
  std::vector<Real> initial;          // on the constraints
};

/// The system recorded as a system of an author's is, without code compiled for doubles.
std::shared_ptr<const Model> model_of(const PolynomialSystem& system);

/// The system as a C++ source that compiles into a plug-in. `comment` is its opening comment, line by
/// line without "//"; its lines are not broken.
std::string plugin_source(const PolynomialSystem& system, const std::vector<std::string>& comment);

}  // namespace pfaff
