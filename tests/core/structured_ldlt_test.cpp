// L D L^T factorizations on every structure: exact over rationals, within round-off bounds in double and
// quad, compared with Eigen, and the same for duals, recorded formulas and packs.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../eigen/decompositions.hpp"
#include "structured_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

template <class T>
T norm1(const std::vector<T>& x) {
  T sum(0);
  for (const T& e : x) sum = sum + abs(e);
  return sum;
}
template <class T>
T norm_max(const std::vector<T>& x) {
  T largest(0);
  for (const T& e : x) largest = std::max(largest, T(abs(e)));
  return largest;
}

TEST(StructuredLDLT, ExactOverRationals) {
  std::mt19937_64 random(41);
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    StructuredLDLT<Rational> matrix(sample.pattern);
    int regular = 0;
    for (int trial = 0; trial < 6; ++trial) {
      // Indefinite ones as well, of which a few meet a vanishing pivot.
      Entries e = trial % 2 == 0 ? Entries::positive(pattern, random) : Entries::random(pattern, -8, random);
      e.upper = e.lower;
      e.fill(matrix);
      const auto b1 = random_integers<Rational>(pattern.rows(), random),
                 b2 = random_integers<Rational>(pattern.rows(), random);
      if (matrix.factor() == Status::singular) continue;
      ++regular;
      std::vector<Rational> x(b1.size()), y(b1.size()), z = b1;
      matrix.solve(b1.data(), x.data(), b2.data(), y.data());
      for (const auto& [solution, right] : {std::pair(x, b1), std::pair(y, b2)})
        for (const Rational& r : e.residual(pattern, solution, right))
          EXPECT_EQ(r, Rational(0)) << sample.name;
      // In place; one at a time; in one pass.
      matrix.solve(z.data(), z.data());
      EXPECT_EQ(x, z) << sample.name;
      std::vector<Rational> w = b2;
      EXPECT_EQ(matrix.factor_and_solve(w.data(), w.data()), Status::converged);
      EXPECT_EQ(w, y) << sample.name;
    }
    EXPECT_GE(regular, 3);
  }
}

// |A x - b|_i <= c u growth max|A| |x|_1, where c counts the roundings of a row: those of the factors, of the
// two substitutions and of the residual itself, as many as the row has entries (higham2002,
// theorem 9.4, for a factorisation without exchanges).
template <class T>
T bound(const SymmetricPattern& pattern, const Entries& e, const T& growth, const std::vector<T>& x) {
  std::vector<int> entries(pattern.rows(), 3);
  for (const auto& [i, j] : pattern.couplings()) ++entries[i], ++entries[j];
  const int most = *std::max_element(entries.begin(), entries.end());
  return T(4 * most) * unit_roundoff<T>() * growth * T(e.largest()) * norm1(x);
}

template <class T>
void ldlt_residuals_are_round_off() {
  std::mt19937_64 random(42);
  int noticed = 0, changed = 0;
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    StructuredLDLT<T> matrix(sample.pattern);
    for (int trial = 0; trial < 20; ++trial) {
      const Entries e = Entries::positive(pattern, random);
      e.fill(matrix);
      const auto b = random_integers<T>(pattern.rows(), random);
      std::vector<T> x(b.size()), y(b.size());
      ASSERT_EQ(matrix.factor(), Status::converged);
      // Positive definite: the diagonal of L D L^T is that of A.
      EXPECT_LE(matrix.growth(), T(1) + T(16) * unit_roundoff<T>()) << sample.name;
      matrix.solve(b.data(), x.data());
      EXPECT_LE(norm_max(e.residual(pattern, x, b)), bound(pattern, e, T(1), x)) << sample.name;
      matrix.factor_and_solve(b.data(), y.data());
      EXPECT_EQ(x, y) << sample.name;
      // Control: a coupling that is wrong in its last digits but two is noticed.
      if (e.lower.empty()) continue;
      T& coupling = matrix.couplings()[random() % e.lower.size()];
      coupling = coupling * (T(1) + T(4096) * unit_roundoff<T>());
      matrix.factor_and_solve(b.data(), y.data());
      noticed += norm_max(e.residual(pattern, y, b)) > bound(pattern, e, T(1), y);
      ++changed;
    }
  }
  // Not where the entry or the solution there happens to be small.
  EXPECT_GT(noticed, changed / 2);
}
TEST(StructuredLDLT, ResidualsAreRoundOffInDouble) { ldlt_residuals_are_round_off<double>(); }
TEST(StructuredLDLT, ResidualsAreRoundOffInQuad) { ldlt_residuals_are_round_off<Quad>(); }

TEST(StructuredLDLT, SolvesLikeEigensSimplicialFactorisation) {
  std::mt19937_64 random(43);
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    const auto rows = static_cast<int>(pattern.rows());
    const Entries e = Entries::positive(pattern, random);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, rows);
    for (int i = 0; i < rows; ++i) a(i, i) = e.diagonal[static_cast<std::size_t>(i)];
    for (std::size_t c = 0; c < e.lower.size(); ++c) {
      const auto i = static_cast<int>(pattern.couplings()[c].first),
                 j = static_cast<int>(pattern.couplings()[c].second);
      a(i, j) = a(j, i) = e.lower[c];
    }
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(rows, -1, 2);
    const Eigen::VectorXd expected = solved_by_simplicial_ldlt(a, b);
    StructuredLDLT<double> matrix(sample.pattern);
    e.fill(matrix);
    Eigen::VectorXd x(rows);
    ASSERT_EQ(matrix.factor_and_solve(b.data(), x.data()), Status::converged);
    EXPECT_LE((x - expected).norm(), 1e-15 * condition_of(a) * expected.norm()) << sample.name;
  }
}

TEST(StructuredLDLT, DualsCarryDerivativesThrough) {
  using D = Dual<Quad, 2>;
  std::mt19937_64 random(44);
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    const std::size_t rows = pattern.rows();
    const Entries e = Entries::positive(pattern, random), slope = Entries::positive(pattern, random);
    StructuredLDLT<D> matrix(sample.pattern);
    StructuredLDLT<Quad> plain(sample.pattern);
    e.fill(matrix);
    e.fill(plain);
    for (std::size_t i = 0; i < rows; ++i) matrix.diagonal()[i].derivative[1] = Quad(slope.diagonal[i]);
    for (std::size_t c = 0; c < e.lower.size(); ++c)
      matrix.couplings()[c].derivative[1] = Quad(slope.lower[c]);
    const auto b = random_integers<Quad>(rows, random), db = random_integers<Quad>(rows, random);
    std::vector<D> right(rows), x(rows), y(rows);
    for (std::size_t i = 0; i < rows; ++i) {
      right[i].value = b[i];
      right[i].derivative[1] = db[i];
    }
    ASSERT_EQ(matrix.factor(), Status::converged);
    ASSERT_EQ(plain.factor(), Status::converged);
    matrix.solve(right.data(), x.data());
    // A x = b and A x' = b' - A' x.
    std::vector<Quad> expected(rows), derivative(rows);
    plain.solve(b.data(), expected.data());
    derivative = slope.residual(pattern, expected, db);
    for (Quad& r : derivative) r = -r;
    plain.solve(derivative.data(), derivative.data());
    // A plain matrix against a right-hand side with derivatives is that with A' = 0.
    std::vector<Quad> of_right(rows);
    plain.solve(db.data(), of_right.data());
    plain.solve(right.data(), y.data());
    // Entries are of order 10, solutions of order 1; the condition is at most (2 x 8 x 8 + 17) / 1.
    const Quad tolerance(1e-30);
    for (std::size_t i = 0; i < rows; ++i) {
      EXPECT_EQ(x[i].value, expected[i]);
      EXPECT_LE(abs(x[i].derivative[1] - derivative[i]), tolerance * (Quad(1) + norm_max(derivative)));
      EXPECT_EQ(x[i].derivative[0], Quad(0));
      EXPECT_EQ(y[i].value, expected[i]);
      EXPECT_LE(abs(y[i].derivative[1] - of_right[i]), tolerance * (Quad(1) + norm_max(of_right)));
    }
  }
}

// factor() and solve(), or factor_semidefinite() and solve(), as a formula of all entries.
struct SolveFormula {
  std::shared_ptr<const SymmetricPattern> pattern;
  bool semidefinite;

  [[nodiscard]] int inputs() const {
    return static_cast<int>(2 * pattern->rows() + pattern->couplings().size());
  }
  template <class T>
  void operator()(const T& /*t*/, In<T> z, Out<T> x) const {
    const std::size_t rows = pattern->rows(), couplings = pattern->couplings().size();
    StructuredLDLT<T> matrix(pattern);
    std::copy_n(z.begin(), rows, matrix.diagonal());
    std::copy_n(z.begin() + static_cast<std::ptrdiff_t>(rows), couplings, matrix.couplings());
    const Status status = semidefinite ? matrix.factor_semidefinite() : matrix.factor();
    EXPECT_EQ(status, Status::converged);
    matrix.solve(z.data() + rows + couplings, x.data());
  }
};

template <class T>
void recorded_is_the_same() {
  std::mt19937_64 random(45);
  for (const Sample& sample : samples(random))
    for (const bool semidefinite : {false, true}) {
      const SolveFormula formula{sample.pattern, semidefinite};
      const auto rows = static_cast<int>(sample.pattern->rows());
      Replay<T> replay(std::make_shared<const Tape>(record(
          formula.inputs(), rows,
          [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> x) { formula(t, z, x); })));
      for (int trial = 0; trial < 3; ++trial) {
        const Entries e = Entries::positive(*sample.pattern, random);
        std::vector<T> z;
        for (const int x : e.diagonal) z.push_back(T(x) / T(3));
        for (const int x : e.lower) z.push_back(T(x) / T(3));
        for (const T& x : random_integers<T>(sample.pattern->rows(), random)) z.push_back(x / T(7));
        std::vector<T> expected(sample.pattern->rows()), x(expected.size());
        formula(T(0), std::span<const T>(z), std::span<T>(expected));
        replay(T(0), z.data(), x.data());
        EXPECT_EQ(x, expected) << sample.name;
      }
    }
}
TEST(StructuredLDLT, RecordedFormulasGiveTheSameBits) {
  recorded_is_the_same<double>();
  recorded_is_the_same<Quad>();
}

TEST(StructuredLDLT, LanesOfPacksAreSeparateMatrices) {
  std::mt19937_64 random(46);
  constexpr std::size_t lanes = 4;
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    StructuredLDLT<Pack<lanes>> packs(sample.pattern);
    StructuredLDLT<double> one(sample.pattern);
    std::vector<Pack<lanes>> x(pattern.rows());
    std::vector<std::vector<double>> expected;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Entries e = Entries::positive(pattern, random);
      e.fill(one);
      for (std::size_t i = 0; i < pattern.rows(); ++i) packs.diagonal()[i].set(lane, e.diagonal[i]);
      for (std::size_t c = 0; c < e.lower.size(); ++c) packs.couplings()[c].set(lane, e.lower[c]);
      auto b = random_integers<double>(pattern.rows(), random);
      for (std::size_t i = 0; i < b.size(); ++i) x[i].set(lane, b[i]);
      ASSERT_EQ(one.factor_and_solve(b.data(), b.data()), Status::converged);
      expected.push_back(b);
    }
    ASSERT_EQ(packs.factor(), Status::converged);
    packs.solve(x.data(), x.data());
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(x[i][lane], expected[lane][i]) << sample.name;
    // One lane without a solution is enough.
    packs.diagonal()[0].set(1, NAN);
    EXPECT_EQ(packs.factor(), Status::singular);
  }
}

TEST(StructuredLDLT, SaysWhenAPivotIsOfNoUse) {
  std::mt19937_64 random(47);
  for (const Sample& sample : samples(random)) {
    const SymmetricPattern& pattern = *sample.pattern;
    StructuredLDLT<double> matrix(sample.pattern);
    const Entries e = Entries::positive(pattern, random);
    std::vector<double> x(pattern.rows(), 1.0);
    for (const double bad : {double(NAN), double(INFINITY), -double(INFINITY)})
      for (std::size_t i = 0; i < pattern.rows(); ++i) {
        e.fill(matrix);
        matrix.diagonal()[i] = bad;
        EXPECT_EQ(matrix.factor(), Status::singular) << sample.name << " " << bad;
        EXPECT_EQ(matrix.factor_and_solve(x.data(), x.data()), Status::singular) << sample.name;
      }
    for (std::size_t c = 0; c < e.lower.size(); ++c) {
      e.fill(matrix);
      matrix.couplings()[c] = NAN;
      EXPECT_EQ(matrix.factor(), Status::singular) << sample.name;
    }
    // Nothing remains of a failure.
    e.fill(matrix);
    EXPECT_EQ(matrix.factor(), Status::converged) << sample.name;
  }
  // [[1, 1], [1, 1]] exactly, a zero first pivot of a regular matrix, a pivot whose reciprocal overflows.
  const auto status = [](double a, double b, double c) {
    StructuredLDLT<double> matrix(std::make_shared<const SymmetricPattern>(SymmetricPattern::path(2)));
    matrix.diagonal()[0] = a, matrix.diagonal()[1] = c, matrix.couplings()[0] = b;
    return matrix.factor();
  };
  EXPECT_EQ(status(1, 1, 1), Status::singular);
  EXPECT_EQ(status(0, 1, 0), Status::singular);
  EXPECT_EQ(status(1, 0, 5e-324), Status::singular);
  EXPECT_EQ(status(1, 2, 1), Status::converged);
}

// Without exchanges a small pivot costs digits, and growth() says how many.
TEST(StructuredLDLT, GrowthSaysWhatSmallPivotsCost) {
  const auto pattern = std::make_shared<const SymmetricPattern>(SymmetricPattern::path(2));
  StructuredLDLT<double> matrix(pattern);
  const double small = std::ldexp(1.0, -30);
  // The middle of two rows is the second; the first pivot is the small one.
  matrix.diagonal()[0] = small, matrix.diagonal()[1] = 1.0 / 3, matrix.couplings()[0] = 1;
  ASSERT_EQ(matrix.factor(), Status::converged);
  EXPECT_NEAR(matrix.growth() * small, 2, 1e-6);
  const double b[] = {1.0 / 3, 1.0 / 7};
  double x[2];
  matrix.solve(b, x);
  const double residual = std::abs(x[0] + x[1] / 3 - b[1]), sum = std::abs(x[0]) + std::abs(x[1]);
  const double u = unit_roundoff<double>();
  EXPECT_LE(residual, 16 * u * matrix.growth() * sum);
  // Control: without the factor of growth the bound does not hold.
  EXPECT_GT(residual, 1e5 * u * sum);
}

TEST(StructuredLDLT, NoRowsAreNoTrouble) {
  StructuredLDLT<double> matrix(std::make_shared<const SymmetricPattern>(0, Couplings{}));
  double nothing = 3;
  EXPECT_EQ(matrix.factor(), Status::converged);
  EXPECT_EQ(matrix.factor_semidefinite(), Status::converged);
  EXPECT_EQ(matrix.factor_and_solve(&nothing, &nothing), Status::converged);
  EXPECT_EQ(matrix.growth(), 0);
  EXPECT_EQ(nothing, 3);
}

TEST(StructuredLDLT, ALongChainIsSolvedToRoundOff) {
  const std::size_t rows = 100000;
  const auto pattern = std::make_shared<const SymmetricPattern>(SymmetricPattern::path(rows));
  StructuredLDLT<double> matrix(pattern);
  std::fill_n(matrix.diagonal(), rows, 2.0);
  std::fill_n(matrix.couplings(), rows - 1, -1.0);
  // Second differences: x_k = (k + 1)(rows - k) / 2 for b = 1. Condition 4 rows^2 / pi^2 = 4e9.
  std::vector<double> x(rows, 1.0);
  ASSERT_EQ(matrix.factor_and_solve(x.data(), x.data()), Status::converged);
  for (std::size_t k = 0; k < rows; k += 997) {
    const double expected = static_cast<double>(k + 1) * static_cast<double>(rows - k) / 2;
    EXPECT_NEAR(x[k] / expected, 1, 4e9 * unit_roundoff<double>());
  }
}

}  // namespace
