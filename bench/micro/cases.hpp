// What the benchmarks of steps have in common: each measures chunks of 1000 steps of size 0.01 from the same
// start, in nanoseconds per step.
//
// Names are system/method/path. The paths are by-hand (a loop of doubles), static (concrete system and method
// types), registered (through the registries), static and registered with forces derived from the energies
// instead of written by the author, and odeint.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <string>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/systems/canonical/harmonic_oscillator.hpp>
#include <pfaff/systems/canonical/kepler.hpp>
#include <pfaff/systems/canonical/pendulum.hpp>

namespace pfaff::micro {

inline constexpr std::int64_t chunk = 1000;
inline constexpr double step_size = 0.01;

/// The name that a system is registered with, and the state its runs start from.
template <class S>
struct Case;
template <>
struct Case<HarmonicOscillator> {
  static constexpr const char* name = "harmonic-oscillator";
  static constexpr std::array<double, 2> start{1, 0};
};
template <>
struct Case<Pendulum> {
  static constexpr const char* name = "pendulum";
  static constexpr std::array<double, 2> start{1, 0.5};
};
template <>
struct Case<Kepler> {
  static constexpr const char* name = "kepler";
  static constexpr std::array<double, 4> start{0.4, 0, 0, 2};
};

/// Systems that are measured on the registered path alone need no type of their own but this tag.
struct HenonHeiles {};
template <>
struct Case<HenonHeiles> {
  static constexpr const char* name = "henon-heiles";
  static constexpr std::array<double, 4> start{0, 0.1, 0.5, 0};
};
struct DampedPendulum {};
template <>
struct Case<DampedPendulum> {
  static constexpr const char* name = "damped-pendulum";
  static constexpr std::array<double, 2> start{1, 0.5};
};
struct LotkaVolterra {};
template <>
struct Case<LotkaVolterra> {
  static constexpr const char* name = "lotka-volterra";
  static constexpr std::array<double, 2> start{1.5, 1};
};

/// A chain of N damped pendula, all of them moving.
template <int N>
struct DampedChain {};
template <int N>
struct Case<DampedChain<N>> {
  static constexpr const char* name = N == 8    ? "damped-pendula-8"
                                      : N == 16 ? "damped-pendula-16"
                                      : N == 32 ? "damped-pendula-32"
                                      : N == 64 ? "damped-pendula-64"
                                                : "damped-pendula-128";
  static constexpr auto start = [] {
    std::array<double, 2 * static_cast<std::size_t>(N)> z{};
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = 0.5 + 0.3 * static_cast<double>(k % 3);
    return z;
  }();
};

/// A system that offers its energies only, so that all other formulas are derived from them; it shows what
/// the derivation costs.
template <class S>
struct EnergiesOnly {
  static constexpr int dimension = S::dimension;
  S system;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return system.kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return system.potential(t, q);
  }
};

/// Adds the benchmark of run(z, h), which takes a chunk of steps of size h from z in place. Both arguments
/// are hidden from the compiler, so that it cannot compute anything beforehand.
template <class S, class Run>
void add(const std::string& method, const std::string& path, Run run) {
  const std::string name = std::string(Case<S>::name) + "/" + method + "/" + path;
  [[maybe_unused]] const auto measured = [run](benchmark::State& state) mutable {
    const volatile double unknown = step_size;
    for (auto _ : state) {
      auto z = Case<S>::start;
      // The address is passed, because DoNotOptimize(z) itself spoils the value with GCC in Benchmark 1.7.
      benchmark::DoNotOptimize(z.data());
      run(z, unknown);
      benchmark::DoNotOptimize(z.data());
    }
    const auto steps = static_cast<double>(state.iterations() * chunk);
    state.SetItemsProcessed(state.iterations() * chunk);
    state.counters["ns_per_step"] =
        benchmark::Counter(1e-9 * steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  benchmark::RegisterBenchmark(name.c_str(), measured);
#endif
}

}  // namespace pfaff::micro
