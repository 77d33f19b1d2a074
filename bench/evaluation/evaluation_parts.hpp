// The parts that an evaluation is made of, one for each kind of system, and the helpers they share.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/bench/evaluation/evaluation.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::evaluation_parts {

/// Up to so many constraints, what costs the cube of their number once is evaluated.
constexpr std::size_t most_dense = 200;

using nlohmann::json;

inline json number(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }
inline json number(const Quad& x) { return isfinite(x) ? json(to_string(x)) : json(nullptr); }
template <class T>
json list(std::span<const T> values) {
  json j = json::array();
  for (const T& x : values) j.push_back(number(x));
  return j;
}
template <class T>
json list(const std::vector<T>& values) {
  return list(std::span<const T>(values));
}
template <class T>
json rows(const Matrix<T>& matrix) {
  json j = json::array();
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    j.push_back(json::array());
    for (std::size_t k = 0; k < matrix.columns(); ++k) j.back().push_back(number(matrix(i, k)));
  }
  return j;
}
template <class T>
std::vector<T> numbers(const std::vector<Real>& values) {
  std::vector<T> result;
  for (const Real& x : values) result.push_back(T(x));
  return result;
}

/// A model at a state, and what its evaluation has shown so far.
template <class T>
struct Point {
  std::shared_ptr<const Model> model;
  T t;
  std::vector<T> z;
  bool finite = true;   // true while every number passed to seen() is finite
  bool regular = true;  // the equations can be solved for the rate
  std::string reason;   // why they cannot, in one line

  [[nodiscard]] std::vector<T> values(const std::shared_ptr<const Tape>& tape) const {
    std::vector<T> out(tape->outputs.size());
    Replay<T> replay(tape);
    replay(t, z.data(), out.data());
    return out;
  }
  /// The formula as runs evaluate it, compiled or replayed.
  [[nodiscard]] std::vector<T> values(const std::shared_ptr<const Model>& of, Formula formula) const {
    std::vector<T> out(z.size());
    const Evaluator<T> evaluator = make_evaluator<T>(of, formula);
    evaluator.call(evaluator.context, t, z.data(), out.data());
    return out;
  }
  const std::vector<T>& seen(const std::vector<T>& x) {
    for (const T& value : x) finite = finite && isfinite(value);
    return x;
  }
};

/// Adds the keys of a system K zdot + D = 0: K, F_t, D, F, B, regular, condition, kernel, class,
/// self_adjoint, centre.
template <class T>
void add_birkhoffian(Point<T>& at, std::optional<std::vector<Real>> centre, json& j);

/// Adds the keys of constraints that do not need the rate: constraint_names, constraints, hidden_constraints,
/// structure, S, A, S_D, W, rank, condition, first_class, redundant.
template <class T>
void add_constraints(Point<T>& at, json& j);
/// Adds the key of constraints of velocities: nonholonomic.
template <class T>
void add_nonholonomic_bracket(Point<T>& at, json& j);
/// Adds the keys of constraints that need the rate of the state: multipliers, constraint_forces.
template <class T>
void add_constrained_motion(Point<T>& at, const std::vector<T>& rate, json& j);
/// Adds the keys of constraints that Dirac's bracket can be made of: dirac_bracket, solvers.
template <class T>
void add_dirac_bracket(Point<T>& at, json& j);

}  // namespace pfaff::evaluation_parts
