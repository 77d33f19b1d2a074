// Measures one application of a Dirac bracket to a covector, sharp_D, by each solver, in nanoseconds, for K
// constraints on n = 2 K + 4 coordinates; the base brackets and the gradients are given. dirac_sharp.py fits
// the exponents of K.
//
// Names are dirac-KIND-K/solver. The kinds are `dense`, a skew bracket with every {phi_i, phi_j} different
// from zero; `chain`, constraints phi_k, phi~_k of which only neighbours have a bracket, so that S is
// tridiagonal; and `path`, a symmetric bracket with a tridiagonal W.
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include <pfaff/brackets/dirac/dirac.hpp>

namespace {
using namespace pfaff;

struct Instance {
  std::size_t n, count;
  Symmetry symmetry;
  std::vector<double> tensor, gradients, covector, sharps, gram, vector, brackets;
  std::vector<std::size_t> support_begin, support;

  Instance(std::size_t constraints, Symmetry of)
      : n(2 * constraints + 4),
        count(constraints),
        symmetry(of),
        tensor(n * n),
        gradients(count * n),
        covector(n, 0.5),
        sharps(count * n),
        gram(count * count),
        vector(n),
        brackets(count) {}
  void complete() {
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) {
        if (tensor[a * n + b] == 0) continue;
        vector[a] += tensor[a * n + b] * covector[b];
        for (std::size_t i = 0; i < count; ++i) sharps[i * n + a] += tensor[a * n + b] * gradients[i * n + b];
      }
    for (std::size_t i = 0; i < count; ++i) {
      brackets[i] = detail::dot(n, gradients.data() + i * n, vector.data());
      for (std::size_t j = 0; j < count; ++j)
        gram[i * count + j] = detail::dot(n, gradients.data() + i * n, sharps.data() + j * n);
    }
  }
  void find_support() {
    for (std::size_t i = 0; i < count; ++i) {
      support_begin.push_back(support.size());
      for (std::size_t a = 0; a < n; ++a)
        if (sharps[i * n + a] != 0) support.push_back(a);
    }
    support_begin.push_back(support.size());
  }
  [[nodiscard]] DiracData<double> data() const {
    return {n,        count,  symmetry, gradients, sharps,        gram,
            covector, vector, brackets, tensor,    support_begin, support};
  }
};

// A dense instance in which the bracket of each pair (phi_k, phi~_k) is larger than every other, so that
// these are pivots and no elimination breaks down.
Instance dense(std::size_t count) {
  Instance d(count, Symmetry::skew);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.1, 0.1);
  for (std::size_t a = 0; a < d.n; a += 2) {
    d.tensor[a * d.n + a + 1] = 1;
    d.tensor[(a + 1) * d.n + a] = -1;
  }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < d.n; ++a)
      d.gradients[i * d.n + a] = a == i ? 1 : number(random) / static_cast<double>(count);
  d.complete();
  return d;
}
Instance chain(std::size_t count) {
  Instance d(count, Symmetry::skew);
  const std::size_t half = d.n / 2;
  for (std::size_t k = 0; k < half; ++k) {
    d.tensor[k * d.n + half + k] = 1;
    d.tensor[(half + k) * d.n + k] = -1;
  }
  for (std::size_t k = 0; k < count / 2; ++k) {
    d.gradients[(2 * k) * d.n + k] = d.gradients[(2 * k + 1) * d.n + half + k] = 1;
    d.gradients[(2 * k) * d.n + k + 1] = d.gradients[(2 * k + 1) * d.n + half + k + 1] = -0.5;
    d.gradients[(2 * k + 1) * d.n + k] = 0.25;
  }
  d.complete();
  d.find_support();
  return d;
}
Instance path(std::size_t count) {
  Instance d(count, Symmetry::symmetric);
  for (std::size_t a = 0; a < d.n; ++a) d.tensor[a * d.n + a] = 1;
  for (std::size_t i = 0; i < count; ++i) {
    d.gradients[i * d.n + i] = 1;
    d.gradients[i * d.n + i + 1] = -0.5;
  }
  d.complete();
  d.find_support();
  return d;
}
std::shared_ptr<const SymmetricPattern> neighbours(std::size_t rows) {
  std::vector<std::pair<std::size_t, std::size_t>> couplings;
  for (std::size_t k = 0; k + 1 < rows; ++k) couplings.emplace_back(k, k + 1);
  return std::make_shared<const SymmetricPattern>(rows, std::move(couplings));
}

template <class Solver>
void add([[maybe_unused]] const std::string& kind, const Instance& instance, const Solver& solver) {
  [[maybe_unused]] const auto run = [instance, solver](benchmark::State& state) {
    typename Solver::template Work<double> work(solver, instance.n, instance.count);
    std::vector<double> result(instance.n);
    const DiracData<double> data = instance.data();
    for (auto _ : state) {
      benchmark::DoNotOptimize(solver(data, Out<double>(result), work));
      benchmark::ClobberMemory();
    }
    state.counters["ns_per_sharp"] =
        benchmark::Counter(1e-9 * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  const std::string name = "dirac-" + kind + "-" + std::to_string(instance.count) + "/" + Solver::name;
  benchmark::RegisterBenchmark(name.c_str(), run);
#endif
}

const bool registered = [] {
  for (const std::size_t count : {2, 4, 8, 16, 32, 64, 128, 256}) {
    const Instance full = dense(count), linked = chain(count), line = path(count);
    add("dense", full, DenseDirac{});
    add("dense", full, RecursiveVectorsDirac{});
    add("dense", full, RecursiveTensorDirac{});
    if (count <= 8) add("dense", full, RecursiveLiteralDirac{});
    if (count <= 32) add("dense", full, BorderedDirac{});
    if (count <= 32) add("dense", full, PfaffianDirac{});
    add("dense", full, HolonomicDirac{});
    add("chain", linked, DenseDirac{});
    add("chain", linked, HolonomicDirac{neighbours(count / 2)});
    add("path", line, DenseDirac{});
    add("path", line, StructuredDirac{neighbours(count)});
  }
  return true;
}();
}  // namespace
