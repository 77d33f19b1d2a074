// Methods that a program instantiates itself, from installed headers, have the bits of the registered ones;
// and those remain the code of the library, with its bits and its speed, even where the program instantiates
// the same types. Prints what it has compared; the exit status is the number of differences.
#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <pfaff/core/facets/static_problem.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/generating/generating_function.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/systems/canonical/kepler.hpp>

namespace {
using namespace pfaff;

// The types that the library registers, once more: without further care the linker would make one of both.
const Method<SymplecticEuler> euler{
    {.name = "outside-euler", .title = "symplectic Euler of a program", .order = 1}};
const System<Kepler> kepler{
    {.name = "outside-kepler",
     .title = "Kepler problem of a program",
     .coordinates = {{"q1", ""}, {"q2", ""}, {"p1", ""}, {"p2", ""}},
     .invariants = {conserved("energy", ""), conserved_quadratic("angular-momentum", ""),
                    conserved("lenz-1", ""), conserved("lenz-2", "")}}};

int differences = 0;

void expect(bool holds, const std::string& what) {
  std::printf("%s: %s\n", what.c_str(), holds ? "as expected" : "DIFFERENT");
  if (!holds) ++differences;
}

template <class T>
bool same(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

constexpr int steps = 1000;

// The registered method against `method` on `problem`, after each step. No bit of a double or of a Quad is
// padding.
template <class P, class M>
void compare(Integration<Scalar<P>> run, const P& problem, const M& method, const std::string& what) {
  using T = Scalar<P>;
  Work<M, P> work(method, problem);
  auto z = problem.make_state();
  std::copy(run.state().begin(), run.state().end(), z.begin());
  int equal = 0;
  for (int k = 0; k < steps; ++k) {
    std::int64_t completed = 0;
    if (advance(method, problem, T(0), k, run.step(), 1, z, work, completed) != Status::converged) break;
    run.steps(1).expect_reached();
    if (!same<T>(run.state(), {z.data(), z.size()})) break;
    ++equal;
  }
  expect(equal == steps, what + ", " + std::to_string(equal) + " steps of " + std::to_string(steps));
}

template <class T>
void compare_methods(const std::string& scalar) {
  const auto run = [](const char* system, const char* method, const Assignments& parameters,
                      const char* step) {
    return integrate<T>(system, {}, method, parameters, {.step = step});
  };
  const auto verlet = run("kepler", "verlet", {}, "0.01");
  const Problem<T> motion(verlet.model());
  compare(run("kepler", "verlet", {}, "0.01"), motion, Verlet(), "verlet in " + scalar);
  compare(run("kepler", "verlet", {}, "0.01"), StaticProblem<Kepler, T>(), Verlet(),
          "verlet on the static path in " + scalar);

  Gauss gauss;
  gauss.stages = 3;
  gauss.validate();
  compare(run("kepler", "gauss", {{"stages", "3"}}, "0.05"), motion, gauss, "gauss in " + scalar);

  GeneratingFunction generating;
  generating.truncation = 4;
  generating.validate();
  auto damped = run("damped-pendulum", "generating-function", {{"order", "4"}}, "0.05");
  const Problem<T> pendulum(damped.model());
  compare(std::move(damped), pendulum, generating, "generating-function in " + scalar);

  // What the program registers takes the same steps as what the library registers under the other name.
  for (const char* method : {"symplectic-euler", "outside-euler"}) {
    auto known = run("kepler", "symplectic-euler", {}, "0.01"),
         own = run("outside-kepler", method, {}, "0.01");
    known.steps(steps).expect_reached();
    own.steps(steps).expect_reached();
    expect(same<T>(known.state(), own.state()),
           std::string(method) + " of a system of the program in " + scalar);
  }
}

constexpr std::string_view library_name = "libpfaff";  // and libpfaff_plugins

// The file in which the first virtual functions of an object stand. Every polymorphic object of the GNU C++
// interface begins with the address of its table of virtual functions.
template <class Object>
std::string file_of_code(const Object& object) {
  static_assert(std::is_polymorphic_v<Object>);
  void** table = nullptr;
  std::memcpy(&table, static_cast<const void*>(&object), sizeof table);
  std::string file;
  for (int k = 0; k < 4; ++k) {
    Dl_info info{};
    if (dladdr(table[k], &info) == 0 || (k > 0 && file != info.dli_fname)) return "several files";
    file = info.dli_fname;
  }
  return file;
}

template <class Object>
void expect_of(const Object& object, bool of_library, const std::string& what) {
  const std::string file = file_of_code(object);
  const bool library = file.find(library_name) != std::string::npos;
  expect(library == of_library && file != "several files",
         what + " is code of " + (library ? "the library" : file));
}

bool of_library(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) != 0 &&
         std::string_view(info.dli_fname).find(library_name) != std::string_view::npos;
}

// The series that generating functions evaluate. The program asks for its own before a model is made: where
// both share them, the first to ask decides whose code they are.
void look_at_series() {
  const CompiledSeries& own = *StaticProblem<Kepler>().chart_field_series().series;
  const CompiledSeries& registered = *systems().get("kepler", "system").make({})->chart_field_series();
  const auto code = [](const CompiledSeries& series) {
    return reinterpret_cast<const void*>(series.one.collocate);
  };
  expect(!of_library(code(own)), "series of the static path are code of the program");
  expect(of_library(code(registered)), "series of kepler are code of the library");
}

void look_at_code(const char* system, const char* method, bool of_library) {
  const auto& plugin = integrators().get(method, "integrator");
  const auto made = plugin.make({});
  const auto model = systems().get(system, "system").make({});
  expect_of(systems().get(system, "system"), of_library, std::string("the plug-in ") + system);
  expect_of(plugin, of_library, std::string("the plug-in ") + method);
  expect_of(*made, of_library, std::string("the method ") + method);
  expect_of(*made->stepper(model, double()), of_library, std::string("the stepper in double of ") + method);
  expect_of(*made->stepper(model, Quad()), of_library, std::string("the stepper in quad of ") + method);
}

}  // namespace

int main() {
  try {
    look_at_series();
    compare_methods<double>("double");
    compare_methods<Quad>("quad");
    look_at_code("kepler", "symplectic-euler", true);
    look_at_code("outside-kepler", "outside-euler", false);
    return differences;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "instantiates: %s\n", error.what());
    return 100;
  }
}
