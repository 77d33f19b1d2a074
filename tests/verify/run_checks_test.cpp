// Claims along runs: methods that lose them late, in some steps or at large steps, and one that does not.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/verify/check.hpp>

namespace {
using namespace pfaff;

// The midpoint rule by so many sweeps, in whose `faulty`-th step and its multiples something is left out.
// Where it is `lopsided`, a step from a negative position goes too far, and so keeps neither of its claims.
struct Midpoint {
  int faulty = 0, sweeps = 200;
  bool lopsided = false;
  template <class P>
  struct Work {
    State<P> middle, slope;
    int steps = 0;
    Work(const Midpoint& /*method*/, const P& p) : middle(p.make_state()), slope(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const Scalar<P> half = h / Scalar<P>(2);
    for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = z[k];
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      p.field(t + half, w.middle, w.slope);
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = z[k] + half * w.slope[k];
    }
    ++w.steps;
    const bool fault =
        (faulty > 0 && w.steps % faulty == 0) || (lopsided && value_of(z[0]) < Value<Scalar<P>>(0));
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = z[k] + (fault ? Scalar<P>(1.000001) : Scalar<P>(1)) * h * w.slope[k];
    return Status::converged;
  }
};

template <int every, int count, bool on_one_side = false>
struct Faulty : Midpoint {
  Faulty() : Midpoint{every, count, on_one_side} {}
};

template <class M>
std::vector<std::string> failures(const char* name) {
  static const Method<M> method{{.name = name,
                                 .title = "",
                                 .reference = "",
                                 .order = 2,
                                 .preserves = {Claim::symplectic, Claim::symmetric}}};
  std::vector<std::string> failed;
  for (const Check& check : check_method(method, {}, systems().get("pendulum", "system")))
    if (!good(check)) failed.push_back(check.claim + ": " + check.reason);
  return failed;
}

TEST(ClaimsAlongRuns, HoldForASoundMethod) {
  EXPECT_EQ(failures<Midpoint>("midpoint-by-sweeps"), std::vector<std::string>());
}

TEST(ClaimsAlongRuns, AStepThatIsWrongNowAndThenIsFound) {
  const auto failed = failures<Faulty<97, 200>>("midpoint-wrong-in-every-97th-step");
  ASSERT_FALSE(failed.empty());
  EXPECT_EQ(failed.front(), "steps of a run: step 97 of a run is another than the same step by itself");
}

// The fifth step of a run is another one than by itself. That the claims are lost where the position is
// negative, into which the motion swings later, is found all the same, at the usual step and at longer ones.
TEST(ClaimsAlongRuns, AStepThatDiffersDoesNotEndTheSearchForLostClaims) {
  const auto failed = failures<Faulty<5, 200, true>>("midpoint-wrong-on-one-side");
  ASSERT_FALSE(failed.empty());
  const auto found = [&](bool at_longer_steps) {
    return std::any_of(failed.begin(), failed.end(), [&](const std::string& claim) {
      return claim.starts_with("symplectic along a run: lost in step ") &&
             (claim.find(", of size ") != std::string::npos) == at_longer_steps;
    });
  };
  EXPECT_TRUE(found(false));
  EXPECT_TRUE(found(true));
}

TEST(ClaimsAlongRuns, AnIterationThatIsCutOffIsFoundAtLargeSteps) {
  const auto failed = failures<Faulty<0, 24>>("midpoint-of-24-sweeps");
  ASSERT_FALSE(failed.empty());
  for (const std::string& claim : failed)
    EXPECT_TRUE(claim.find("in a large step") != std::string::npos ||
                claim.find(", of size ") != std::string::npos)
        << claim;
}

}  // namespace
