// Emitted C++ is compiled, without warnings, and run: it gives what replays of the tape give.
#include <gtest/gtest.h>

#include <dlfcn.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../temporary_directory.hpp"
#include "emitted_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

using Rates = void (*)(double t, const double* state, const double* parameters, double* results);

// A library of texts, compiled with the warnings of Pfaff as errors.
class CompiledTexts {
 public:
  explicit CompiledTexts(const std::vector<std::string>& texts) {
    std::string command =
        "c++ -std=c++17 -O1 -shared -fPIC -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion "
        "-Werror "
        "-o '" +
        (directory_.path() / "library.so").string() + "'";
    for (std::size_t k = 0; k < texts.size(); ++k) {
      const auto path = directory_.path() / ("text" + std::to_string(k) + ".cpp");
      std::ofstream(path) << texts[k];
      command += " '" + path.string() + "'";
    }
    EXPECT_EQ(std::system(command.c_str()), 0);
    library_ = dlopen((directory_.path() / "library.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr) << dlerror();
  }
  ~CompiledTexts() {
    if (library_ != nullptr) dlclose(library_);
  }
  CompiledTexts(const CompiledTexts&) = delete;
  CompiledTexts& operator=(const CompiledTexts&) = delete;

  [[nodiscard]] Rates function(const std::string& name) const {
    return reinterpret_cast<Rates>(dlsym(library_, name.c_str()));
  }

 private:
  TemporaryDirectory directory_;
  void* library_ = nullptr;
};

// The largest difference between the function and a replay, in units of max(1, |result|), over random points.
// Results are written over the state, which emitted code allows.
double emitted_difference(const Equations& equations, Rates rates) {
  Replay<double> replay(std::make_shared<const Tape>(equations.tape));
  const std::size_t n = equations.coordinates.size(), results = equations.tape.outputs.size();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2, 2);
  double worst = 0;
  for (int point = 0; point < 20; ++point) {
    std::vector<double> z(n + equations.parameters.size());
    for (double& x : z) x = number(random);
    const double t = number(random);
    std::vector<double> expected(results), found(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n));
    found.resize(std::max(n, results));
    replay(t, z.data(), expected.data());
    rates(t, found.data(), z.data() + n, found.data());
    for (std::size_t k = 0; k < results; ++k) {
      const double error = std::abs(found[k] - expected[k]) / std::max(1.0, std::abs(expected[k]));
      worst = std::isfinite(expected[k]) ? std::max(worst, error)
                                         : std::max(worst, std::isfinite(found[k]) ? 1.0 : 0.0);
    }
  }
  return worst;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t where = text.rfind(from);
  EXPECT_NE(where, std::string::npos);
  return text.replace(where, from.size(), to);
}

TEST(EmittedCpp, RandomTapesGiveWhatTheirReplaysGive) {
  std::vector<Equations> all;
  for (const unsigned seed : {1U, 2U, 3U}) all.push_back(random_equations(seed, 60));
  for (const unsigned seed : {4U, 5U}) all.push_back(rational_equations(seed, 40));
  all.push_back(random_equations(6, 2500));  // in parts
  all.push_back(named(record(6, 5,
                             [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
                               out[0] = z[4];
                               out[1] = Recorded(0.1_r);
                               out[2] = -z[0] - -z[5];
                               out[3] = z[1] - (z[2] - z[3] * (z[0] / (z[1] * z[2])));
                               out[4] = out[3];
                             }),
                      "plain"));
  all.push_back(random_equations(8, 60, true));
  std::vector<std::string> texts;
  for (const Equations& equations : all) texts.push_back(write_cpp(equations));
  EXPECT_NE(texts.back().find("std::atan("), std::string::npos);
  EXPECT_NE(texts.back().find("std::erf("), std::string::npos);
  EXPECT_NE(texts[5].find("random_6_rates_part_2("), std::string::npos);
  EXPECT_EQ(texts[0].find("_part_"), std::string::npos);
  EXPECT_NE(texts[1].find("sin(lambda"), std::string::npos) << "a coordinate keeps its name";
  const CompiledTexts compiled(texts);
  for (const Equations& equations : all) {
    std::string name = equations.system + "_rates";
    std::replace(name.begin(), name.end(), '-', '_');
    const Rates rates = compiled.function(name);
    ASSERT_NE(rates, nullptr) << name;
    // The same operations in the same order; functions of the library may differ in their last bit where the
    // compiler takes a sine and a cosine together.
    EXPECT_LE(emitted_difference(equations, rates), 1e-15) << name;
  }
}

TEST(EmittedCpp, AFaultInTheTextIsSeen) {
  const Equations equations = rational_equations(4, 40);
  const CompiledTexts compiled({changed(write_cpp(equations), " - ", " + ")});
  EXPECT_GT(emitted_difference(equations, compiled.function("rational_4_rates")), 1e-6);
}

TEST(EmittedCpp, ASingularSystemGivesWhatIsNoNumber) {
  const Equations equations =
      named(record(6, 1,
                   [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
                     const std::vector<Recorded> matrix{z[0], z[1], z[0] * 2, z[1] * 2}, right{z[2], z[3]};
                     out[0] = solve(matrix, right)[1];
                   }),
            "singular");
  const CompiledTexts compiled({write_cpp(equations)});
  const std::vector<double> z{1, 2, 3, 4};
  double result = 0;
  compiled.function("singular_rates")(0, z.data(), z.data(), &result);
  EXPECT_TRUE(std::isnan(result));
}

TEST(EmittedCpp, TheLengthOfATextGrowsWithItsTapeAlone) {
  // x <- x + x, over and over: the tree of the formula has 2^200 leaves.
  const Equations equations = named(record(6, 1,
                                           [](const Recorded&, In<Recorded> z, Out<Recorded> out) {
                                             Recorded x = z[0];
                                             for (int k = 0; k < 200; ++k) x = sin(x * z[1] + x);
                                             out[0] = x;
                                           }),
                                    "deep");
  for (const Emitter& emitter : emitters())
    EXPECT_LT(emitter.write(equations).size(), 30000U) << emitter.name;
}

}  // namespace
