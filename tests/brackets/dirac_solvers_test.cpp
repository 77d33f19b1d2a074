// All solvers of the Dirac bracket give the same bracket: exactly modulo a prime, on every fifth in rationals
// too, and within conditioning in double and quad, on 1000 random instances. Solvers for structured matrices
// are tested on matrices of their structure.
#include <gtest/gtest.h>

#include <numeric>

#include "../built.hpp"
#include "dirac_instance.hpp"
#include "modulo_prime.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

template <class T>
double largest_of(const std::vector<T>& x) {
  double worst = 0;
  for (const T& v : x) worst = std::max(worst, std::abs(static_cast<double>(v)));
  return worst;
}

// The largest entry that the elimination meets, by the largest at the start: what unpivoted solvers lose.
double growth(const DiracInstance<double>& d, const EliminationOrder& order) {
  const std::size_t n = d.count;
  Matrix<double> g(n, d.gram);
  const double start = largest_of(d.gram);
  double worst = start;
  for (const EliminationStep& step : order) {
    Matrix<double> next = g;
    const auto entry = [&](std::size_t i, std::size_t j) { return g(i, j); };
    for (std::size_t j = 0; j < n; ++j) {
      pfaff::detail::StepCoefficients<double> x;
      if (!pfaff::detail::solve_step<double>(
              step, d.symmetry, entry, [&](std::size_t i) { return g(i, j); }, x))
        return std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < n; ++i) {
        next(i, j) -= g(i, step.columns[0]) * x.first;
        if (step.columns.size() == 2) next(i, j) -= g(i, step.columns[1]) * x.second;
      }
      worst = std::max({worst, std::abs(x.first) * start, std::abs(x.second) * start});
    }
    g = next;
    worst = std::max(worst, static_cast<double>(largest(g)));
  }
  return worst / start;
}

struct Judge {
  const DiracInstance<Rational>& exact;
  std::vector<Rational> expected;
  double condition, scale;
  bool works_in_the_order_given;  // of the unpivoted recursion

  explicit Judge(const DiracInstance<Rational>& d)
      : exact(d), condition(1), scale(1), works_in_the_order_given(false) {
    Status status{};
    expected = solved(d, DenseDirac{}, status);
    const Matrix<Rational> w(d.count, d.gram), inverted = inverse(w);
    condition = static_cast<double>(d.count) * static_cast<double>(largest(w)) *
                static_cast<double>(largest(inverted));
    const std::vector<Rational> c = inverted * d.brackets;
    scale = std::max({largest_of(expected), largest_of(d.vector),
                      static_cast<double>(d.count) * largest_of(d.sharps) * largest_of(c)});
    std::vector<std::size_t> order(d.count);
    std::iota(order.begin(), order.end(), std::size_t(0));
    works_in_the_order_given = plain_recursion(w, d.symmetry, order).works;
  }
  // 1e3 u cond(W), of the size of what is subtracted; times the growth of an unpivoted elimination.
  template <class T, class Solver>
  void agrees(const DiracInstance<T>& d, const Solver& solver, double grown = 1) const {
    Status status{};
    const std::vector<T> result = solved(d, solver, status);
    ASSERT_EQ(status, Status::converged) << Solver::name;
    for (std::size_t a = 0; a < d.n; ++a) {
      if constexpr (std::numeric_limits<T>::is_exact) {
        ASSERT_EQ(result[a], as<T>(expected[a])) << Solver::name << " coordinate " << a;
      } else {
        const double difference = std::abs(static_cast<double>(result[a] - as<T>(expected[a])));
        const double tolerance = 1e3 * static_cast<double>(unit_roundoff<T>()) * condition * scale * grown;
        ASSERT_LE(difference, tolerance) << Solver::name << " coordinate " << a;
      }
    }
  }
};

template <class T>
void check_all(const DiracInstance<Rational>& exact, const Judge& judge) {
  const DiracInstance<T> d = in_scalar<T>(exact);
  const auto rounded = in_scalar<double>(exact);
  const EliminationOrder pivoted = pivoted_order(classify(Matrix<double>(d.count, rounded.gram), d.symmetry));
  const double grown = growth(rounded, pivoted);
  judge.agrees(d, DenseDirac{});
  judge.agrees(d, RecursiveVectorsDirac{pivoted}, grown);
  judge.agrees(d, RecursiveTensorDirac{pivoted}, grown);
  judge.agrees(d, RecursiveLiteralDirac{pivoted}, grown);
  judge.agrees(d, BorderedDirac{});
  if (d.symmetry == Symmetry::skew) judge.agrees(d, PfaffianDirac{});
  // Without pivots, in the order given, where that works.
  const EliminationOrder plain = plain_order(d.count, d.symmetry);
  if (!judge.works_in_the_order_given) return;
  const double grown_plain = growth(rounded, plain);
  judge.agrees(d, RecursiveVectorsDirac{}, grown_plain);
  judge.agrees(d, RecursiveTensorDirac{}, grown_plain);
  judge.agrees(d, RecursiveLiteralDirac{}, grown_plain);
}

// Judging in exact rationals takes minutes under a sanitizer: every part takes a tenth of its instances
// there.
unsigned instances() { return has_address_sanitizer() ? 12 : 125; }

class DiracSolvers : public ::testing::TestWithParam<unsigned> {};

TEST_P(DiracSolvers, AgreeOnRandomInstances) {
  for (unsigned k = 0; k < instances(); ++k) {
    const unsigned seed = GetParam() * 125 + k;
    SCOPED_TRACE(seed);
    const DiracInstance<Rational> exact = random_instance(seed);
    const Judge judge(exact);
    check_all<double>(exact, judge);
    check_all<Quad>(exact, judge);
    check_all<ModuloPrime>(exact, judge);
    if (k % 5 == 0) check_all<Rational>(exact, judge);
    if (HasFatalFailure()) return;
  }
}
INSTANTIATE_TEST_SUITE_P(Thousand, DiracSolvers, ::testing::Range(0U, 8U));

// Instances whose W has a given structure: the gradients are unit covectors, so that W is a block of the
// tensor.
DiracInstance<Rational> structured_instance(unsigned seed, Symmetry symmetry, std::size_t count,
                                            const std::vector<std::pair<std::size_t, std::size_t>>& edges) {
  std::mt19937 random(seed);
  const auto integer = [&] { return std::uniform_int_distribution<int>(1, 5)(random); };
  DiracInstance<Rational> d{};
  d.symmetry = symmetry;
  d.count = count;
  d.n = count + 4;
  d.tensor.resize(d.n * d.n);
  const auto set = [&](std::size_t a, std::size_t b) {
    const int x = integer(), y = integer();
    d.tensor[a * d.n + b] = Rational(x);
    d.tensor[b * d.n + a] = symmetry == Symmetry::skew        ? Rational(-x)
                            : symmetry == Symmetry::symmetric ? Rational(x)
                                                              : Rational(y);
  };
  for (const auto& [i, j] : edges) set(i, j);
  for (std::size_t a = 0; a < d.n; ++a)
    for (std::size_t b = std::max(a + 1, count); b < d.n; ++b) set(a, b);
  for (std::size_t a = 0; a < d.n; ++a)
    if (symmetry != Symmetry::skew) d.tensor[a * d.n + a] = Rational(15 + integer());  // no pivot vanishes
  d.gradients.resize(count * d.n);
  for (std::size_t i = 0; i < count; ++i) d.gradients[i * d.n + i] = Rational(1);
  for (std::size_t a = 0; a < d.n; ++a) d.covector.emplace_back(integer());
  complete(d);
  return d;
}

using Edges = std::vector<std::pair<std::size_t, std::size_t>>;
Edges path(std::size_t count) {
  Edges edges;
  for (std::size_t k = 0; k + 1 < count; ++k) edges.emplace_back(k, k + 1);
  return edges;
}
Edges ring(std::size_t count) {
  Edges edges = path(count);
  edges.emplace_back(0, count - 1);
  return edges;
}
// Rods of the humanoid: those that share a point couple.
Edges humanoid() {
  const Edges rods{{0, 1}, {1, 2}, {2, 3}, {3, 4},  {1, 5},  {5, 6},
                   {6, 7}, {1, 8}, {8, 9}, {9, 10}, {8, 11}, {11, 12}};
  Edges edges;
  for (std::size_t i = 0; i < rods.size(); ++i)
    for (std::size_t j = i + 1; j < rods.size(); ++j)
      if (rods[i].first == rods[j].first || rods[i].second == rods[j].first ||
          rods[i].first == rods[j].second || rods[i].second == rods[j].second)
        edges.emplace_back(i, j);
  return edges;
}

template <class T>
void expect_structured_agrees(const DiracInstance<Rational>& exact, const Edges& edges) {
  const Judge judge(exact);
  const StructuredDirac solver{std::make_shared<const SymmetricPattern>(exact.count, edges)};
  ASSERT_TRUE(solver.applies(in_scalar<double>(exact).data()));
  judge.agrees(in_scalar<T>(exact), solver,
               growth(in_scalar<double>(exact), plain_order(exact.count, exact.symmetry)));
}

TEST(DiracSolversStructured, TridiagonalCyclicAndTreesOfSymmetricAndGeneralBrackets) {
  for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none})
    for (const Edges& edges : {path(9), ring(8), humanoid()}) {
      const std::size_t count = edges.size() == humanoid().size()              ? 12
                                : edges.size() == 8 && edges.back().first == 0 ? 8
                                                                               : 9;
      for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto exact = structured_instance(seed, symmetry, count, edges);
        expect_structured_agrees<double>(exact, edges);
        expect_structured_agrees<Quad>(exact, edges);
        expect_structured_agrees<Rational>(exact, edges);
      }
    }
}

TEST(DiracSolversStructured, SkewForests) {
  const Edges tree{{0, 1}, {1, 2}, {2, 3}, {1, 4}, {4, 5}, {2, 6}, {6, 7}};  // matched: 0-1, 2-3, 4-5, 6-7
  for (const Edges& edges : {path(8), tree})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const auto exact = structured_instance(seed, Symmetry::skew, 8, edges);
      const SkewForestDirac solver{edges};
      ASSERT_TRUE(solver.applies(in_scalar<double>(exact).data()));
      const Judge judge(exact);
      const EliminationOrder order = [&] {
        EliminationOrder steps;
        for (const auto& [i, j] : solver.pairs(8)) steps.push_back({{i, j}, {i, j}});
        return steps;
      }();
      const double grown = growth(in_scalar<double>(exact), order);
      judge.agrees(in_scalar<double>(exact), solver, grown);
      judge.agrees(in_scalar<Quad>(exact), solver, grown);
      judge.agrees(exact, solver);
    }
}

// A star of four has no perfect matching: W is singular, which the solver says.
TEST(DiracSolversStructured, ForestWithoutMatchingIsSingular) {
  const Edges star{{0, 1}, {0, 2}, {0, 3}};
  const auto exact = structured_instance(1, Symmetry::skew, 4, star);
  EXPECT_EQ(determinant(Matrix<Rational>(4, exact.gram)), Rational(0));
  Status status{};
  (void)solved(exact, SkewForestDirac{star}, status);
  EXPECT_EQ(status, Status::singular);
}

// Canonical brackets of constraints phi_k(q), phi~_k on a chain: (4.1) with a tridiagonal S.
template <class T>
void check_blocks(unsigned seed) {
  const std::size_t half = 5, n = 2 * (half + 1);
  std::mt19937 random(seed);
  const auto integer = [&] { return std::uniform_int_distribution<int>(-3, 3)(random); };
  DiracInstance<Rational> d{};
  d.symmetry = Symmetry::skew;
  d.count = 2 * half;
  d.n = n;
  d.tensor.resize(n * n);
  for (std::size_t k = 0; k < n / 2; ++k) {
    d.tensor[k * n + n / 2 + k] = Rational(1);
    d.tensor[(n / 2 + k) * n + k] = Rational(-1);
  }
  // phi_k depends on q_k, q_k+1; phi~_k has the same slopes by momentum (unit masses), any by position.
  d.gradients.resize(d.count * n);
  for (std::size_t k = 0; k < half; ++k) {
    const int left = 4 + integer(), right = integer();
    d.gradients[(2 * k) * n + k] = d.gradients[(2 * k + 1) * n + n / 2 + k] = Rational(left);
    d.gradients[(2 * k) * n + k + 1] = d.gradients[(2 * k + 1) * n + n / 2 + k + 1] = Rational(right);
    d.gradients[(2 * k + 1) * n + k] = Rational(integer());
    d.gradients[(2 * k + 1) * n + k + 1] = Rational(integer());
  }
  for (std::size_t a = 0; a < n; ++a) d.covector.emplace_back(integer());
  complete(d);
  const Judge judge(d);
  const auto tridiagonal = std::make_shared<const SymmetricPattern>(half, path(half));
  for (const HolonomicDirac& solver : {HolonomicDirac{}, HolonomicDirac{tridiagonal}}) {
    ASSERT_TRUE(solver.applies(in_scalar<double>(d).data()));
    judge.agrees(in_scalar<T>(d), solver);
  }
}
TEST(DiracSolversStructured, HolonomicBlocks) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    check_blocks<double>(seed);
    check_blocks<Quad>(seed);
    check_blocks<Rational>(seed);
  }
}

// The control: a solver for (4.1) is not for constraints in another order, nor one for a pattern for a W with
// more entries.
TEST(DiracSolversStructured, DoNotApplyToOtherMatrices) {
  const auto exact = random_instance(3);  // skew
  ASSERT_EQ(exact.symmetry, Symmetry::skew);
  EXPECT_FALSE(HolonomicDirac{}.applies(in_scalar<double>(exact).data()) && exact.count > 2);
  const auto ringed = structured_instance(1, Symmetry::symmetric, 8, ring(8));
  EXPECT_FALSE(StructuredDirac{std::make_shared<const SymmetricPattern>(8, path(8))}.applies(
      in_scalar<double>(ringed).data()));
}

// The unpivoted recursion says where it breaks down, in every form; with pivots it does not.
TEST(DiracSolvers, BreakDownsAreStatuses) {
  DiracInstance<Rational> d{};  // Example 3.1 with a = 3, and coordinates beside
  d.symmetry = Symmetry::symmetric;
  d.count = 2;
  d.n = 3;
  for (const int x : {0, 3, 1, 3, 0, 2, 1, 2, 5}) d.tensor.emplace_back(x);
  for (const int x : {1, 0, 0, 0, 1, 0}) d.gradients.emplace_back(x);
  for (const int x : {1, -1, 2}) d.covector.emplace_back(x);
  complete(d);
  Status status{};
  (void)solved(d, RecursiveVectorsDirac{}, status);
  EXPECT_EQ(status, Status::singular);
  (void)solved(d, RecursiveTensorDirac{}, status);
  EXPECT_EQ(status, Status::singular);
  (void)solved(d, RecursiveLiteralDirac{}, status);
  EXPECT_EQ(status, Status::singular);
  const Judge judge(d);
  const EliminationOrder pair{{{0, 1}, {0, 1}}};
  judge.agrees(d, RecursiveVectorsDirac{pair});
  judge.agrees(d, RecursiveTensorDirac{pair});
  judge.agrees(d, RecursiveLiteralDirac{pair});
  // u1 = x1 + x2, u2 = x1 - x2 span the same constraints, with pivots 2a and -2a.
  DiracInstance<Rational> u = d;
  u.gradients.clear();
  for (const int x : {1, 1, 0, 1, -1, 0}) u.gradients.emplace_back(x);
  complete(u);
  EXPECT_EQ(u.gram[0], Rational(6));
  EXPECT_EQ(u.gram[3], Rational(-6));
  judge.agrees(u, RecursiveVectorsDirac{});
  judge.agrees(u, RecursiveTensorDirac{});
}

TEST(Determinants, WithoutDivisionsAndPfaffiansTwoWays) {
  RandomGram random(20260101);
  for (int k = 0; k < 40; ++k) {
    const std::size_t n = random.size(1, 7);
    const Matrix<Rational> a = random.any(n, n);
    EXPECT_EQ(berkowitz_determinant(a), determinant(a));
    const Matrix<Rational> s = random.of(Symmetry::skew, 2 * random.size(1, 4));
    const Rational pf = pfaffian_by_elimination(s);
    EXPECT_EQ(pf, pfaffian_by_expansion(s));
    EXPECT_EQ(pf * pf, determinant(s));
  }
}

}  // namespace
