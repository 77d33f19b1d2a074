// Processed methods: n steps at once take the processor at their ends alone, and end where n single steps do.
#include <gtest/gtest.h>

#include <fstream>

#include <pfaff/core/facets/static_problem.hpp>

#include "method_files.hpp"
#include "processed_samples.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::distance;
using pfaff::testing::ended;
using pfaff::testing::expect_one_map;
using pfaff::testing::pushed_pendulum;
using pfaff::testing::shipped_tables;
using pfaff::testing::TemporaryDirectory;

// A kernel of two drifts and two kicks with a processor that takes time: 0.3 of a step.
constexpr const char* with_times =
    "name = \"with-times\"\nkind = \"processed\"\norder = 1\n"
    "pre = { drift = [0.2, 0.1], kick = [0.7] }\nkernel = { drift = [0.3, 0.7], kick = [0.6, 0.4] }\n";

TEST(Processed, StepsInARowEndWhereSingleStepsDo) {
  const TemporaryDirectory files;
  std::ofstream(files / "with-times.toml") << with_times;
  const auto euler = read_method_table(shipped_tables + "verlet-as-processed-euler.toml"),
             slow = read_method_table(files / "with-times.toml");
  for (const auto* table : {euler.get(), slow.get()}) {
    expect_one_map(*table->make({}), pushed_pendulum(), 1e-31);
    expect_one_map(*table->make({}), systems().get("henon-heiles", "system").make({}), 1e-31);
  }
  for (const char* scheme : {"corrected-3", "corrected-11"})
    expect_one_map(*integrators().get("exact-flow-splitting", "integrator").make({{"scheme", scheme}}),
                   systems().get("henon-heiles", "system").make({}), 1e-31);
}

// The control: where the last flow is not the inverse of the first, the two differ.
TEST(Processed, AProcessorThatIsNotTakenBackShows) {
  const auto model = systems().get("henon-heiles", "system").make({});
  const auto changed = integrators()
                           .get("exact-flow-splitting", "integrator")
                           .make({{"scheme", "corrected-3"}})
                           ->with_changed_coefficient(0, Quad(1e-9));
  const Quad h(0.1);
  EXPECT_GT(distance(ended(*changed, model, 1, 30, h).z, ended(*changed, model, 30, 1, h).z), 1e-10);
}

TEST(Processed, StepsInARowCostWhatTheirKernelDoes) {
  const auto planets = systems().get("outer-solar-system", "system").make({});
  const auto forces = [&](const char* scheme, int calls, int steps) {
    const auto method = integrators().get("exact-flow-splitting", "integrator").make({{"scheme", scheme}});
    return ended(*method, planets, calls, steps, 10.0).forces;
  };
  EXPECT_EQ(forces("strang", 1, 50), 50);
  EXPECT_EQ(forces("corrected-7", 1, 50), 50 + 2 * 6);
  EXPECT_EQ(forces("corrected-7", 5, 10), 50 + 5 * 2 * 6);
  EXPECT_EQ(forces("corrected-7", 50, 1), 50 * 13);

  const auto euler = read_method_table(shipped_tables + "verlet-as-processed-euler.toml");
  const auto pendulum = systems().get("pendulum", "system").make({});
  EXPECT_EQ(ended(*euler->make({}), pendulum, 1, 100, 0.1).forces, 100 + 2);
  EXPECT_EQ(ended(*euler->make({}), pendulum, 100, 1, 0.1).forces, 300);
}

TEST(Processed, OtherMethodsAreNot) {
  EXPECT_FALSE(integrators().get("verlet", "integrator").make({})->processed());
  EXPECT_FALSE(integrators().get("exact-flow-splitting", "integrator").make({})->processed());
  EXPECT_FALSE(read_method_table(shipped_tables + "pefrl.toml")->make({})->processed());
  EXPECT_TRUE(read_method_table(shipped_tables + "verlet-as-processed-euler.toml")->make({})->processed());
}

// z' = 1 in units of the step, moved to and fro by a processor of length 100; each part fails where it is
// told to.
struct Stumbling {
  bool before = false, after = false;
  double kernel_stops_at = 1e9;
  [[nodiscard]] bool processed() const { return true; }
  template <class P>
  struct Work {
    State<P> carry;
    Work(const Stumbling& /*method*/, const P& p) : carry(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    Status status = preprocess(p, t, h, z, w);
    if (status == Status::converged) status = kernel(p, t, h, z, w);
    return status == Status::converged ? postprocess(p, t + h, h, z, w) : status;
  }
  template <HasVectorField P>
  Status preprocess(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& z,
                    Work<P>& w) const {
    if (before) return Status::singular;
    z[0] += 100;
    w.carry[0] += 1;
    return Status::converged;
  }
  template <HasVectorField P>
  Status kernel(const P& /*p*/, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& /*w*/) const {
    if (t >= kernel_stops_at) return Status::not_converged;
    z[0] += h;
    return Status::converged;
  }
  template <HasVectorField P>
  Status postprocess(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& /*h*/, State<P>& z,
                     Work<P>& /*w*/) const {
    if (after) return Status::non_finite;
    z[0] -= 100;
    return Status::converged;
  }
};
struct Still {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> f) const {
    f[0] = f[1] = T(0);
  }
};

TEST(Processed, WhatDoesNotConvergeLeavesTheStateOfTheStepsBefore) {
  struct Row {
    Stumbling method;
    Status status;
    std::int64_t completed;
    double z;
  };
  using P = StaticProblem<Still>;
  const P problem;
  for (const Row& row : {Row{{}, Status::converged, 8, 12}, Row{{.before = true}, Status::singular, 0, 4},
                         Row{{.kernel_stops_at = 5}, Status::not_converged, 5, 9},
                         Row{{.kernel_stops_at = 0}, Status::not_converged, 0, 4},
                         Row{{.after = true}, Status::non_finite, 0, 4}}) {
    Work<Stumbling, P> work(row.method, problem);
    State<P> z = problem.make_state();
    z[0] = 4;
    work.carry[0] = 0.5;
    std::int64_t completed = -1;
    EXPECT_EQ(advance(row.method, problem, 0.0, 0, 1.0, 8, z, work, completed), row.status);
    EXPECT_EQ(completed, row.completed);
    EXPECT_EQ(z[0], row.z);
    EXPECT_EQ(work.carry[0], row.completed == 0 ? 0.5 : 1.5);
  }
}

}  // namespace
