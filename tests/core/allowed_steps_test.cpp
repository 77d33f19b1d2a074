// A loop of steps that its budget ends stops between two of them, and leaves the state that it has reached:
// bit by bit that of a loop which nobody disturbs.
#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

template <class T>
struct Reached {
  std::vector<T> z;
  std::int64_t completed = -1;
  bool ended = false;  // by its budget
};

struct Pair {
  std::string method, system;
  Assignments set;
};

// So many steps, from the initial state, by one call.
template <class T>
Reached<T> stepped(const Pair& pair, std::int64_t count) {
  const auto model = systems().get(pair.system, "system").make({});
  const auto stepper = integrators().get(pair.method, "integrator").make(pair.set)->stepper(model, T());
  Reached<T> reached;
  for (const Real& x : model->initial()) reached.z.push_back(T(x));
  try {
    EXPECT_EQ(stepper->advance(T(0), 0, T(Real::fraction(1, 50)), count, reached.z, reached.completed),
              Status::converged);
  } catch (const BudgetSpent&) {
    reached.ended = true;
  }
  EXPECT_EQ(stepper->counters().steps, reached.completed);
  return reached;
}

// Methods of every kind of loop: explicit and implicit, compensated, in small and in large dimensions, and
// processed ones, whose processor is taken at both ends of a loop.
const std::array pairs{Pair{"verlet", "pendulum", {}}, Pair{"rk4", "n-pendulum-angles", {}},
                       Pair{"gauss", "henon-heiles", {}}, Pair{"rattle", "spherical-pendulum", {}},
                       Pair{"exact-flow-splitting", "henon-heiles", {{"scheme", "corrected-3"}}}};

template <class T>
void expect_the_state_reached(std::initializer_list<std::int64_t> limits) {
  for (const Pair& pair : pairs)
    for (const std::int64_t limit : limits) {
      SCOPED_TRACE(pair.method + " on " + pair.system + ", " + std::to_string(limit) + " steps");
      const Reached<T> whole = stepped<T>(pair, limit);
      EXPECT_FALSE(whole.ended);
      Budget budget({.steps = limit});
      const Reached<T> part = stepped<T>(pair, limit + 1000);
      EXPECT_TRUE(part.ended);
      EXPECT_EQ(part.completed, limit);
      EXPECT_EQ(budget.steps(), limit);
      EXPECT_EQ(part.z, whole.z);
    }
}

// A loop on a pair of doubles asks once for 128 steps.
TEST(AllowedSteps, EndInTheStateReached) {
  expect_the_state_reached<double>({1, 7, 127, 128, 129, 300});
  expect_the_state_reached<Quad>({1, 7});
}

TEST(AllowedSteps, CountTheEvaluationsOfTheProblem) {
  const Pair pair{"rk4", "pendulum", {}};
  Budget whole({});
  EXPECT_EQ(stepped<Quad>(pair, 40).completed, 40);
  EXPECT_EQ(whole.evaluations(), 160);
  const Budget evaluations({.evaluations = 100});
  EXPECT_EQ(stepped<Quad>(pair, 1000).completed, 26);  // before step 27 there are 104 of them
}

// z' = 1 by Euler's rule, which raises a flag in its tenth step.
struct Clock {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> rate) const {
    rate[0] = T(1);
  }
};
struct Flagging {
  std::atomic<bool>* flag = nullptr;
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z) const {
    State<P> rate = p.make_state();
    p.field(t, z, rate);
    z[0] = z[0] + h * rate[0];
    if (z[0] == Scalar<P>(10)) *flag = true;
    return Status::converged;
  }
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*w*/) const {
    return step(p, t, h, z);
  }
};
template <class T>
std::int64_t steps_up_to_the_flag() {
  const auto model = make_model({.name = "clock", .title = "", .reference = "", .initial = {0}}, Clock());
  const Problem<T> problem(model);
  std::atomic<bool> flag{false};
  const Budget budget({}, &flag);
  const Flagging method{&flag};
  auto z = problem.make_state();
  NoWork work(method, problem);
  std::int64_t completed = -1;
  EXPECT_THROW((void)advance(method, problem, T(0), 0, T(1), 100000, z, work, completed), BudgetSpent);
  EXPECT_TRUE(z[0] == T(static_cast<double>(completed)));
  return completed;
}

// In quad after the very step; in double after those that were asked for at once.
TEST(AllowedSteps, EndWhereTheyAreAskedToStop) {
  EXPECT_EQ(steps_up_to_the_flag<Quad>(), 10);
  EXPECT_EQ(steps_up_to_the_flag<double>(), 256);
}

// A step that moves the state and is told to end before it is done.
struct Interrupted {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*w*/) const {
    z[0] = z[0] + h;
    if (t >= Scalar<P>(2)) {
      State<P> rate = p.make_state();
      p.field(t, z, rate);
      spend(0, 1000);
    }
    return Status::converged;
  }
};
TEST(AllowedSteps, AnEndWithinAStepLeavesTheStateBeforeTheCall) {
  const auto model = make_model({.name = "clock", .title = "", .reference = "", .initial = {0}}, Clock());
  detail::SteppingOn<Interrupted, Problem<double>> stepper(Interrupted(), model);
  const Budget budget({.evaluations = 100});
  std::vector<double> z{0};
  std::int64_t completed = -1;
  EXPECT_EQ(stepper.advance(0, 0, 1, 2, z, completed), Status::converged);
  EXPECT_EQ(completed, 2);
  EXPECT_THROW((void)stepper.advance(0, 2, 1, 5, z, completed), BudgetSpent);
  EXPECT_EQ(completed, 0);
  EXPECT_EQ(z[0], 2);
}

}  // namespace
