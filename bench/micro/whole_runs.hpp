// What benchmarks of whole runs have in common: each repetition is one run from the start, and beside its
// time stands the error that such a run reaches.
#pragma once

#include <benchmark/benchmark.h>

#include <string>

#include <pfaff/core/numbers/formatted.hpp>

namespace pfaff::micro {

inline std::string step_name(double h) { return formatted("%g", h); }

// Adds the benchmark of run(z), which goes from z to the end of the run.
template <class Start, class Run>
void add_run([[maybe_unused]] const std::string& name, const Start& start, const char* counter, double error,
             Run run) {
  [[maybe_unused]] const auto measured = [=](benchmark::State& state) mutable {
    for (auto _ : state) {
      Start z = start;
      benchmark::DoNotOptimize(z.data());
      run(z);
      benchmark::DoNotOptimize(z.data());
    }
    state.counters["ns_per_run"] =
        benchmark::Counter(1e-9 * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters[counter] = error;
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  benchmark::RegisterBenchmark(name.c_str(), measured);
#endif
}

}  // namespace pfaff::micro
