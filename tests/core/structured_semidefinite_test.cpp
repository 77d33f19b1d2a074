// Factorizations of semidefinite matrices: how many pivots are dropped, and that the remaining factors solve
// equations whose right-hand sides are in the range.
#include <gtest/gtest.h>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "structured_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

/// A = sum over couplings of w_c (v_j e_i - v_i e_j)(v_j e_i - v_i e_j)^T. It is semidefinite for weights
/// w >= 0, and its kernel has one dimension for every set of rows that positive weights connect, all v != 0.
template <class T>
struct Laplacian {
  std::shared_ptr<const SymmetricPattern> pattern;
  std::vector<T> weights, v;
  std::size_t kernel;

  Laplacian(std::shared_ptr<const SymmetricPattern> p, std::mt19937_64& random) : pattern(std::move(p)) {
    const std::size_t rows = pattern->rows();
    for (std::size_t i = 0; i < rows; ++i) v.push_back(T(1 + static_cast<int>(random() % 7)) / T(3));
    std::vector<std::size_t> component(rows);
    std::iota(component.begin(), component.end(), std::size_t(0));
    for (const auto& [i, j] : pattern->couplings()) {
      const int weight = random() % 4 == 0 ? 0 : 1 + static_cast<int>(random() % 9);
      weights.push_back(T(weight) / T(7));
      if (weight == 0) continue;
      const std::size_t from = component[i], to = component[j];
      for (std::size_t& k : component)
        if (k == from) k = to;
    }
    std::sort(component.begin(), component.end());
    kernel = static_cast<std::size_t>(std::unique(component.begin(), component.end()) - component.begin());
  }
  void fill(StructuredLDLT<T>& matrix) const {
    std::fill_n(matrix.diagonal(), pattern->rows(), T(0));
    for (std::size_t c = 0; c < weights.size(); ++c) {
      const auto& [i, j] = pattern->couplings()[c];
      matrix.diagonal()[i] = matrix.diagonal()[i] + weights[c] * v[j] * v[j];
      matrix.diagonal()[j] = matrix.diagonal()[j] + weights[c] * v[i] * v[i];
      matrix.couplings()[c] = -(weights[c] * v[i] * v[j]);
    }
  }
};
/// A x, of the entries in the matrix.
template <class T>
std::vector<T> product(const SymmetricPattern& pattern, const StructuredLDLT<T>& matrix,
                       const std::vector<T>& x) {
  std::vector<T> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = matrix.diagonal()[i] * x[i];
  for (std::size_t c = 0; c < pattern.couplings().size(); ++c) {
    const auto& [i, j] = pattern.couplings()[c];
    result[i] = result[i] + matrix.couplings()[c] * x[j];
    result[j] = result[j] + matrix.couplings()[c] * x[i];
  }
  return result;
}

template <class T>
void solves_on_the_range(const T& tolerance) {
  std::mt19937_64 random(51);
  for (const Sample& sample : samples(random))
    for (int trial = 0; trial < 20; ++trial) {
      const Laplacian<T> laplacian(sample.pattern, random);
      StructuredLDLT<T> matrix(sample.pattern);
      laplacian.fill(matrix);
      ASSERT_EQ(matrix.factor_semidefinite(), Status::converged);
      EXPECT_EQ(matrix.dropped(), laplacian.kernel) << sample.name;
      const auto y = random_integers<T>(sample.pattern->rows(), random);
      const std::vector<T> right = product(*sample.pattern, matrix, y);
      std::vector<T> x(y.size());
      matrix.solve(right.data(), x.data());
      const std::vector<T> again = product(*sample.pattern, matrix, x);
      for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_LE(abs(again[i] - right[i]), tolerance) << sample.name;
    }
}
TEST(Semidefinite, SolvesOnTheRangeExactlyOverRationals) { solves_on_the_range<Rational>(0); }
// Entries up to 10 x 16 solve for right-hand sides up to 10^4; solutions of a Laplacian of 30 rows may be as
// large as those times rows^2.
TEST(Semidefinite, SolvesOnTheRangeInDouble) { solves_on_the_range<double>(1e-10); }
TEST(Semidefinite, SolvesOnTheRangeInQuad) { solves_on_the_range<Quad>(Quad(1e-28)); }

TEST(Semidefinite, FactorAloneFailsThere) {
  std::mt19937_64 random(52);
  for (const Sample& sample : samples(random)) {
    const Laplacian<Rational> laplacian(sample.pattern, random);
    StructuredLDLT<Rational> matrix(sample.pattern);
    laplacian.fill(matrix);
    EXPECT_EQ(matrix.factor(), Status::singular) << sample.name;
    EXPECT_EQ(matrix.dropped(), 0U);
  }
}

TEST(Semidefinite, APositiveDefiniteMatrixLosesNothing) {
  std::mt19937_64 random(53);
  for (const Sample& sample : samples(random)) {
    const Entries e = Entries::positive(*sample.pattern, random);
    StructuredLDLT<double> regular(sample.pattern), semidefinite(sample.pattern);
    e.fill(regular);
    e.fill(semidefinite);
    ASSERT_EQ(regular.factor(), Status::converged);
    ASSERT_EQ(semidefinite.factor_semidefinite(), Status::converged);
    EXPECT_EQ(semidefinite.dropped(), 0U);
    const auto b = random_integers<double>(sample.pattern->rows(), random);
    std::vector<double> x(b.size()), y(b.size());
    regular.solve(b.data(), x.data());
    semidefinite.solve(b.data(), y.data());
    EXPECT_EQ(x, y) << sample.name;
  }
}

// Between frictionless ends every row is nearly as singular as the next: second differences with free ends
// (kernel: constants), and with one end held by a spring that is weak but well above round-off.
TEST(Semidefinite, LongChainsKnowASpringFromRoundOff) {
  for (const std::size_t rows : {10, 100, 1000, 10000}) {
    const auto pattern = std::make_shared<const SymmetricPattern>(SymmetricPattern::path(rows));
    StructuredLDLT<double> matrix(pattern);
    // A row scale that is not a power of two, so that elimination rounds.
    const auto scale = [](std::size_t i) { return 1 + 0.1 * static_cast<double>(i % 7); };
    for (std::size_t i = 0; i < rows; ++i)
      matrix.diagonal()[i] = (i == 0 || i + 1 == rows ? 1 : 2) * scale(i) * scale(i);
    for (std::size_t i = 0; i + 1 < rows; ++i) matrix.couplings()[i] = -scale(i) * scale(i + 1);
    ASSERT_EQ(matrix.factor_semidefinite(), Status::converged);
    EXPECT_EQ(matrix.dropped(), 1U) << rows;
    matrix.diagonal()[0] += 1e-8;
    ASSERT_EQ(matrix.factor_semidefinite(), Status::converged);
    EXPECT_EQ(matrix.dropped(), 0U) << rows;
  }
}

TEST(Semidefinite, NotANumberIsSaid) {
  std::mt19937_64 random(54);
  for (const Sample& sample : samples(random)) {
    const Entries e = Entries::positive(*sample.pattern, random);
    StructuredLDLT<double> matrix(sample.pattern);
    for (const double bad : {double(NAN), double(INFINITY)}) {
      e.fill(matrix);
      matrix.diagonal()[random() % sample.pattern->rows()] = bad;
      EXPECT_EQ(matrix.factor_semidefinite(), Status::singular) << sample.name << " " << bad;
    }
  }
}

/// How many pivots are dropped of P Lambda P^T for a chain of rods, many of them parallel and many of their
/// ends without friction; its entries are computed as a system would compute them.
struct FrictionOfAChain {
  std::vector<std::vector<int>> rods;
  std::vector<int> friction;  // of the ends

  FrictionOfAChain(std::size_t count, std::size_t dimension, std::mt19937_64& random) {
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<int> rod;
      for (std::size_t c = 0; c < dimension; ++c) rod.push_back(static_cast<int>(random() % 2001) - 1000);
      rods.push_back(k > 0 && random() % 2 == 0 ? rods.back() : rod);
    }
    for (std::size_t k = 0; k <= count; ++k)
      friction.push_back(random() % 3 == 0 ? 0 : static_cast<int>(random() % 1000));
  }
  template <class T>
  std::size_t dropped() const {
    StructuredLDLT<T> matrix(std::make_shared<const SymmetricPattern>(SymmetricPattern::path(rods.size())));
    const auto weight = [&](std::size_t end) {
      const T mass = T(static_cast<int>(end % 5) + 1) / T(3);
      return T(friction[end]) / T(30) / (mass * mass);
    };
    const auto inner = [&](std::size_t a, std::size_t b) {
      T sum(0);
      for (std::size_t c = 0; c < rods[a].size(); ++c)
        sum = sum + (T(rods[a][c]) / T(700)) * (T(rods[b][c]) / T(700));
      return sum;
    };
    for (std::size_t k = 0; k < rods.size(); ++k) {
      matrix.diagonal()[k] = (weight(k) + weight(k + 1)) * inner(k, k);
      if (k + 1 < rods.size()) matrix.couplings()[k] = -(weight(k + 1) * inner(k, k + 1));
    }
    EXPECT_EQ(matrix.factor_semidefinite(), Status::converged);
    return matrix.dropped();
  }
};
TEST(Semidefinite, TheRankOfFrictionIsThatOfExactArithmetic) {
  std::mt19937_64 random(57);
  int singular = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t rods = 2 + random() % 30, dimension = 1 + random() % 3;
    const FrictionOfAChain chain(rods, dimension, random);
    const std::size_t exact = chain.dropped<Rational>();
    EXPECT_EQ(chain.dropped<double>(), exact) << trial;
    EXPECT_EQ(chain.dropped<Quad>(), exact) << trial;
    singular += exact > 0;
  }
  EXPECT_GT(singular, 100);
  EXPECT_LT(singular, 290);
}

// The zero matrix: everything is dropped and nothing divided by.
TEST(Semidefinite, ZeroHasNoRange) {
  std::mt19937_64 random(55);
  for (const Sample& sample : samples(random)) {
    const std::size_t rows = sample.pattern->rows();
    StructuredLDLT<Dual<double, 2>> matrix(sample.pattern);
    std::vector<Dual<double, 2>> x(rows, Dual<double, 2>::variable(1.0, 0));
    ASSERT_EQ(matrix.factor_semidefinite(), Status::converged);
    EXPECT_EQ(matrix.dropped(), rows);
    matrix.solve(x.data(), x.data());
    for (const auto& e : x) {
      EXPECT_EQ(e.value, 0);
      EXPECT_EQ(e.derivative[0], 0);
    }
  }
}

// Recorded, the pivots are chosen when the tape is replayed, in its precision.
template <class T>
void recorded_chooses_on_replay() {
  std::mt19937_64 random(56);
  for (const Sample& sample : samples(random)) {
    const std::size_t rows = sample.pattern->rows(), couplings = sample.pattern->couplings().size();
    const auto formula = [&]<class N>(std::span<const N> z, std::span<N> x) {
      StructuredLDLT<N> matrix(sample.pattern);
      std::copy_n(z.begin(), rows, matrix.diagonal());
      std::copy_n(z.begin() + static_cast<std::ptrdiff_t>(rows), couplings, matrix.couplings());
      matrix.factor_semidefinite();
      matrix.solve(z.data() + rows + couplings, x.data());
    };
    Replay<T> replay(std::make_shared<const Tape>(
        record(static_cast<int>(2 * rows + couplings), static_cast<int>(rows),
               [&](const Recorded&, std::span<const Recorded> z, std::span<Recorded> x) { formula(z, x); })));
    for (int trial = 0; trial < 3; ++trial) {
      const Laplacian<T> laplacian(sample.pattern, random);
      StructuredLDLT<T> matrix(sample.pattern);
      laplacian.fill(matrix);
      std::vector<T> z(matrix.diagonal(), matrix.diagonal() + rows), x(rows), expected(rows);
      z.insert(z.end(), matrix.couplings(), matrix.couplings() + couplings);
      const auto right = product(*sample.pattern, matrix, random_integers<T>(rows, random));
      z.insert(z.end(), right.begin(), right.end());
      formula(std::span<const T>(z), std::span<T>(expected));
      replay(T(0), z.data(), x.data());
      EXPECT_EQ(x, expected) << sample.name;
    }
  }
}
TEST(Semidefinite, RecordedChoosesOnReplay) {
  recorded_chooses_on_replay<double>();
  recorded_chooses_on_replay<Quad>();
}

}  // namespace
