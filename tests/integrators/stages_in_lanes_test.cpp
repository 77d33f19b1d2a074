// Collocation on the registered path evaluates its stages side by side: the same bits as one after the other,
// as many evaluations counted, none anywhere but at a stage.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/support/in_chart.hpp>
#include <pfaff/systems/canonical/harmonic_oscillator.hpp>
#include <pfaff/systems/canonical/kepler.hpp>
#include <pfaff/systems/canonical/pendulum.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {
namespace {

// A registered problem that has to be asked for one stage after the other.
class StageAfterStage : public ProblemView<Problem<double>> {
 public:
  using ProblemView::ProblemView;
  void prepare(Formula formula) const { problem().prepare(formula); }
  void field(double t, In<double> z, Out<double> rate) const { problem().field(t, z, rate); }
  void field_jacobian(double t, In<double> z, Out<double> m) const { problem().field_jacobian(t, z, m); }
  void force(double t, In<double> q, Out<double> f) const { problem().force(t, q, f); }
  void velocity(double t, In<double> p, Out<double> v) const { problem().velocity(t, p, v); }
  void chart(double t, In<double> z, Out<double> y) const { problem().chart(t, z, y); }
  void chart_inverse(double t, In<double> y, Out<double> z) const { problem().chart_inverse(t, y, z); }
  void chart_field(double t, In<double> y, Out<double> rate) const { problem().chart_field(t, y, rate); }
  void chart_field_jacobian(double t, In<double> y, Out<double> m) const {
    problem().chart_field_jacobian(t, y, m);
  }
  [[nodiscard]] std::shared_ptr<const Tape> chart_field_tape() const { return problem().chart_field_tape(); }
  [[nodiscard]] std::shared_ptr<const Tape> field_tape() const { return problem().field_tape(); }
  [[nodiscard]] std::shared_ptr<const Tape> velocity_tape() const { return separable_velocity(problem()); }
};

struct LanesRun {
  std::vector<double> z;
  std::int64_t fields = 0, iterations = 0;
  friend bool operator==(const LanesRun&, const LanesRun&) = default;
};
std::ostream& operator<<(std::ostream& out, const LanesRun& run) {
  out << run.fields << " right-hand sides, " << run.iterations << " iterations:";
  for (const double x : run.z) out << ' ' << std::hexfloat << x;
  return out;
}

std::vector<double> start_of(const Model& model) {
  std::vector<double> z;
  for (const Real& x : model.initial()) z.push_back(x.value());
  return z;
}

template <class M>
LanesRun run_after_another(const std::shared_ptr<const Model>& model, int stages, double h, int steps) {
  M method;
  method.stages = stages;
  method.validate();
  const Problem<double> problem(model);
  const StageAfterStage view(problem);
  Work<M, StageAfterStage> work(method, view);
  auto z = problem.make_state();
  const std::vector<double> start = start_of(*model);
  std::copy(start.begin(), start.end(), z.begin());
  std::int64_t completed = 0;
  EXPECT_EQ(advance(method, view, 0.0, 0, h, steps, z, work, completed), Status::converged) << model->name();
  return {{z.begin(), z.end()}, problem.counters().fields, problem.counters().iterations};
}

LanesRun run_in_lanes(const std::string& method, const std::shared_ptr<const Model>& model, int stages,
                      double h, int steps) {
  const auto stepper =
      integrators().get(method, "").make({{"stages", std::to_string(stages)}})->stepper(model, 0.0);
  LanesRun run{start_of(*model), 0, 0};
  std::int64_t completed = 0;
  EXPECT_EQ(stepper->advance(0.0, 0, h, steps, run.z, completed), Status::converged) << model->name();
  run.fields = stepper->counters().fields;
  run.iterations = stepper->counters().iterations;
  return run;
}

bool offers_lanes(const std::shared_ptr<const Model>& model, Formula formula) {
  return make_evaluator_in_lanes<4>(model, formula).call != nullptr &&
         make_evaluator_in_lanes<8>(model, formula).call != nullptr;
}

std::shared_ptr<const Model> text_model(const std::string& name) {
  return system_named(std::string(PFAFF_GOLDEN) + "/../../examples/models/" + name + ".toml").make({});
}

// Numbers of stages that fill their packs and that do not, known to the compiler and not.
constexpr std::array stage_numbers{1, 2, 3, 4, 5, 6, 8, 9};

struct Driven : Pendulum {  // stages have times of their own
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const {
    Pendulum::force(t, q, f);
    f[0] = f[0] + cos(2 * t) / 3;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return Pendulum::potential(t, q) - q[0] * cos(2 * t) / 3;
  }
};
// A system that is described as a registered one is.
template <class S>
std::shared_ptr<const Model> described_as(const char* name, const S& system) {
  return make_model(systems().get(name, "").descriptor(), system);
}

TEST(StagesInLanes, FormsOfSecondOrderAreTheSameBits) {
  const auto named = [](const char* name) { return systems().get(name, "").make({}); };
  for (const auto& [model, h] :
       {std::pair(named("kepler"), 0.1), std::pair(named("henon-heiles"), 0.2),
        std::pair(named("outer-solar-system"), 50.0),  // masses that differ
        std::pair(named("fermi-pasta-ulam-tsingou"), 0.05), std::pair(text_model("henon-heiles"), 0.2),
        std::pair(text_model("pleiades"), 0.001), std::pair(described_as("pendulum", Driven{}), 0.2)}) {
    EXPECT_TRUE(offers_lanes(model, Formula::force)) << model->name();
    for (const int stages : stage_numbers)
      EXPECT_EQ(run_in_lanes("gauss", model, stages, h, 20), run_after_another<Gauss>(model, stages, h, 20))
          << model->name() << ' ' << stages;
  }
}

TEST(StagesInLanes, FormsOfFirstOrderAreTheSameBits) {
  for (const auto& [name, h] :
       {std::pair("free-rigid-body", 0.2), std::pair("quadrupole-boson", 0.1), std::pair("heavy-top", 0.05),
        std::pair("n-pendulum-angles", 0.02), std::pair("point-vortices", 0.05)}) {
    const auto model = systems().get(name, "").make({});
    EXPECT_TRUE(offers_lanes(model, Formula::field)) << name;
    for (const int stages : stage_numbers)
      EXPECT_EQ(run_in_lanes("gauss", model, stages, h, 10), run_after_another<Gauss>(model, stages, h, 10))
          << name << ' ' << stages;
  }
}

TEST(StagesInLanes, ChartsAreTheSameBits) {
  for (const auto& [name, h] : {std::pair("kepler", 0.1), std::pair("damped-pendulum", 0.2),
                                std::pair("lotka-volterra", 0.1), std::pair("coupled-damped-pendula", 0.1)}) {
    const auto model = systems().get(name, "").make({});
    EXPECT_TRUE(offers_lanes(model, Formula::chart_field)) << name;
    for (const int stages : stage_numbers)
      EXPECT_EQ(run_in_lanes("gauss-darboux", model, stages, h, 10),
                run_after_another<InDarbouxChart<Gauss>>(model, stages, h, 10))
          << name << ' ' << stages;
  }
}

// Steps at which Newton's iteration takes over.
TEST(StagesInLanes, NewtonsIterationIsTheSameBits) {
  const auto model = systems().get("harmonic-oscillator", "").make({{"omega", "100"}});
  for (const char* method : {"gauss", "gauss-darboux"})
    for (const int stages : stage_numbers) {
      const LanesRun run = run_in_lanes(method, model, stages, 0.1, 5);
      EXPECT_EQ(run, std::string(method) == "gauss"
                         ? run_after_another<Gauss>(model, stages, 0.1, 5)
                         : run_after_another<InDarbouxChart<Gauss>>(model, stages, 0.1, 5))
          << stages;
    }
}

template <int Stages, class S>
std::vector<double> run_on_static_path(const S& system, const std::vector<double>& start, double h,
                                       int steps) {
  const StaticProblem<S> problem(system);
  const Collocation<Stages> method;
  Work<Collocation<Stages>, StaticProblem<S>> work(method, problem);
  auto z = problem.make_state();
  std::copy(start.begin(), start.end(), z.begin());
  std::int64_t completed = 0;
  EXPECT_EQ(advance(method, problem, 0.0, 0, h, steps, z, work, completed), Status::converged);
  return {z.begin(), z.end()};
}
template <int Stages, class S>
void expect_both_paths_to_agree(const char* name, double h) {
  const auto model = systems().get(name, "").make({});
  EXPECT_EQ(run_in_lanes("gauss", model, Stages, h, 200).z,
            run_on_static_path<Stages>(S(), start_of(*model), h, 200))
      << name << ' ' << Stages;
}
TEST(StagesInLanes, TheStaticPathAndTheRegisteredOneAreTheSameBits) {
  expect_both_paths_to_agree<3, Kepler>("kepler", 0.1);
  expect_both_paths_to_agree<6, Kepler>("kepler", 0.1);
  expect_both_paths_to_agree<8, Kepler>("kepler", 0.1);
  expect_both_paths_to_agree<4, HarmonicOscillator>("harmonic-oscillator", 0.2);
  expect_both_paths_to_agree<6, Pendulum>("pendulum", 0.2);
}

template <class T>
inline constexpr bool is_lanes = false;
template <int W>
inline constexpr bool is_lanes<Pack<W>> = true;

// A system whose author has formulas for single numbers only.
template <class S>
struct NotInPacks : S {
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const requires(!is_lanes<T>) {
    S::force(t, q, f);
  }
};
TEST(StagesInLanes, FormulasOfSingleNumbersAreEvaluatedOneByOne) {
  const auto packs = described_as("kepler", Kepler{}), single = described_as("kepler", NotInPacks<Kepler>{});
  EXPECT_TRUE(offers_lanes(packs, Formula::force));
  EXPECT_FALSE(offers_lanes(single, Formula::force));
  EXPECT_FALSE(offers_lanes(single, Formula::field));
  for (const char* method : {"gauss", "gauss-darboux"})
    for (const int stages : {3, 6})
      EXPECT_EQ(run_in_lanes(method, packs, stages, 0.1, 50), run_in_lanes(method, single, stages, 0.1, 50));
}

// A force with a pole at the moment at which the second step begins, where no stage lies.
struct Pole {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return q[0] * q[0] / 2 - q[0] / (t - T(Real::fraction(1, 4))) / 1000000;
  }
  template <class T>
  void force(const T& t, In<T> q, Out<T> f) const {
    f[0] = 1 / (t - T(Real::fraction(1, 4))) / 1000000 - q[0];
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0];
  }
};
TEST(StagesInLanes, UnusedLanesAreEvaluatedNowhereElse) {
  const auto model = make_model({.name = "pole", .title = "", .reference = "", .initial = {1, 0}}, Pole{});
  for (const char* method : {"gauss", "gauss-darboux"})
    for (const int stages : {3, 5, 6}) {
      const auto stepper =
          integrators().get(method, "").make({{"stages", std::to_string(stages)}})->stepper(model, 0.0);
      std::vector<double> z{1, 0};
      std::int64_t completed = 0;
      std::feclearexcept(FE_ALL_EXCEPT);
      EXPECT_EQ(stepper->advance(0.0, 0, 0.25, 3, z, completed), Status::converged);
      EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), 0) << method << ' ' << stages;
    }
}

}  // namespace
}  // namespace pfaff
