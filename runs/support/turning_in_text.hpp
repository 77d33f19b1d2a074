// Vectors in a plane that texts state, followed along a method and along the motion itself.
//
// A component is an expression of the coordinates, the parameters and the time t, as in systems as text.
// Texts of several vectors have a | between them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/turning.hpp>

namespace pfaff {

/// The names of vectors, their components, and for each a list "NAME = EXPRESSION; ..." of what its
/// components have in common, or nothing.
struct VectorTexts {
  std::string names, x, y, definitions;
  /// Why they state no vectors, as a predicate; empty where each has a name and two components.
  [[nodiscard]] std::string objection() const;
};

/// How a vector turns in the motion, and how much faster with the method.
struct TurnedVector {
  std::string name;
  TurningRate of_solution, error;
};

class VectorsInText {
 public:
  /// TextError where an expression is none, or has names that the model does not know; InputError where a
  /// definition is none.
  VectorsInText(const VectorTexts& texts, const Model& model);

  /// A look at the state of the method and that of the solution at time t, so much after the start.
  void look(double elapsed, double t, const std::vector<double>& of_method,
            const std::vector<double>& of_solution);
  /// What was seen. The rates are no numbers where the vector of the solution turns by more than a third of a
  /// turn between two looks, so that nobody knows how often it went round.
  [[nodiscard]] std::vector<TurnedVector> turned() const;

 private:
  struct Followed {
    std::string name;
    Replay<double> components;
    std::vector<TurningVector> of_method{}, of_solution{};
    TurningVector at(double t, const std::vector<double>& z);
  };
  std::vector<Followed> vectors_;
  std::vector<double> times_;  // elapsed
};

}  // namespace pfaff
