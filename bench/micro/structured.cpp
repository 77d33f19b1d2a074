// Measures factoring a matrix of each structure and solving with it, in nanoseconds per row: by the library,
// by Eigen's sparse L D L^T with the pattern analysed beforehand, and, for tridiagonal matrices, by the loops
// that someone would write by hand.
//
// Names are structure-rows/what/path. The second part is factor-and-solve (of one right-hand side, copying of
// the entries included), solve, or solve-two (two right-hand sides at once). The paths are library, shuffled
// (the library with rows in random order), quad (the library in quad), one-end and both-ends (by hand), and
// eigen.
#include <benchmark/benchmark.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <pfaff/core/linear/structured_ldlt.hpp>

namespace {
using namespace pfaff;
using Couplings = std::vector<SymmetricPattern::Coupling>;

/// A positive definite matrix and a right-hand side.
struct Problem {
  std::shared_ptr<const SymmetricPattern> pattern;
  std::vector<double> diagonal, couplings, right;

  Problem(std::size_t rows, const Couplings& coupled)
      : pattern(std::make_shared<const SymmetricPattern>(rows, coupled)) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto fill = [&](std::vector<double>& x, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) x.push_back(number(random));
    };
    fill(diagonal, rows);
    fill(couplings, pattern->couplings().size());
    fill(right, rows);
    for (double& d : diagonal) d += 2;
    for (std::size_t c = 0; c < couplings.size(); ++c)
      for (const std::size_t row : {pattern->couplings()[c].first, pattern->couplings()[c].second})
        diagonal[row] += std::abs(couplings[c]);
  }
};

template <class Run>
void add([[maybe_unused]] const std::string& name, std::size_t rows, Run run) {
  [[maybe_unused]] const auto measured = [run, rows](benchmark::State& state) mutable {
    for (auto _ : state) {
      run();
      benchmark::ClobberMemory();
    }
    state.counters["ns_per_row"] =
        benchmark::Counter(1e-9 * static_cast<double>(state.iterations()) * static_cast<double>(rows),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  };
#ifndef __clang_analyzer__  // which sees a leak inside Google Benchmark
  benchmark::RegisterBenchmark(name.c_str(), measured);
#endif
}

template <class T>
void add_library(const std::string& structure, const Problem& problem, const std::string& path) {
  const std::size_t rows = problem.pattern->rows();
  const auto numbers = [](const std::vector<double>& x) { return std::vector<T>(x.begin(), x.end()); };
  StructuredLDLT<T> factors(problem.pattern);
  const auto fill = [d = numbers(problem.diagonal), c = numbers(problem.couplings)](StructuredLDLT<T>& f) {
    std::copy(d.begin(), d.end(), f.diagonal());
    std::copy(c.begin(), c.end(), f.couplings());
  };
  fill(factors);
  factors.factor();
  std::vector<T> right = numbers(problem.right), x(rows), y(rows);
  add(structure + "/factor-and-solve/" + path, rows, [=]() mutable {
    fill(factors);
    benchmark::DoNotOptimize(factors.factor_and_solve(right.data(), x.data()));
    benchmark::DoNotOptimize(x.data());
  });
  add(structure + "/solve/" + path, rows, [=]() mutable {
    factors.solve(right.data(), x.data());
    benchmark::DoNotOptimize(x.data());
  });
  add(structure + "/solve-two/" + path, rows, [=]() mutable {
    factors.solve(right.data(), x.data(), right.data(), y.data());
    benchmark::DoNotOptimize(x.data());
    benchmark::DoNotOptimize(y.data());
  });
}

void add_eigen(const std::string& structure, const Problem& problem) {
  const auto rows = static_cast<int>(problem.pattern->rows());
  std::vector<Eigen::Triplet<double>> triplets;
  for (int i = 0; i < rows; ++i) triplets.emplace_back(i, i, problem.diagonal[static_cast<std::size_t>(i)]);
  for (std::size_t c = 0; c < problem.couplings.size(); ++c)
    triplets.emplace_back(static_cast<int>(problem.pattern->couplings()[c].second),
                          static_cast<int>(problem.pattern->couplings()[c].first), problem.couplings[c]);
  Eigen::SparseMatrix<double> a(rows, rows);
  a.setFromTriplets(triplets.begin(), triplets.end());
  const auto factors = std::make_shared<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>>(a);
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(problem.right.data(), rows);
  Eigen::VectorXd x(rows);
  add(structure + "/factor-and-solve/eigen", problem.pattern->rows(), [=]() mutable {
    factors->factorize(a);
    x = factors->solve(right);
    benchmark::DoNotOptimize(x.data());
  });
  add(structure + "/solve/eigen", problem.pattern->rows(), [=]() mutable {
    x = factors->solve(right);
    benchmark::DoNotOptimize(x.data());
  });
}

/// The loop of the textbook, which eliminates from one end and divides by every pivot in turn.
void one_end(std::size_t rows, const double* c, const double* b, const double* right, double* x, double* l) {
  double pivot = c[0], y = right[0];
  for (std::size_t k = 0; k + 1 < rows; ++k) {
    const double r = 1 / pivot;
    l[k] = b[k] * r;
    x[k] = y * r;
    y = right[k + 1] - b[k] * x[k];
    pivot = c[k + 1] - b[k] * b[k] * r;
  }
  x[rows - 1] = y = y / pivot;
  for (std::size_t k = rows - 1; k-- > 0;) x[k] = y = x[k] - l[k] * y;
}

/// The same elimination from both ends at once.
void both_ends(std::size_t rows, const double* c, const double* b, const double* right, double* x,
               double* l) {
  const std::size_t middle = rows / 2;
  std::size_t i = 0, j = rows - 1;
  double pivot = c[i], y = right[i], other_pivot = c[j], other_y = right[j];
  const auto from_left = [&] {
    const double r = 1 / pivot;
    l[i] = b[i] * r;
    x[i] = y * r;
    y = right[i + 1] - b[i] * x[i];
    pivot = c[i + 1] - b[i] * b[i] * r;
    ++i;
  };
  while (j > middle + 1) {
    from_left();
    const double r = 1 / other_pivot, coupling = b[j - 1];
    l[j - 1] = coupling * r;
    x[j] = other_y * r;
    other_y = right[j - 1] - coupling * x[j];
    other_pivot = c[j - 1] - coupling * coupling * r;
    --j;
  }
  while (i < middle) from_left();
  if (j > middle) {
    const double r = 1 / other_pivot;
    l[middle] = b[middle] * r;
    x[j] = other_y * r;
    y -= b[middle] * x[j];
    pivot -= b[middle] * b[middle] * r;
  }
  x[middle] = y / pivot;
  double left = x[middle], other = left;
  for (j = middle; i > 0 && j + 1 < rows; --i, ++j) {
    x[i - 1] = left = x[i - 1] - l[i - 1] * left;
    x[j + 1] = other = x[j + 1] - l[j] * other;
  }
  for (; i > 0; --i) x[i - 1] = left = x[i - 1] - l[i - 1] * left;
}

template <class Loop>
void add_by_hand(const std::string& structure, const Problem& problem, const std::string& path, Loop loop) {
  const std::size_t rows = problem.pattern->rows();
  std::vector<double> c = problem.diagonal, b = problem.couplings, right = problem.right, x(rows), l(rows);
  add(structure + "/factor-and-solve/" + path, rows, [=]() mutable {
    loop(rows, c.data(), b.data(), right.data(), x.data(), l.data());
    benchmark::DoNotOptimize(x.data());
  });
}

Couplings chain(std::size_t rows) {
  Couplings result;
  for (std::size_t k = 0; k + 1 < rows; ++k) result.emplace_back(k, k + 1);
  return result;
}
Couplings shuffled(std::size_t rows, Couplings couplings) {
  std::vector<std::size_t> name(rows);
  std::iota(name.begin(), name.end(), std::size_t(0));
  std::shuffle(name.begin(), name.end(), std::mt19937_64(8));
  for (auto& [i, j] : couplings) i = name[i], j = name[j];
  return couplings;
}
/// The couplings between rods, each given as a pair of points: two rods are coupled where they share a point.
Couplings of_rods(const Couplings& rods) {
  Couplings result;
  for (std::size_t i = 0; i < rods.size(); ++i)
    for (std::size_t j = i + 1; j < rods.size(); ++j)
      if (rods[i].first == rods[j].first || rods[i].first == rods[j].second ||
          rods[i].second == rods[j].first || rods[i].second == rods[j].second)
        result.emplace_back(i, j);
  return result;
}
/// A chain of rods with one more rod hanging from every other point.
Couplings ribs(std::size_t rods) {
  Couplings points;
  for (std::size_t spine = 0, next = 1; points.size() < rods;) {
    const std::size_t from = spine;
    spine = next;
    points.emplace_back(from, next++);
    if (points.size() % 3 == 2) points.emplace_back(spine, next++);
  }
  points.resize(rods);
  return of_rods(points);
}
Couplings lattice(std::size_t width) {
  Couplings result;
  for (std::size_t y = 0; y < width; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      if (x + 1 < width) result.emplace_back(y * width + x, y * width + x + 1);
      if (y + 1 < width) result.emplace_back(y * width + x, (y + 1) * width + x);
    }
  return result;
}
Couplings complete(std::size_t rows) {
  Couplings result;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = i + 1; j < rows; ++j) result.emplace_back(i, j);
  return result;
}

void add_structure(const std::string& name, std::size_t rows, const Couplings& couplings) {
  const Problem problem(rows, couplings);
  add_library<double>(name, problem, "library");
  add_library<double>(name, Problem(rows, shuffled(rows, couplings)), "shuffled");
  add_library<Quad>(name, problem, "quad");
  add_eigen(name, problem);
}

[[maybe_unused]] const bool added = [] {
  for (const std::size_t rows : {4, 8, 16, 64, 256, 1024}) {
    const std::string of = "-" + std::to_string(rows);
    const Problem problem(rows, chain(rows));
    add_structure("tridiagonal" + of, rows, chain(rows));
    add_by_hand("tridiagonal" + of, problem, "one-end", one_end);
    add_by_hand("tridiagonal" + of, problem, "both-ends", both_ends);
    Couplings ring = chain(rows);
    ring.emplace_back(0, rows - 1);
    add_structure("cyclic" + of, rows, ring);
    if (rows < 16) continue;
    add_structure("tree" + of, rows, ribs(rows));
    const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(rows)));
    add_structure("sparse" + of, rows, lattice(width));
  }
  add_structure("tree-12", 12,
                of_rods({{0, 1},
                         {1, 2},
                         {2, 3},
                         {3, 4},
                         {1, 5},
                         {5, 6},
                         {6, 7},
                         {1, 8},
                         {8, 9},
                         {9, 10},
                         {8, 11},
                         {11, 12}}));
  for (const std::size_t rows : {16, 64})
    add_structure("dense-" + std::to_string(rows), rows, complete(rows));
  return true;
}();
}  // namespace
