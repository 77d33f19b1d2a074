// Methods that are maps written as text: their steps against the same steps written in C++, what is judged of
// their claims, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <pfaff/runs/motion.hpp>
#include <pfaff/verify/check.hpp>

#include "method_files.hpp"
#include "methods.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::after_steps;
using pfaff::testing::distance;
using pfaff::testing::model_named;
using pfaff::testing::shipped_tables;
using pfaff::testing::TemporaryDirectory;

std::unique_ptr<const MethodTable> map_of(const std::string& text) {
  const TemporaryDirectory files;
  std::ofstream(files / "map.toml") << text;
  return read_method_table(files / "map.toml");
}
std::string head(const std::string& more = "order = 1") {
  return "name = \"map\"\nkind = \"map\"\n" + more + "\n";
}

// The message with which a map of these assignments is refused, without its folder.
std::string map_refusal(const std::string& assignments, const std::string& more = "order = 1") {
  try {
    (void)map_of(head(more) + "step = [" + assignments + "]\n");
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    const auto at = what.find("map.toml");
    return at == std::string::npos ? what : what.substr(at);
  }
  return "accepted";
}
void expect_map_refused(const std::string& assignments, const std::string& expected,
                        const std::string& more = "order = 1") {
  EXPECT_EQ(map_refusal(assignments, more).find(expected), 0U)
      << assignments << "\ngave: " << map_refusal(assignments, more) << "\nnot:  " << expected;
}

// The state after some steps from the initial one.
template <class T>
std::vector<T> after(const MethodInstance& method, const std::shared_ptr<const Model>& model, int steps,
                     const Real& h = Real::fraction(1, 20)) {
  return after_steps(method, model, T(h), steps);
}

TEST(MethodMaps, StepLikeTheSameMethodInCpp) {
  const auto verlet_table = read_method_table(shipped_tables + "verlet-map.toml");
  const auto verlet = verlet_table->make({});
  const auto in_cpp = integrators().get("verlet", "integrator").make({});
  for (const char* system : {"pendulum", "henon-heiles"}) {
    const auto model = model_named(system);
    EXPECT_LT(distance(after<double>(*verlet, model, 20), after<double>(*in_cpp, model, 20)), 1e-14);
    EXPECT_LT(distance(after<Quad>(*verlet, model, 20), after<Quad>(*in_cpp, model, 20)), 1e-32);
  }
  const auto heun_table = read_method_table(shipped_tables + "heun-3.toml");
  const auto heun = heun_table->make({});
  const auto table = map_of(
      "name = \"heun\"\nkind = \"runge-kutta\"\norder = 3\na = [[], [\"1/3\"], [0, \"2/3\"]]\n"
      "b = [\"1/4\", 0, \"3/4\"]\n");
  for (const char* system : {"pendulum", "damped-pendulum", "free-rigid-body"}) {
    const auto model = model_named(system);
    EXPECT_LT(distance(after<Quad>(*heun, model, 20), after<Quad>(*table->make({}), model, 20)), 1e-32);
    EXPECT_GT(distance(after<Quad>(*heun, model, 20),
                       after<Quad>(*integrators().get("rk4", "").make({}), model, 20)),
              1e-12);
  }
}

TEST(MethodMaps, OfOneSystemReadItsCoordinatesAndParameters) {
  const auto table = read_method_table(shipped_tables + "damped-pendulum-map.toml");
  const auto map = table->make({});
  const auto model = systems().get("damped-pendulum", "system").make({{"nu", "0.7"}});
  Quad r = model->initial()[0].quad(), p = model->initial()[1].quad();
  const Quad h = Quad(1) / Quad(20), decay = exp(-Quad(7) / Quad(10) * h / Quad(2));
  for (int k = 0; k < 20; ++k) {
    p = decay * p - h / Quad(2) * sin(r);
    r = r + h * p;
    p = decay * (p - h / Quad(2) * sin(r));
  }
  EXPECT_LT(distance(after<Quad>(*map, model, 20), {r, p}), 1e-32);
  EXPECT_EQ(map->refuses(*model_named("pendulum")),
            "damped-pendulum-map is a map of the system damped-pendulum alone");
  const auto other =
      map_of(head() + "system = \"pendulum\"\ncoordinates = [\"x\", \"p\"]\nstep = [\"x = x + h*p\"]\n");
  EXPECT_EQ(other->make({})->refuses(*model_named("pendulum")), "map has other coordinates than pendulum");
  const auto reads = map_of(head() +
                            "system = \"pendulum\"\ncoordinates = [\"q\", \"p\"]\n"
                            "system_parameters = [\"mu\"]\nstep = [\"q = q + mu*h*p\"]\n");
  EXPECT_EQ(reads->make({})->refuses(*model_named("pendulum")),
            "map reads the parameter 'mu', which pendulum does not have");
}

TEST(MethodMaps, TheTimeIsRead) {
  // z' = X(z, t) of a pendulum that is shaken: Euler's method with the rate at the end of the step.
  const auto map = map_of(head() +
                          "parameters = { theta = { value = 0, range = [0, 1] } }\n"
                          "step = [\"z = z + h*field(t + theta*h, z)\"]\n");
  const auto model = motion_of(model_named("shaken-pendulum"));
  const auto method = map->make({{"theta", "1"}});
  EXPECT_EQ(method->parameters(), (Assignments{{"theta", "1"}}));
  const auto field = make_evaluator<Quad>(model, Formula::field);
  std::vector<Quad> z, rate(4);
  for (const Real& x : model->initial()) z.push_back(x.quad());
  field.call(field.context, Quad(1) / Quad(20), z.data(), rate.data());
  for (std::size_t k = 0; k < 4; ++k) z[k] = z[k] + rate[k] / Quad(20);
  EXPECT_LT(distance(after<Quad>(*method, model, 1), z), 1e-31);  // rates of order ten
  EXPECT_GT(distance(after<Quad>(*map->make({}), model, 1), z), 1e-3);
}

// What is added to the state is compensated: after many steps the double run is where the quad run is, up to
// the rounding of the increments; a state that is assigned has the rounding of every sum.
TEST(MethodMaps, AdditionsToTheStateAreCompensated) {
  const auto model = model_named("pendulum");
  const auto error = [&](const std::string& step) {
    const auto map = map_of(head() + "step = [" + step + "]\n");
    const Real h = Real::fraction(1, 4096);
    const auto in_double = after<double>(*map->make({}), model, 4096, h);
    const auto in_quad = after<Quad>(*map->make({}), model, 4096, h);
    return std::abs(in_double[0] - static_cast<double>(in_quad[0]));
  };
  const double added = error("\"p = p + h*force(t, q)\", \"q = q + h*velocity(t, p)\"");
  const double assigned = error("\"p = h*force(t, q) + p\", \"q = h*velocity(t, p) + q\"");
  EXPECT_LT(added, 5e-16);
  EXPECT_GT(assigned, 5 * added);
}

std::vector<std::string> bad(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const Check& check : checks)
    if (!check.control && !good(check) && std::find(names.begin(), names.end(), check.claim) == names.end())
      names.push_back(check.claim);
  return names;
}
using Names = std::vector<std::string>;

TEST(MethodMaps, ClaimsAreJudged) {
  const auto judged = [](const std::string& text, const char* system) {
    return bad(check_method(*map_of(text), {}, systems().get(system, "system")));
  };
  const std::string euler = "step = [\"p = p + h*force(t, q)\", \"q = q + h*velocity(t, p)\"]\n";
  EXPECT_EQ(judged(head("order = 1\npreserves = [\"symplectic\"]") + euler, "pendulum"), Names{});
  EXPECT_EQ(judged(head("order = 1\npreserves = [\"symplectic\", \"symmetric\"]") + euler, "pendulum"),
            (Names{"symmetric", "symmetric along a run", "symmetric in a large step"}));
  EXPECT_NE(judged(head("order = 2") + euler, "henon-heiles"), Names{});
  const std::string wrong = "step = [\"p = p + h*force(t, q)\", \"q = q + (1 + 1e-9)*h*velocity(t, p)\"]\n";
  EXPECT_NE(judged(head("order = 1\npreserves = [\"symplectic\"]") + wrong, "henon-heiles"), Names{});
  const auto map = read_method_table(shipped_tables + "damped-pendulum-map.toml");
  EXPECT_EQ(bad(check_method(*map, {}, systems().get("damped-pendulum", "system"))), Names{});
  // The constants of let are the coefficients, each of which is changed as a control.
  const auto controls =
      check_changed_coefficient(*read_method_table(shipped_tables + "heun-3.toml")->make({}), {},
                                systems().get("damped-pendulum", "system"));
  EXPECT_EQ(controls.size(), 2U);
  for (const Check& control : controls) EXPECT_EQ(control.result, CheckResult::rejected) << control.claim;
}

TEST(MethodMaps, BadOnesAreRefusedAtTheirPlace) {
  EXPECT_EQ(map_refusal("\"z = z + h*field(t, z)\""), "accepted");
  expect_map_refused("\"z + h*field(t, z)\"", "map.toml:4:10: expected an assignment");
  expect_map_refused("\"2 z = z\"", "map.toml:4:10: expected one name before '='");
  expect_map_refused("\" = z\"", "map.toml:4:10: expected one name before '='");
  expect_map_refused("\"z = z + h*feld(t, z)\"",
                     "map.toml:4:20: unknown function 'feld'; did you mean 'field'?");
  expect_map_refused("\"z = z + h*field(t, x)\"", "map.toml:4:29: unknown name 'x'");
  expect_map_refused("\"z = z + h*field(t, h)\"", "map.toml:4:29: field: expected the state, got one number");
  expect_map_refused("\"z = z + h*field(z, z)\"", "map.toml:4:26: field: expected the time, got the state");
  expect_map_refused("\"z = z + h*field(z)\"", "map.toml:4:25: field: expected 2 arguments, got 1");
  expect_map_refused("\"z = z + hh*field(t, z)\"", "map.toml:4:18: unknown name 'hh'; did you mean 'h'?");
  expect_map_refused("\"slope = field(t, z)\"", "map.toml:4:8: step: expected an assignment to the state");
  expect_map_refused("\"k = field(t, z)\", \"k = 2*k\", \"z = z + h*k\"",
                     "map.toml:4:29: 'k' has a value already");
  expect_map_refused("\"t = 1\", \"z = z + h*field(t, z)\"", "map.toml:4:10: 't' has a value already");
  expect_map_refused("\"z = z[1]\"", "map.toml:4:14: a map is written for every component at once");
  expect_map_refused("\"z = z + sum(i, 1, 2, h*field(t, z))\"",
                     "map.toml:4:33: 'field' is not called inside a sum");
  expect_map_refused("\"z = z + sum(i, 1, 2, z)\"", "map.toml:4:31: sum: expected a number for every index");
  expect_map_refused("\"q = q + h*field(t, p)\"", "map.toml:4:20: unknown function 'field'");
  expect_map_refused("\"p = p + h*force(t, q + z)\"", "map.toml:4:33: unknown name 'z'");
  expect_map_refused("\"z = z/0\"", "map.toml:4:16: division by what is always zero");
  expect_map_refused("1", "map.toml:4:9: step: expected a text");
  expect_map_refused("", "map.toml:4:8: step: expected an assignment to the state");
  expect_map_refused("\"z = z + h*field(t, z)\"", "map.toml:4:13: key 'preserves': unknown claim 'symplctic'",
                     "order = 1\npreserves = [\"symplctic\"]");
  const std::string euler = "\"z = z + h*field(t, z)\"";
  expect_map_refused(euler, "map.toml:4:15: key 'coordinates': is written beside 'system'",
                     "order = 1\ncoordinates = [\"q\", \"p\"]");
  expect_map_refused(euler, "map.toml:4:1: unknown key 'stp'; did you mean 'step'?", "order = 1\nstp = []");
  expect_map_refused(euler, "map.toml:5:8: step size 'h' has the name of a definition",
                     "order = 1\nlet = { h = 1 }");
  expect_map_refused(euler, "map.toml:4:7: key 'let': 'w' is a list", "order = 1\nlet = { w = [1, 2] }");
  expect_map_refused(euler, "map.toml:1:1: key 'order': is missing", "");
}

}  // namespace
