// A system whose formulas are polynomials, of its variables and of functions of single ones: the model that
// methods run on, and the same system as a text model.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/verify/random_systems/sparse_polynomial.hpp>

namespace pfaff {

/// What a variable of a formula may be put through: sin x, exp x, sqrt(1 + x^2) and 1/(1 + x^2).
enum class Function { sine, exponential, root, bell };
inline constexpr std::array all_functions{Function::sine, Function::exponential, Function::root,
                                          Function::bell};

/// A function of one variable of a formula.
struct AppliedFunction {
  Function function = Function::sine;
  std::size_t variable = 0;
};

struct PolynomialSystem {
  std::string name;   // kebab-case
  std::string title;  // one line
  std::size_t dimension = 0;
  bool canonical = false;       // the bracket is the canonical one on (q, p)
  std::optional<Real> damping;  // beside kinetic and potential energy
  /// The formulas, each result one polynomial in what the formula reads.
  std::map<Formula, std::vector<SparsePolynomial>> formulas;
  /// Functions of what a formula reads, which stand in its polynomials as variables behind those it reads.
  std::map<Formula, std::vector<AppliedFunction>> applied;
  /// What the results of chart_inverse are divided by, one for each; empty where there is nothing.
  std::vector<SparsePolynomial> chart_divisors;
  std::vector<Invariant> invariants;  // of Formula::invariants
  std::vector<Real> initial;          // on the constraints
};

/// letter1 ... lettern: the names of coordinates and constraints.
std::vector<std::string> numbered(const std::string& letter, std::size_t count);

/// The system recorded as a system of an author's is, without code compiled for doubles.
std::shared_ptr<const Model> model_of(const PolynomialSystem& system);

/// The system with small terms that depend on time added to each of its constraints of positions or of the
/// phase space, drawn by `seed`, and without what is kept only where constraints are at rest: invariants and
/// a reversal. Its constraints at time 0 are those it had.
PolynomialSystem with_moving_constraints(PolynomialSystem system, std::uint64_t seed);

/// The system as the TOML file of a text model (docs/text-models.md). `comment` is its opening comment, line
/// by line without "#"; its lines are not broken.
std::string text_model(const PolynomialSystem& system, const std::vector<std::string>& comment);

}  // namespace pfaff
