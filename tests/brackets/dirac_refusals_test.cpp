// Refusals with a named reason: Dirac brackets that seem to exist only because of rounding, and solvers used
// on matrices that they are not for.
#include <gtest/gtest.h>

#include <pfaff/brackets/canonical.hpp>
#include <pfaff/brackets/dirac/dirac.hpp>
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

// Quadrics on R^8 in general position: every bracket of two is a sum with rounding. The last one may be made
// a combination of the first two.
struct Quadrics {
  std::size_t used = 4;
  bool dependent = false;
  [[nodiscard]] std::size_t count() const { return used; }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {
    for (std::size_t i = 0; i < used; ++i) {
      phi[i] = T(0);
      for (std::size_t a = 0; a < z.size(); ++a) {
        const T square =
            T(static_cast<int>((7 * i * i + 3 * a + 5 * a * i * i + i * a * a) % 11) - 4) / T(10);
        const T linear = T(static_cast<int>((5 * i + 2 * a * a + i * a) % 7) - 2) / T(3);
        phi[i] = phi[i] + (square * z[a] + linear) * z[a];
      }
    }
    if (dependent) phi[used - 1] = phi[0] / T(3) - phi[1] / T(7);
  }
};

template <class T>
std::vector<T> regular_point() {
  std::vector<T> z;
  for (const int k : {31, 47, -83, 29, 61, -13, 70, 90}) z.push_back(T(k) / T(100));
  return z;
}

// "accepted", or why not.
template <class T, class Solver>
std::string reason(const Quadrics& constraints, const Solver& solver, Symmetry symmetry = Symmetry::skew) {
  const std::vector<T> z = regular_point<T>(), covector(8, T(1));
  std::vector<T> out(8);
  try {
    dirac(CanonicalBracket{}, constraints, solver, symmetry)
        .sharp(T(0), In<T>(z), In<T>(covector), Out<T>(out));
  } catch (const NoDiracBracket& error) {
    return error.what();
  }
  return "accepted";
}

template <class T, class Solver>
void check_rounding(const Solver& solver) {
  EXPECT_EQ((reason<T>(Quadrics{4}, solver)), "accepted") << Solver::name;
  for (const std::size_t odd : {std::size_t{1}, std::size_t{3}, std::size_t{5}})
    EXPECT_NE((reason<T>(Quadrics{odd}, solver)).find("is first class"), std::string::npos)
        << Solver::name << " K = " << odd << ": " << reason<T>(Quadrics{odd}, solver);
  EXPECT_NE((reason<T>(Quadrics{4, true}, solver)).find("phi4 is redundant"), std::string::npos)
      << Solver::name << ": " << reason<T>(Quadrics{4, true}, solver);
}
TEST(DiracRefusals, PivotsMadeOfRounding) {
  check_rounding<double>(DenseDirac{});
  check_rounding<double>(RecursiveVectorsDirac{});
  check_rounding<double>(RecursiveTensorDirac{});
  check_rounding<double>(RecursiveLiteralDirac{});
  check_rounding<double>(BorderedDirac{});
  check_rounding<double>(PfaffianDirac{});
  check_rounding<Quad>(DenseDirac{});
  check_rounding<Quad>(RecursiveVectorsDirac{});
}

TEST(DiracRefusals, EvaluatorsOfOddNumbersAreSingular) {
  const std::vector<double> z = regular_point<double>(), covector(8, 1.0);
  std::vector<double> out(8);
  const auto status = [&](std::size_t count) {
    const auto bracket = dirac(CanonicalBracket{}, Quadrics{count});
    DiracEvaluator<double, std::decay_t<decltype(bracket)>> evaluate(bracket, 8);
    return evaluate(0.0, z, covector, out);
  };
  EXPECT_EQ(status(3), Status::singular);
  EXPECT_EQ(status(4), Status::converged);
}

TEST(DiracRefusals, OddNumbersAreNotRecorded) {
  const auto recorded = [](std::size_t count) {
    const auto bracket = dirac(CanonicalBracket{}, Quadrics{count});
    return sharp_tape(bracket, 8);
  };
  EXPECT_THROW((void)recorded(3), NoDiracBracket);
  EXPECT_NO_THROW((void)recorded(4));
}

TEST(DiracRefusals, SolversOnWhatTheyAreNotFor) {
  const auto refused = [](const std::string& text, const std::string& name) {
    return text.find(name + ": not a solver for the brackets of these constraints") == 0;
  };
  EXPECT_TRUE(refused(reason<double>(Quadrics{4}, HolonomicDirac{}), "holonomic-blocks"));
  EXPECT_TRUE(refused(reason<Quad>(Quadrics{4}, HolonomicDirac{}), "holonomic-blocks"));
  EXPECT_TRUE(refused(reason<double>(Quadrics{4}, StructuredDirac{}), "structured"));  // no pattern
  EXPECT_TRUE(refused(reason<double>(Quadrics{4}, SkewForestDirac{{{0, 1}, {2, 3}}}), "skew-forest"));
}

}  // namespace
