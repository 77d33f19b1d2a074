// Residuals of identities, recorded as tapes, at random points with a fixed seed.
#pragma once

#include <cmath>
#include <random>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;
inline constexpr int points = 20;

inline Check named(const std::string& plugin, const std::string& claim, const std::string& system,
                   const char* precision, double measured, double tolerance) {
  Check check;
  check.plugin = plugin;
  check.claim = claim;
  check.scope = "every point";
  check.system = system;
  check.precision = precision;
  check.measured = measured;
  check.tolerance = tolerance;
  check.result = measured <= tolerance ? CheckResult::pass : CheckResult::fail;
  return check;
}

// Largest value of a tape's outputs at random states within 1/20 of the model's generic state.
template <class T>
T largest(const std::shared_ptr<const Tape>& tape, const std::vector<Real>& centre) {
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  Replay<T> replay(tape);
  std::vector<T> z(centre.size()), out(tape->outputs.size());
  T worst(0);
  for (int k = 0; k < points; ++k) {
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = T(centre[i]) + T(offset(random));
    replay(T(1 + offset(random)), z.data(), out.data());
    for (const T& x : out) worst = isnan(x) ? x : std::max(worst, abs(x));
  }
  return worst;
}

// A tape made of recorded expressions of (t, z).
template <class F>
std::shared_ptr<const Tape> expression(int inputs, int outputs, F&& f) {
  return std::make_shared<const Tape>(record(inputs, outputs, std::forward<F>(f)));
}

inline void both(std::vector<Check>& checks, const std::string& plugin, const std::string& claim,
                 const std::string& system, const std::shared_ptr<const Tape>& residual,
                 const std::vector<Real>& centre) {
  // A handful of operations on numbers of order one to ten, their derivatives included.
  checks.push_back(named(plugin, claim, system, "double", largest<double>(residual, centre), 1e-13));
  checks.push_back(
      named(plugin, claim, system, "quad", static_cast<double>(largest<Quad>(residual, centre)), 1e-31));
}

/// Y_z^T K_c Y_z - K with K_c = [[0, -I], [I, 0]].
std::shared_ptr<const Tape> darboux_residual(const Tape& chart, const Tape& structure);

/// Self-adjointness of a system K zdot + D = 0 (su-qin (8)), condition by condition.
std::vector<Check> check_self_adjointness(const std::string& plugin, const Model& model);

}  // namespace pfaff
