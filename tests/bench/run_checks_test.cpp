// Claims along runs: methods that lose them late, in some steps or at large steps, and one that does not.
#include <gtest/gtest.h>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// The midpoint rule by so many sweeps, in whose `faulty`-th step and its multiples something is left out.
struct Midpoint {
  int faulty = 0, sweeps = 200;
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
    const bool fault = faulty > 0 && w.steps % faulty == 0;
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = z[k] + (fault ? Scalar<P>(1.000001) : Scalar<P>(1)) * h * w.slope[k];
    return Status::converged;
  }
};

template <int every, int count>
struct Faulty : Midpoint {
  Faulty() : Midpoint{every, count} {}
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

TEST(ClaimsAlongRuns, AnIterationThatIsCutOffIsFoundAtLargeSteps) {
  const auto failed = failures<Faulty<0, 24>>("midpoint-of-24-sweeps");
  ASSERT_FALSE(failed.empty());
  for (const std::string& claim : failed)
    EXPECT_TRUE(claim.find("in a large step") != std::string::npos ||
                claim.find(", of size ") != std::string::npos)
        << claim;
}

}  // namespace
