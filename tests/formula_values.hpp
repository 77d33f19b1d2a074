// What most tests ask of a model: the model of a system by its name, where it starts, what its formulas give,
// and how far two such lists of numbers are apart.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::testing {

using Numbers = std::vector<Quad>;

/// The model of the registered system of that name.
inline std::shared_ptr<const Model> model_named(const std::string& name, const Assignments& set = {}) {
  return systems().get(name, "system").make(set);
}

template <class T = Quad>
std::vector<T> initial_state(const Model& model) {
  std::vector<T> z;
  for (const Real& x : model.initial()) z.push_back(T(x));
  return z;
}

inline Quad ratio(std::int64_t numerator, std::int64_t denominator = 1) {
  return Real::fraction(numerator, denominator).quad();
}

inline std::shared_ptr<const Tape> shared(Tape tape) { return std::make_shared<const Tape>(std::move(tape)); }

/// The outputs of a tape at time t and inputs z.
template <class T>
std::vector<T> values(const std::shared_ptr<const Tape>& tape, const T& t, const std::vector<T>& z) {
  std::vector<T> out(tape->outputs.size());
  Replay<T> replay(tape);
  replay(t, z.data(), out.data());
  return out;
}
/// The same for a tape that its caller keeps.
template <class T>
std::vector<T> values(const Tape& tape, const T& t, const std::vector<T>& z) {
  return values(std::shared_ptr<const Tape>(std::shared_ptr<const Tape>(), &tape), t, z);
}
/// The values of a formula, from its tape, which must read as many numbers as z has.
template <class T>
std::vector<T> values(const Model& model, Formula formula, const T& t, const std::vector<T>& z) {
  const auto tape = model.tape(formula);
  EXPECT_EQ(static_cast<std::size_t>(tape->inputs), z.size()) << to_string(formula);
  return values(tape, t, z);
}

/// The `count` values of a formula as methods get them: compiled where the system is.
template <class T>
std::vector<T> evaluated(const std::shared_ptr<const Model>& model, Formula formula, const std::vector<T>& z,
                         std::size_t count, const T& t = T(0)) {
  const auto evaluator = make_evaluator<T>(model, formula);
  std::vector<T> out(count);
  evaluator.call(evaluator.context, t, z.data(), out.data());
  return out;
}

/// The largest difference; infinite between lists of different lengths and where something is not finite.
template <class A = Quad, class B = A>
double distance(const std::vector<A>& a, const std::vector<B>& b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Quad difference = Quad(a[k]) - Quad(b[k]);
    if (!isfinite(difference)) return INFINITY;
    worst = std::max(worst, static_cast<double>(abs(difference)));
  }
  return worst;
}
/// The same, relative to the largest of b and at least to 1.
template <class A = Quad, class B = A>
double relative_distance(const std::vector<A>& a, const std::vector<B>& b) {
  Quad size(1);
  for (const B& x : b) size = std::max(size, Quad(abs(x)));
  return distance(a, b) / static_cast<double>(size);
}

}  // namespace pfaff::testing
