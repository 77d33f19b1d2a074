// Models with formulas that the system's compiler has compiled: they give what the tapes give, in every
// facet; what is compiled is kept, and only where nobody else can put code.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/native/compiler.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../temporary_directory.hpp"
#include "random_formula.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// The cache stands in a directory of its own while a test runs.
class Native : public ::testing::Test {
 protected:
  Native() { setenv("XDG_CACHE_HOME", (directory_ / "cache").c_str(), 1); }
  ~Native() override { unsetenv("XDG_CACHE_HOME"); }
  [[nodiscard]] fs::path cache() const { return directory_.path() / "cache" / "pfaff-native"; }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(cache()), fs::directory_iterator()));
  }

 private:
  TemporaryDirectory directory_;
};

std::shared_ptr<const Model> model_of(const std::string& system) {
  return systems().get(system, "system").make({});
}
// The same without its author's code, as a system that is given as text.
std::shared_ptr<const Model> bare(const std::shared_ptr<const Model>& model) {
  ModelSource source = model->source();
  source.compiled = {};
  source.chart_field_series = nullptr;
  return std::make_shared<const Model>(std::move(source));
}

// The largest difference between the compiled formula and a replay of the tape, relative to max(1, |x|), at
// points about the initial state. NaN in both is no difference.
double compiled_difference(const Model& model, Formula formula) {
  Replay<double> replay(model.tape(formula));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> change(-0.2, 0.2);
  const auto inputs = static_cast<std::size_t>(replay.tape().inputs);
  std::vector<double> expected(replay.tape().outputs.size()), found(expected);
  double worst = 0;
  for (int point = 0; point < 20; ++point) {
    std::vector<double> x(inputs);
    for (std::size_t k = 0; k < inputs; ++k) x[k] = model.initial()[k].value() + change(random);
    const double t = change(random);
    replay(t, x.data(), expected.data());
    model.compiled(formula)(model.system(), t, x.data(), found.data());
    for (std::size_t k = 0; k < expected.size(); ++k)
      if (!(std::isnan(expected[k]) && std::isnan(found[k])))
        worst = std::max(worst, std::abs(found[k] - expected[k]) / std::max(1.0, std::abs(expected[k])));
  }
  return worst;
}

TEST_F(Native, CompiledFormulasGiveWhatTheTapesGive) {
  using enum Formula;
  const std::vector<std::pair<std::string, std::vector<Formula>>> expected{
      {"henon-heiles",
       {field, field_jacobian, force, velocity, chart, chart_inverse, hamiltonian, invariants}},
      {"kepler", {field, field_jacobian, force, velocity, hamiltonian_gradient}},
      {"damped-pendulum",
       {field, field_jacobian, chart, chart_inverse, chart_field, chart_field_jacobian, structure}},
      {"lotka-volterra", {field, field_jacobian, chart, chart_inverse, chart_field, chart_field_jacobian}},
      {"heavy-top", {field, field_jacobian, poisson_tensor, hamiltonian}},
      {"n-pendulum-angles", {field, field_jacobian, hamiltonian_gradient}}};  // solves linear systems
  for (const auto& [name, formulas] : expected) {
    const auto model = compiled(bare(model_of(name)));
    for (const Formula formula : formulas) {
      SCOPED_TRACE(name + ": " + std::string(to_string(formula)));
      ASSERT_NE(model->compiled(formula), nullptr);
      // The same operations; a sine and a cosine taken together may differ in the last bit, which elimination
      // magnifies.
      EXPECT_LE(compiled_difference(*model, formula), name == "n-pendulum-angles" ? 1e-13 : 2e-15);
    }
  }
}

// Every lane of a pack of points gives the bits of its point alone.
template <int W>
void expect_bits_in_lanes(const Model& model, Formula formula) {
  ASSERT_NE(model.compiled(formula), nullptr);
  const auto in_lanes = model.compiled_in_lanes<W>(formula);
  ASSERT_NE(in_lanes, nullptr);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> change(-0.2, 0.2);
  const Tape& tape = *model.tape(formula);
  const auto inputs = static_cast<std::size_t>(tape.inputs);
  std::vector<Pack<W>> points(inputs), found(tape.outputs.size());
  Pack<W> times;
  for (std::size_t lane = 0; lane < W; ++lane) {
    times.set(lane, change(random));
    for (std::size_t k = 0; k < inputs; ++k) points[k].set(lane, model.initial()[k].value() + change(random));
  }
  // Zeros of either sign side by side, which are equal and of which a sine is not.
  points[0].set(0, 0.0);
  points[0].set(1, -0.0);
  in_lanes(model.system(), times, points.data(), found.data());
  for (std::size_t lane = 0; lane < W; ++lane) {
    std::vector<double> point, alone(found.size());
    for (const Pack<W>& x : points) point.push_back(x[lane]);
    model.compiled(formula)(model.system(), times[lane], point.data(), alone.data());
    for (std::size_t k = 0; k < alone.size(); ++k)
      EXPECT_TRUE(std::bit_cast<std::uint64_t>(found[k][lane]) == std::bit_cast<std::uint64_t>(alone[k]) ||
                  (std::isnan(found[k][lane]) && std::isnan(alone[k])))
          << "lane " << lane << ", result " << k << ": " << found[k][lane] << ", alone " << alone[k];
  }
}

TEST_F(Native, FormulasAreCompiledForPacksToo) {
  using enum Formula;
  const std::vector<std::pair<std::string, std::vector<Formula>>> expected{
      {"henon-heiles", {field, force, velocity}},
      {"kepler", {force}},
      {"damped-pendulum", {field, chart_field}},
      {"lotka-volterra", {chart_field}}};
  for (const auto& [name, formulas] : expected) {
    const auto model = compiled(bare(model_of(name)));
    for (const Formula formula : formulas) {
      SCOPED_TRACE(name + ": " + std::string(to_string(formula)));
      expect_bits_in_lanes<4>(*model, formula);
      expect_bits_in_lanes<8>(*model, formula);
    }
    EXPECT_EQ(model->compiled_in_lanes<4>(hamiltonian), nullptr);  // which no method evaluates in packs
  }
}

// Fields of random operations.
struct RandomField {
  static constexpr int dimension = 3;
  unsigned seed = 0;
  bool special = false;  // with special functions
  [[nodiscard]] RandomFormula formula() const { return {seed, 3, 3, 12, special}; }
  template <class T>
  void field(const T& t, In<T> z, Out<T> rates) const {
    formula()(t, z, rates);
  }
};

std::shared_ptr<const Model> random_model(unsigned seed, bool special = false) {
  return make_model({.name = "random", .title = "", .reference = "", .initial = {1, 0.5_r, -0.3_r}},
                    RandomField{.seed = seed, .special = special});
}

TEST_F(Native, PacksHaveEveryOperation) {
  int without_solves = 0;
  std::set<Operation> met;
  for (unsigned seed = 0; without_solves < 6; ++seed) {
    const Tape tape = RandomField{.seed = seed}.formula().tape();
    if (!tape.solves.empty()) continue;  // see PacksSolveNoLinearSystems
    ++without_solves;
    for (const Instruction& i : tape.code) met.insert(i.operation);
    SCOPED_TRACE(seed);
    const auto model = compiled(
        bare(make_model({.name = "random", .title = "", .reference = "", .initial = {1, 0.5_r, -0.3_r}},
                        RandomField{.seed = seed})));
    expect_bits_in_lanes<4>(*model, Formula::field);
    expect_bits_in_lanes<8>(*model, Formula::field);
  }
  EXPECT_EQ(met.size(), 15U);  // all but those of linear systems, and special functions
}

// Infinite with the sign of a zero; and special functions, which random fields have none of.
struct ReciprocalSine {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = 1 / sin(z[0]) + atan(z[0]) * erf(t);
  }
};

TEST_F(Native, PacksTellTheSignOfZero) {
  const auto model = compiled(bare(
      make_model({.name = "reciprocal", .title = "", .reference = "", .initial = {1}}, ReciprocalSine{})));
  expect_bits_in_lanes<4>(*model, Formula::field);
}

// The compiler knows that a cosine of an arc tangent, which this formula has, is a root, with other last
// bits.
TEST_F(Native, PacksAndDoublesKnowTheSameIdentities) {
  expect_bits_in_lanes<8>(*compiled(bare(random_model(7, true))), Formula::field);
}

TEST_F(Native, PacksSolveNoLinearSystems) {
  unsigned seed = 0;
  while (RandomField{.seed = seed}.formula().tape().solves.empty()) ++seed;
  const auto model = compiled(bare(random_model(seed)));
  EXPECT_NE(model->compiled(Formula::field), nullptr);
  EXPECT_EQ(model->compiled_in_lanes<4>(Formula::field), nullptr);
}

TEST_F(Native, WhatAnAuthorCompiledStays) {
  const auto written = model_of("henon-heiles"), model = compiled(written);
  EXPECT_EQ(model->compiled(Formula::force), written->compiled(Formula::force));
  EXPECT_EQ(model->chart_field_series(), written->chart_field_series());
  EXPECT_EQ(written->compiled(Formula::field_jacobian), nullptr);
  ASSERT_NE(model->compiled(Formula::field_jacobian), nullptr);
  EXPECT_EQ(model->system(), written->system()) << "the author's code is called with the author's object";
  EXPECT_LE(compiled_difference(*model, Formula::force), 2e-15);
}

// The field of a formulation loops over structured factors where it is not compiled.
TEST_F(Native, FieldsOfFormulationsAreCompiled) {
  for (const auto& [system, formulation] :
       {std::pair{"n-pendulum", "dirac"}, {"spherical-pendulum", "lmm"}, {"sleigh", "nonholonomic"}}) {
    SCOPED_TRACE(system);
    const auto motion = formulations().get(formulation, "formulation").apply(model_of(system), {});
    const auto model = compiled(motion);
    ASSERT_NE(model->compiled(Formula::field), nullptr);
    std::vector<double> z, expected(motion->initial().size()), found(expected);
    for (std::size_t k = 0; k < motion->initial().size(); ++k)
      z.push_back(motion->initial()[k].value() + 0.01 * static_cast<double>(k % 3));
    Problem<double>(motion).field(0, z, expected);
    Problem<double>(model).field(0, z, found);
    double largest = 0, worst = 0;
    for (std::size_t k = 0; k < z.size(); ++k) {
      largest = std::max(largest, std::abs(expected[k]));
      worst = std::max(worst, std::abs(found[k] - expected[k]));
    }
    EXPECT_GT(largest, 0);
    EXPECT_LE(worst, 1e-12 * largest);  // another order of operations, magnified by the condition of S
  }
}

TEST_F(Native, FieldsOfFormulationsOfLargeSystemsLoop) {
  const auto text = [](const char* bobs) {
    const auto chain = systems().get("n-pendulum", "system").make({{"bobs", bobs}, {"dimension", "2"}});
    return native_text(*formulations().get("dirac", "formulation").apply(chain, {}));
  };
  EXPECT_NE(text("2").find("pfaff_field("), std::string::npos);
  EXPECT_EQ(text("101").find("pfaff_field("), std::string::npos);
}

TEST_F(Native, ACompiledModelOutlivesTheOneItWasMadeOf) {
  auto model = bare(model_of("kepler"));
  const auto made = compiled(model);
  model.reset();
  const Problem<double> problem(made);
  const std::vector<double> z{1, 0.5, 0.1, 1};
  std::vector<double> rate(4);
  problem.field(0, z, rate);
  EXPECT_DOUBLE_EQ(rate[0], 0.1);
  EXPECT_NEAR(rate[2], -std::pow(1.25, -1.5), 1e-15);
}

TEST_F(Native, WhatIsCompiledIsKept) {
  (void)compiled(bare(model_of("henon-heiles")));
  EXPECT_EQ(files(), 2U) << "a text and its library";
  const auto library = [&] {
    for (const auto& entry : fs::directory_iterator(cache()))
      if (entry.path().extension() == ".so") return entry.path();
    return fs::path();
  }();
  struct stat status {};
  ASSERT_EQ(stat(library.c_str(), &status), 0);
  const auto before = status.st_ino;
  (void)compiled(bare(model_of("henon-heiles")));
  ASSERT_EQ(stat(library.c_str(), &status), 0);
  EXPECT_EQ(status.st_ino, before) << "compiled again";
  // Another text is another library; a library without its text is not trusted.
  (void)compiled(bare(systems().get("kepler", "system").make({})));
  EXPECT_EQ(files(), 4U);
  std::ofstream(fs::path(library).replace_extension(".cpp")) << "// something else\n";
  (void)compiled(bare(model_of("henon-heiles")));
  ASSERT_EQ(stat(library.c_str(), &status), 0);
  EXPECT_NE(status.st_ino, before);
  EXPECT_EQ(files(), 4U);
}

TEST_F(Native, CodeIsLoadedFromTheUsersOwnDirectoryOnly) {
  (void)compiled(bare(model_of("henon-heiles")));
  struct stat status {};
  ASSERT_EQ(stat(cache().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  const auto refusal = [&] {
    try {
      (void)compiled(bare(model_of("henon-heiles")));
    } catch (const RunError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(), "");
  fs::permissions(cache(), fs::perms::owner_all | fs::perms::others_write);
  EXPECT_NE(refusal().find("closed to others (chmod 700)"), std::string::npos) << refusal();
  const fs::path elsewhere = cache().parent_path() / "elsewhere";
  fs::rename(cache(), elsewhere);
  fs::permissions(elsewhere, fs::perms::owner_all);
  fs::create_directory_symlink(elsewhere, cache());
  EXPECT_NE(refusal().find("closed to others"), std::string::npos) << "a symbolic link is followed";
}

TEST_F(Native, ACompilersErrorIsOneLineThatSaysWhereItsMessagesAre) {
  try {
    (void)native::library_of("int main() { return nonsense; }\n", "system nonsense");
    FAIL() << "nonsense compiles";
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("compiling the formulas of system nonsense: ")) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const std::size_t quote = text.find('\'');
    ASSERT_NE(quote, std::string::npos);
    std::ifstream log(text.substr(quote + 1, text.size() - quote - 2));
    const std::string said{std::istreambuf_iterator<char>(log), {}};
    EXPECT_NE(said.find("nonsense"), std::string::npos) << text;
  }
}

// These tests are compiled for the same instructions as the library. Each is named, because a cache may be
// shared by machines of which one has fewer.
TEST_F(Native, TheCompilerIsAskedForTheInstructionsOfTheLibrary) {
#ifdef __AVX2__
  constexpr bool wide = true;
#else
  constexpr bool wide = false;
#endif
#ifdef __AVX512F__
  constexpr bool widest = true;
#else
  constexpr bool widest = false;
#endif
  const std::string command = native::compiler_identity() + " ";
  EXPECT_NE(command.find(" -ffp-contract=off "), std::string::npos) << command;
  EXPECT_EQ(command.find(" -mavx2 ") != std::string::npos, wide) << command;
  EXPECT_EQ(command.find(" -mavx512f ") != std::string::npos, widest) << command;
  EXPECT_EQ(command.find("native"), std::string::npos) << command;
}

}  // namespace
