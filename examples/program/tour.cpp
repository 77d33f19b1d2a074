// The library from a program of one's own, piece by piece: docs/cpp.md explains what stands here.
#include <array>
#include <boost/numeric/odeint/integrate/integrate_const.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <vector>

#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/odeint/stepper.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

namespace {

using namespace pfaff;

// A system and a method by name, and a watcher that looks at the energy after every tenth step.
double energy_error() {
  auto run = integrate("kepler", {{"eccentricity", "0.3"}}, "gauss", {{"stages", "3"}}, {.step = "0.05"});
  InvariantErrors errors;
  run.watch(errors, 10);
  run.steps(2000).expect_reached();
  return errors.largest()[0];
}

// The static path: the compiler knows system, method and size, and inlines the formulas into the loop.
struct DoubleWell {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T square = q[0] * q[0];
    return square * square / 4 - square / 2;
  }
};

double after_a_million_steps() {
  using P = StaticProblem<DoubleWell>;
  const P problem;
  const Verlet method;
  Work<Verlet, P> work(method, problem);
  auto z = problem.make_state();
  z[0] = 0.5, z[1] = 0;
  std::int64_t completed = 0;
  const Status status = advance(method, problem, 0.0, 0, 0.01, 1'000'000, z, work, completed);
  if (status != Status::converged) throw RunError(std::string(to_string(status)));
  return z[1] * z[1] / 2 + z[0] * z[0] * z[0] * z[0] / 4 - z[0] * z[0] / 2;  // the energy, -7/64 at the start
}

// A method of one's own in Boost.Odeint's loops, on a function of one's own.
struct Ralston {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*work*/) const {
    State<P> first = z, second = z, middle = z;
    p.field(t, z, first);
    for (std::size_t i = 0; i < z.size(); ++i) middle[i] = z[i] + 2 * h / 3 * first[i];
    p.field(t + 2 * h / 3, middle, second);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = z[i] + h / 4 * (first[i] + 3 * second[i]);
    return Status::converged;
  }
};

double rotated() {
  using X = std::array<double, 2>;
  X x{1, 0};
  const auto rotation = [](const X& from, X& rate, double /*t*/) { rate = {from[1], -from[0]}; };
  boost::numeric::odeint::integrate_const(OdeintStepper<Ralston, X>(Ralston{}, 2), rotation, x, 0.0, 1.0,
                                          0.001);
  return x[0];  // cos 1
}

// {f, g} at a point: a bracket maps the covector dg to a vector, of which df is taken.
double bracket_of_functions() {
  const LiePoissonBracket rotations{{{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}}, -1};  // so(3)*, {x, y} = -z
  const std::vector<double> z{0.1, 0.2, 0.3}, df{1, 0, 0}, dg{0, 1, 0};               // f = x, g = y
  std::vector<double> image(3);
  rotations.sharp<double>(0, z, dg, image);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += df[i] * image[i];
  return sum;
}

// The right-hand side of a model of beads and rods, in Dirac's formulation.
std::vector<double> of_rods(const std::string& file) {
  const auto model = systems().get("bead-rod", "system").make({{"model", file}});
  const auto motion = formulations().get("dirac", "formulation").apply(model, {});
  const Problem<double> problem(motion);
  std::vector<double> z, rate(static_cast<std::size_t>(motion->dimension()));
  for (const Real& x : motion->initial()) z.push_back(x.value());
  problem.field(0, z, rate);
  return rate;
}

}  // namespace

int main() {
  try {
    std::printf("energy %.1e\n", energy_error());
    std::printf("well %.6f\n", after_a_million_steps());
    std::printf("odeint %.6f\n", rotated());
    std::printf("bracket %.1f\n", bracket_of_functions());
    std::ofstream("pendulum.toml") << "dimension = 2\nmasses = [1.0]\ngravity = 9.81\n"
                                      "anchors = { origin = [0.0, 0.0] }\nrods = [[0, \"origin\"]]\n"
                                      "positions = [[0.6, -0.8]]\n";
    const std::vector<double> rate = of_rods("pendulum.toml");
    std::printf("rods %.4f %.4f %.4f %.4f\n", rate[0], rate[1], rate[2], rate[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tour: %s\n", error.what());
    return 1;
  }
}
