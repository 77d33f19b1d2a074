// A hanging chain of rods for the benchmarks: its masses and state, buffers for right-hand sides, and the
// function that adds a benchmark.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pfaff::micro {

inline constexpr std::array<int, 4> chain_sizes{16, 64, 256, 1024};

/// Masses, rods of length 1, and a state of a chain that hangs from the origin in D dimensions. The state
/// fulfils the constraints, is bent at every bead, and turns every rod.
template <int D>
struct Rig {
  explicit Rig(int count)
      : size(static_cast<std::size_t>(count)), inverse_masses(size), q(D * size), p(D * size) {
    std::array<double, D> place{}, velocity{};
    for (std::size_t k = 0; k < size; ++k) {
      const auto x = static_cast<double>(k);
      const double mass = 1 + 0.5 * std::sin(x), angle = 0.4 * std::sin(1.7 * x),
                   turn = 0.5 * std::cos(0.9 * x);
      const double tilt = D == 3 ? 0.3 * std::cos(1.1 * x) : 0,
                   turn_of_tilt = D == 3 ? 0.2 * std::sin(2.3 * x) : 0;
      inverse_masses[k] = 1 / mass;
      const std::array<double, 3> rod{std::cos(angle) * std::cos(tilt), std::sin(angle) * std::cos(tilt),
                                      std::sin(tilt)};
      const std::array<double, 3> rate{
          -turn * std::sin(angle) * std::cos(tilt) - turn_of_tilt * std::cos(angle) * std::sin(tilt),
          turn * std::cos(angle) * std::cos(tilt) - turn_of_tilt * std::sin(angle) * std::sin(tilt),
          turn_of_tilt * std::cos(tilt)};
      for (std::size_t d = 0; d < D; ++d) {
        place[d] += rod[d];
        velocity[d] += rate[d];
        q[k * D + d] = place[d];
        p[k * D + d] = mass * velocity[d];
      }
    }
  }
  std::size_t size;
  std::vector<double> inverse_masses, q, p;
  double gravity = 9.81;  // against the last axis
};

/// The state of one benchmark and the buffers it writes to.
template <int D>
struct RodState {
  explicit RodState(const Rig<D>& rig) : q(rig.q), p(rig.p), rate_q(q.size()), rate_p(p.size()) {}
  std::vector<double> q, p, rate_q, rate_p;
};

/// Adds the benchmark of run(). One call of it evaluates a right-hand side, or takes a step, `count` times
/// one rod; times are divided by `count`.
template <class Run>
void add_rods(const std::string& shape, const std::string& what, const std::string& path, double count,
              Run run) {
  const std::string name = shape + "/" + what + "/" + path;
  [[maybe_unused]] const auto measured = [=](benchmark::State& state) mutable {
    for (auto _ : state) run();
    state.counters["ns_per_rod"] =
        benchmark::Counter(1e-9 * count * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  benchmark::RegisterBenchmark(name.c_str(), measured);
#endif
}

}  // namespace pfaff::micro
