// dirac(base, constraints, solver) used as a bracket: reference values, gradients written by hand and
// derived, recording on tapes, Dirac brackets of Dirac brackets, named reasons where there is none, and
// evaluation without allocation.
#include <gtest/gtest.h>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/dirac/dirac.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../counted_allocations.hpp"
#include "golden_brackets.hpp"
#include "random_gram.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::as;
using pfaff::testing::golden_brackets;

// The constraints of the reference values on R^6: a sphere, a surface, and their rates under H.
struct SphereAndSurface {
  std::size_t used = 4;
  [[nodiscard]] std::size_t count() const { return used; }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {
    phi[0] = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - T(1)) / T(2);
    phi[1] = z[0] * z[3] + T(2) * z[1] * z[4] + z[2] * z[5] / T(2);
    if (used < 4) return;
    phi[2] = z[0] - z[1] * z[2];
    phi[3] = z[3] - T(2) * z[2] * z[4] - z[1] * z[5] / T(2);
  }
};
template <class T>
std::vector<T> hamiltonian_gradient(In<T> z) {
  return {z[1], z[0], T(0), z[3], T(2) * z[4], z[5] / T(2)};
}
template <class T>
std::vector<T> golden_point() {
  std::vector<T> z;
  for (const char* x : {"1/3", "1/2", "2/3", "1/5", "-1/4", "3/7"}) z.push_back(T(*Real::parse(x)));
  return z;
}

// The field at one level of the recursion: elements 5 .. 10 are the coordinates, element 4 is H.
template <class Solver>
void check_golden(const Solver& solver) {
  const nlohmann::json levels = golden_brackets().at("skew_canonical_R6").at("levels");
  for (const std::size_t level : {std::size_t{1}, std::size_t{2}}) {
    const auto bracket = dirac(CanonicalBracket{}, SphereAndSurface{2 * level}, solver);
    const auto exact = golden_point<Rational>();
    std::vector<Rational> field(6);
    bracket.sharp(Rational(0), In<Rational>(exact), In<Rational>(hamiltonian_gradient<Rational>(exact)),
                  Out<Rational>(field));
    const auto point = golden_point<double>();
    std::vector<double> rounded(6);
    bracket.sharp(0.0, In<double>(point), In<double>(hamiltonian_gradient<double>(point)),
                  Out<double>(rounded));
    for (std::size_t a = 0; a < 6; ++a) {
      const Rational expected(*Real::parse(levels[level][5 + a][4].get<std::string>()));
      EXPECT_EQ(field[a], expected) << Solver::name << " level " << level << " coordinate " << a;
      EXPECT_NEAR(rounded[a], static_cast<double>(expected), 1e-13) << Solver::name;  // terms of order 10
    }
  }
}
TEST(DiracBracket, ReferenceFieldByEverySolver) {
  check_golden(DenseDirac{});
  check_golden(RecursiveVectorsDirac{});
  check_golden(RecursiveTensorDirac{});
  check_golden(RecursiveLiteralDirac{});
  check_golden(BorderedDirac{});
  check_golden(PfaffianDirac{});
  check_golden(HolonomicDirac{});
}

// Two Dirac brackets, one on the other, are the Dirac bracket of all constraints (Theorem 2).
struct Second {
  [[nodiscard]] std::size_t count() const { return 2; }
  template <class T>
  void values(const T& t, In<T> z, Out<T> phi) const {
    std::vector<T> all(4);
    SphereAndSurface{}.values(t, z, Out<T>(all));
    phi[0] = all[2];
    phi[1] = all[3];
  }
};
TEST(DiracBracket, OfADiracBracket) {
  const auto whole = dirac(CanonicalBracket{}, SphereAndSurface{});
  const auto nested = dirac(dirac(CanonicalBracket{}, SphereAndSurface{2}), Second{});
  const auto z = golden_point<Rational>();
  const auto covector = hamiltonian_gradient<Rational>(z);
  std::vector<Rational> a(6), b(6);
  whole.sharp(Rational(0), In<Rational>(z), In<Rational>(covector), Out<Rational>(a));
  nested.sharp(Rational(0), In<Rational>(z), In<Rational>(covector), Out<Rational>(b));
  EXPECT_EQ(a, b);
}

// Every solver is recorded; the tape, replayed elsewhere, is the bracket there.
template <class Solver>
void check_tape(const Solver& solver) {
  const auto bracket = dirac(CanonicalBracket{}, SphereAndSurface{}, solver);
  const auto tape = std::make_shared<const Tape>(
      record(12, 6, [&](const Recorded& t, std::span<const Recorded> x, std::span<Recorded> out) {
        bracket.sharp(t, x.first(6), x.subspan(6), out);
      }));
  const std::vector<double> z{0.4, 0.3, 0.8, -0.2, 0.6, 0.1}, covector{1, -2, 0.5, 3, 0.25, -1};
  std::vector<double> x = z, replayed(6), direct(6);
  x.insert(x.end(), covector.begin(), covector.end());
  Replay<double> replay(tape);
  replay(0.0, x.data(), replayed.data());
  bracket.sharp(0.0, In<double>(z), In<double>(covector), Out<double>(direct));
  std::vector<Quad> exact_z, exact_covector, exact(6), exact_x, exact_replayed(6);
  for (const double v : z) exact_z.emplace_back(v);
  for (const double v : covector) exact_covector.emplace_back(v);
  exact_x = exact_z;
  exact_x.insert(exact_x.end(), exact_covector.begin(), exact_covector.end());
  Replay<Quad> exact_replay(tape);
  exact_replay(Quad(0), exact_x.data(), exact_replayed.data());
  bracket.sharp(Quad(0), In<Quad>(exact_z), In<Quad>(exact_covector), Out<Quad>(exact));
  for (std::size_t a = 0; a < 6; ++a) {
    EXPECT_NEAR(replayed[a], direct[a], 1e-13) << Solver::name;  // terms of order 10, cond(W) below 100
    EXPECT_LT(abs(exact_replayed[a] - exact[a]), Quad(1e-31)) << Solver::name;
    EXPECT_NEAR(direct[a], static_cast<double>(exact[a]), 1e-13) << Solver::name;
  }
}
TEST(DiracBracket, EverySolverIsRecorded) {
  check_tape(DenseDirac{});
  check_tape(RecursiveVectorsDirac{});
  check_tape(RecursiveTensorDirac{});
  check_tape(RecursiveLiteralDirac{});
  check_tape(BorderedDirac{});
  check_tape(PfaffianDirac{});
  check_tape(HolonomicDirac{});
  check_tape(RecursiveVectorsDirac{{{{2, 3}, {2, 3}}, {{0, 1}, {0, 1}}}});
}

// A chain of constraints of a symmetric bracket, and of the canonical one in pairs: W is tridiagonal.
struct Chain {
  std::size_t links = 4;
  bool pairs = false;
  [[nodiscard]] std::size_t count() const { return links; }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {
    // In pairs {phi1, phi2} = 1, {phi2, phi3} = -z1, {phi3, phi4} = 1, and no others.
    for (std::size_t k = 0; k < links; ++k) {
      if (!pairs) phi[k] = z[k] * z[k] / T(2) - z[k + 1];
    }
    if (!pairs) return;
    phi[0] = z[0];
    phi[1] = z[3] + z[1] * z[1] / T(2);
    phi[2] = z[4];
    phi[3] = -z[1] + z[2];
  }
};
struct UnitMetric {
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    for (std::size_t k = 0; k < vector.size(); ++k) vector[k] = covector[k];
  }
};
template <class Bracket>
void expect_dense_values(const Bracket& structured, std::span<const double> dense,
                         const std::vector<double>& z, const std::vector<double>& covector) {
  std::vector<double> direct(z.size()), replayed(z.size()), x = z;
  structured.sharp(0.0, In<double>(z), In<double>(covector), Out<double>(direct));
  const auto n = static_cast<int>(z.size());
  const auto tape = std::make_shared<const Tape>(
      record(2 * n, n, [&](const Recorded& t, std::span<const Recorded> in, std::span<Recorded> out) {
        structured.sharp(t, in.first(z.size()), in.subspan(z.size()), out);
      }));
  x.insert(x.end(), covector.begin(), covector.end());
  Replay<double> replay(tape);
  replay(0.0, x.data(), replayed.data());
  DiracEvaluator<double, Bracket> evaluate(structured, z.size());
  (void)evaluate(0.0, z, covector, direct);
  EXPECT_EQ(pfaff::testing::allocations_of([&] { (void)evaluate(0.0, z, covector, direct); }), 0);
  for (std::size_t a = 0; a < z.size(); ++a) {
    EXPECT_NEAR(direct[a], dense[a], 1e-14);  // numbers of order 1, cond(W) below 10
    EXPECT_NEAR(replayed[a], dense[a], 1e-14);
  }
}
TEST(DiracBracket, StructuredSolversAreRecordedAndDoNotAllocate) {
  const std::vector<double> z{0.4, 0.3, 0.8, -0.2, 0.6, 0.1}, covector{1, -2, 0.5, 3, 0.25, -1};
  std::vector<double> dense(6);
  dirac(UnitMetric{}, Chain{}, DenseDirac{}, Symmetry::symmetric)
      .sharp(0.0, In<double>(z), In<double>(covector), Out<double>(dense));
  const auto line =
      dirac(UnitMetric{}, Chain{},
            StructuredDirac{std::make_shared<const SymmetricPattern>(SymmetricPattern::path(4))},
            Symmetry::symmetric);
  expect_dense_values(line, dense, z, covector);
  dirac(CanonicalBracket{}, Chain{4, true})
      .sharp(0.0, In<double>(z), In<double>(covector), Out<double>(dense));
  const auto skew = dirac(CanonicalBracket{}, Chain{4, true}, SkewForestDirac{{{0, 1}, {1, 2}, {2, 3}}});
  expect_dense_values(skew, dense, z, covector);
}

// An order chosen where its pivots are good breaks down elsewhere: the classification says so, and the tape
// is recorded anew with the order of the new point.
struct TurningPairs {
  [[nodiscard]] std::size_t count() const { return 4; }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {  // {phi1, phi2} = z0, Pf W = z0 + 1
    phi[0] = z[0] * z[0] / T(2) + z[1];
    phi[1] = z[3];
    phi[2] = z[4] + z[2];
    phi[3] = z[5] + z[0];
  }
};
TEST(DiracBracket, OrdersAreChosenAtAPoint) {
  const TurningPairs constraints;
  const auto bracket = dirac(CanonicalBracket{}, constraints);
  const std::vector<double> here{1, 0.5, 0.25, 0.5, 0.25, 0.5}, there{0, 0.5, 0.25, 0.5, 0.25, 0.5};
  const auto chosen = bracket.classes(0.0, In<double>(here));
  ASSERT_TRUE(chosen.regular());
  const std::vector<double> covector{1, 2, 3, 4, 5, 6};
  const auto with_order = [&](const EliminationOrder& order, const std::vector<double>& z, Status& status) {
    const auto recursive = dirac(CanonicalBracket{}, constraints, RecursiveVectorsDirac{order});
    DiracEvaluator<double, decltype(recursive)> evaluate(recursive, 6);
    std::vector<double> result(6);
    status = evaluate(0.0, z, covector, result);
    return result;
  };
  Status status{};
  // {phi1, phi2} = z0 vanishes there: the plain order breaks down, the order of that point does not.
  (void)with_order({}, there, status);
  EXPECT_EQ(status, Status::singular);
  const auto anew = bracket.classes(0.0, In<double>(there));
  const std::vector<double> result = with_order(pivoted_order(anew), there, status);
  EXPECT_EQ(status, Status::converged);
  std::vector<double> dense(6);
  bracket.sharp(0.0, In<double>(there), In<double>(covector), Out<double>(dense));
  for (std::size_t a = 0; a < 6; ++a) EXPECT_NEAR(result[a], dense[a], 1e-14);
}

// Gradients written by hand are used, and refused where they are not the derivatives.
struct ByHand : SphereAndSurface {
  int wrong = 0;
  template <class T>
  void gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    for (T& x : rows) x = T(0);
    for (std::size_t a = 0; a < 3; ++a) rows[a] = z[a];
    rows[6] = z[3];
    rows[7] = T(2) * z[4];
    rows[8] = z[5] / T(2);
    rows[9] = z[0];
    rows[10] = T(2) * z[1];
    rows[11] = z[2] / T(2 + wrong);
    rows[12] = T(1);
    rows[13] = -z[2];
    rows[14] = -z[1];
    rows[19] = -z[5] / T(2);
    rows[20] = T(-2) * z[4];
    rows[21] = T(1);
    rows[22] = T(-2) * z[2];
    rows[23] = -z[1] / T(2);
  }
};
TEST(DiracBracket, GradientsByHand) {
  const auto z = golden_point<double>();
  const std::vector<std::string> names{"sphere", "sphere~", "surface", "surface~"};
  EXPECT_NO_THROW(check_gradients(ByHand{}, 0.0, z, names));
  ByHand wrong;
  wrong.wrong = 1;
  try {
    check_gradients(wrong, 0.0, z, names);
    FAIL() << "a wrong gradient was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("constraint sphere~: the gradient written for coordinate 6"),
              std::string::npos)
        << error.what();
  }
  const std::vector<double> covector{1, -2, 0.5, 3, 0.25, -1};
  std::vector<double> a(6), b(6);
  dirac(CanonicalBracket{}, ByHand{}).sharp(0.0, In<double>(z), In<double>(covector), Out<double>(a));
  dirac(CanonicalBracket{}, SphereAndSurface{})
      .sharp(0.0, In<double>(z), In<double>(covector), Out<double>(b));
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

// Where there is no bracket the reason is given by name: an odd number, dependent constraints, first class.
struct Named {
  std::vector<int> which;
  [[nodiscard]] std::size_t count() const { return which.size(); }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const int k : which)
      list.push_back(k == 0 ? "position" : k == 1 ? "momentum" : k == 2 ? "twice" : "other");
    return list;
  }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {
    for (std::size_t i = 0; i < which.size(); ++i)
      phi[i] = which[i] == 0 ? z[0] : which[i] == 1 ? z[2] : which[i] == 2 ? T(2) * z[0] : z[1];
  }
};
std::string why_not(const std::vector<int>& which) {
  const std::vector<double> z{0.1, 0.2, 0.3, 0.4}, covector{1, 2, 3, 4};
  std::vector<double> out(4);
  try {
    dirac(CanonicalBracket{}, Named{which}).sharp(0.0, In<double>(z), In<double>(covector), Out<double>(out));
  } catch (const NoDiracBracket& error) {
    return error.what();
  }
  return "accepted";
}
TEST(DiracBracket, SaysWhyThereIsNone) {
  EXPECT_EQ(why_not({0, 1}), "accepted");
  EXPECT_NE(why_not({0}).find("position"), std::string::npos) << why_not({0});
  EXPECT_NE(why_not({0, 1, 3}).find("other"), std::string::npos) << why_not({0, 1, 3});
  EXPECT_NE(why_not({0, 1, 3}).find("first class"), std::string::npos) << why_not({0, 1, 3});
  EXPECT_NE(why_not({0, 1, 2, 3}).find("redundant"), std::string::npos) << why_not({0, 1, 2, 3});
}

template <class Solver>
long allocations_by(const Solver& solver) {
  const auto bracket = dirac(CanonicalBracket{}, SphereAndSurface{}, solver);
  DiracEvaluator<double, std::decay_t<decltype(bracket)>> evaluate(bracket, 6);
  const auto z = golden_point<double>(), covector = hamiltonian_gradient<double>(z);
  std::vector<double> out(6);
  (void)evaluate(0.0, z, covector, out);
  return pfaff::testing::allocations_of([&] {
    for (int k = 0; k < 10; ++k) (void)evaluate(0.0, z, covector, out);
  });
}
TEST(DiracBracket, EvaluatesWithoutAllocation) {
  EXPECT_EQ(allocations_by(DenseDirac{}), 0);
  EXPECT_EQ(allocations_by(RecursiveVectorsDirac{}), 0);
  EXPECT_EQ(allocations_by(RecursiveTensorDirac{}), 0);
  EXPECT_EQ(allocations_by(HolonomicDirac{}), 0);
  EXPECT_GT(allocations_by(RecursiveLiteralDirac{}), 0);  // the counter counts
}

}  // namespace
