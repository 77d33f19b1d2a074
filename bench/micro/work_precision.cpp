// Whole runs at the accuracy that they reach: Kepler's problem with e = 0.6 over 200 units of time, about 32
// revolutions, and the damped pendulum and the model of Lotka and Volterra in their Darboux charts. Each
// benchmark is one run from the start, and prints beside its time the largest relative error of the energy
// over its steps (in the charts, the error of the state at the end), which is measured in a run of its own.
// ratios.py compares Kepler's runs with Verlet's method as a loop by hand at h = 0.02, and generating
// functions with Gauss collocation in the chart.
#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <memory>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

#include "cases.hpp"
#include "whole_runs.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::micro;
namespace odeint = boost::numeric::odeint;

constexpr double duration = 200;
using Orbit = std::array<double, 4>;
using Point = std::array<double, 2>;

// A system with a Darboux chart, and the run of it that is made.
struct ChartCase {
  const char* system;
  Assignments parameters;
  Point start;
  double duration;
};
const ChartCase pendulum{"damped-pendulum", {{"nu", "0.1"}}, {2, 0}, 40};
const ChartCase predators{"lotka-volterra", {}, {3, 1}, 20};

// The largest relative error of the energy, of the states that it is shown.
class EnergyError {
 public:
  explicit EnergyError(const Orbit& start) : initial_(energy(start)) {}
  void operator()(const Orbit& z) { largest_ = std::max(largest_, std::abs(energy(z) / initial_ - 1)); }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  static double energy(const Orbit& z) {
    return (z[2] * z[2] + z[3] * z[3]) / 2 - 1 / std::sqrt(z[0] * z[0] + z[1] * z[1]);
  }
  double initial_, largest_ = 0;
};

// A run of fixed steps: steps(z, h, first, count) takes some of them on end, of which `first` is the first
// one's number. A method that carries more than the state from step to step goes on from there.
template <class Steps>
void add_orbit(const std::string& method, const std::string& path, double h, Steps steps) {
  const Orbit start = Case<Kepler>::start;
  const auto count = std::llround(duration / h);
  EnergyError error(start);
  Orbit z = start;
  for (std::int64_t k = 0; k < count; ++k) {
    steps(z, h, k, 1);
    error(z);
  }
  const volatile double unknown = h;  // the compiler is to compute nothing beforehand
  add_run("kepler-run/" + method + "-h" + step_name(h) + "/" + path, start, "energy_error", error.largest(),
          [=](Orbit& end) mutable { steps(end, unknown, 0, count); });
}

// Verlet's method with the drifts of neighbouring steps merged, without compensation.
void verlet_by_hand(Orbit& z, double h, std::int64_t /*first*/, std::int64_t count) {
  double x = z[0] + h / 2 * z[2], y = z[1] + h / 2 * z[3], u = z[2], v = z[3];
  const auto kick = [&] {
    const double square = x * x + y * y, scale = -h / (square * std::sqrt(square));
    u += scale * x;
    v += scale * y;
  };
  for (std::int64_t k = 1; k < count; ++k) {
    kick();
    x += h * u;
    y += h * v;
  }
  kick();
  z = {x + h / 2 * u, y + h / 2 * v, u, v};
}

template <int Stages>
void add_gauss(double h) {
  using M = Collocation<Stages>;
  using P = StaticProblem<Kepler>;
  const P problem;
  const M method;
  add_orbit("gauss-" + std::to_string(2 * Stages), "static", h,
            [=, work = std::make_shared<Work<M, P>>(method, problem)](
                Orbit& start, double step, std::int64_t first, std::int64_t count) {
              if (first == 0) work->restart();
              State<P> z;
              std::copy(start.begin(), start.end(), z.begin());
              std::int64_t completed = 0;
              advance(method, problem, 0.0, first, step, count, z, *work, completed);
              std::copy(z.begin(), z.end(), start.begin());
            });
}

std::shared_ptr<Stepper<double>> stepper_of(const std::shared_ptr<const Model>& model,
                                            const std::string& integrator, const Assignments& parameters) {
  return integrators().get(integrator, "integrator").make(parameters)->stepper(model, 0.0);
}

// The stepper is made once: what a repetition remembers of the one before is one step's prediction.
void add_registered(const std::string& name, const std::string& integrator, const Assignments& parameters,
                    double h) {
  const auto stepper =
      stepper_of(systems().get("kepler", "system").make({{"eccentricity", "0.6"}}), integrator, parameters);
  add_orbit(name, "registered", h, [=](Orbit& z, double step, std::int64_t first, std::int64_t count) {
    std::int64_t completed = 0;
    stepper->advance(0, first, step, count, z, completed);
  });
}

// Odeint's methods that choose their steps, at a tolerance for absolute and relative errors alike.
template <class Controlled>
void add_adaptive(const std::string& method, double tolerance, Controlled controlled) {
  const StaticProblem<Kepler> problem;
  const Orbit start = Case<Kepler>::start;
  const auto run = [=](Orbit& z, auto observer) {
    const auto field = [&](const Orbit& x, Orbit& rate, double t) { problem.field(t, x, rate); };
    odeint::integrate_adaptive(controlled(tolerance), field, z, 0.0, duration, 0.05, observer);
  };
  EnergyError error(start);
  Orbit z = start;
  run(z, [&](const Orbit& at, double /*t*/) { error(at); });
  add_run("kepler-run/" + method + "-tol" + step_name(tolerance) + "/odeint", start, "energy_error",
          error.largest(), [=](Orbit& end) { run(end, [](const Orbit&, double) {}); });
}

// With the error of the state at the end against Gauss of eight stages at h = 0.02.
void add_in_chart(const ChartCase& which, const std::string& name, const std::string& integrator,
                  const Assignments& parameters, double h) {
  const auto model = systems().get(which.system, "system").make(which.parameters);
  const Point start = which.start;
  const auto run = [duration = which.duration](Point& z, const std::shared_ptr<Stepper<double>>& stepper,
                                               double step) {
    std::int64_t completed = 0;
    stepper->advance(0, 0, step, std::llround(duration / step), z, completed);
  };
  Point exact = start, end = start;
  run(exact, stepper_of(model, "gauss-darboux", {{"stages", "8"}}), 0.02);
  const auto stepper = stepper_of(model, integrator, parameters);
  run(end, stepper, h);
  const double error = std::hypot(end[0] - exact[0], end[1] - exact[1]) / std::hypot(exact[0], exact[1]);
  add_run(std::string(which.system) + "-run/" + name + "-h" + step_name(h) + "/registered", start,
          "state_error", error, [=](Point& z) { run(z, stepper, h); });
}

bool add_runs() {
  add_orbit("verlet", "by-hand", 0.02, verlet_by_hand);
  add_gauss<6>(0.2);
  add_registered("gauss-12", "gauss", {{"stages", "6"}}, 0.2);
  for (const double h : {0.2, 0.1}) {
    add_gauss<8>(h);
    add_registered("gauss-16", "gauss", {{"stages", "8"}}, h);
  }
  for (const double h : {0.5, duration / 560, 0.25}) {
    add_gauss<12>(h);
    add_registered("gauss-24", "gauss", {{"stages", "12"}}, h);
  }
  for (const double h : {0.1, 0.05, 0.025})
    add_registered("kahan-li-8", "kahan-li-verlet", {{"order", "8"}}, h);
  for (const double h : {0.1, 0.05}) {
    add_registered("generating-function-8", "generating-function", {{"order", "8"}, {"extra", "0"}}, h);
    add_registered("generating-function-12", "generating-function", {{"order", "12"}, {"extra", "0"}}, h);
  }
  add_registered("taylor-20", "taylor", {{"order", "20"}}, 0.2);
  add_registered("taylor-20", "taylor", {{"order", "20"}}, 0.1);
  for (const double tolerance : {1e-10, 1e-13}) {
    add_adaptive("dopri5", tolerance,
                 [](double e) { return odeint::make_controlled<odeint::runge_kutta_dopri5<Orbit>>(e, e); });
    add_adaptive("fehlberg78", tolerance, [](double e) {
      return odeint::make_controlled<odeint::runge_kutta_fehlberg78<Orbit>>(e, e);
    });
    add_adaptive("bulirsch-stoer", tolerance, [](double e) { return odeint::bulirsch_stoer<Orbit>(e, e); });
  }
  // Nearly the fewest steps with which a method reaches 1e-6 or 1e-9: the fastest methods of each kind, and
  // Gauss collocation of the orders that the generating functions have.
  const auto add_gauss_in_chart = [](const ChartCase& which, int stages, int steps) {
    add_in_chart(which, "gauss-" + std::to_string(2 * stages), "gauss-darboux",
                 {{"stages", std::to_string(stages)}}, which.duration / steps);
  };
  const auto add_generating = [](const ChartCase& which, const std::string& order, const std::string& extra,
                                 int steps) {
    add_in_chart(which, "generating-function-" + order + "+" + extra, "generating-function",
                 {{"order", order}, {"extra", extra}}, which.duration / steps);
  };
  for (const int steps : {19, 30}) add_gauss_in_chart(pendulum, 8, steps);
  add_gauss_in_chart(pendulum, 4, 48);
  add_gauss_in_chart(pendulum, 6, 46);
  for (const int steps : {17, 19}) add_gauss_in_chart(predators, 8, steps);
  add_gauss_in_chart(predators, 4, 46);
  add_gauss_in_chart(predators, 6, 29);
  add_generating(pendulum, "8", "0", 62);
  add_generating(pendulum, "12", "0", 75);
  for (const int steps : {53, 99}) add_generating(predators, "8", "4", steps);
  return true;
}

[[maybe_unused]] const bool added = add_runs();
}  // namespace
