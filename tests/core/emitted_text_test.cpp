// Emitted SymPy, LaTeX, Mathematica and Julia are read back by a program that shares no code with Pfaff
// (check_emitted.py): what they compute, or that they are well formed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../temporary_directory.hpp"
#include "emitted_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

std::string exact(const Real& x) {
  if (x.is_fraction()) return std::to_string(x.numerator()) + "/" + std::to_string(x.denominator());
  return to_scientific(x.quad(), 36);
}

constexpr std::array<const char*, 18> operation_names{
    "constant", "time", "input", "negate", "add",   "subtract", "multiply", "divide", "sqrt",
    "exp",      "log",  "sin",   "cos",    "power", "special",  "select",   "solve",  "solve_next"};

// In the order of SpecialFunction.
constexpr std::array<const char*, 4> special_names{"atan", "erf", "sinh", "tanh"};

// A tape with points at which to evaluate it, for a reader that is no C++.
nlohmann::json described(const Equations& equations, bool rational) {
  const Tape& tape = equations.tape;
  nlohmann::json j{{"rational", rational}, {"inputs", tape.inputs}, {"outputs", tape.outputs}};
  j["code"] = j["constants"] = j["solves"] = j["points"] = nlohmann::json::array();
  bool irrational = false;
  for (const Instruction& i : tape.code)
    j["code"].push_back({i.operation == Operation::special
                             ? special_names.at(static_cast<std::size_t>(i.c))
                             : operation_names.at(static_cast<std::size_t>(i.operation)),
                         i.a, i.b, i.c});
  for (const Real& c : tape.constants) {
    j["constants"].push_back(exact(c));
    irrational = irrational || !c.is_fraction();
  }
  j["irrational_constants"] = irrational;
  for (const LinearSystem& s : tape.solves)
    j["solves"].push_back({{"size", s.size}, {"matrix", s.matrix}, {"right_hand_side", s.right_hand_side}});
  std::mt19937 random(11);
  Replay<Quad> replay(std::make_shared<const Tape>(tape));
  for (int point = 0; point < 2; ++point) {
    std::vector<std::string> texts;
    std::vector<Quad> z;
    for (int k = 0; k <= tape.inputs; ++k) {  // the last is the time
      const Real x = Real::fraction(static_cast<int>(random() % 41) - 20, 7 + static_cast<int>(random() % 5));
      texts.push_back(exact(x));
      z.push_back(x.quad());
    }
    std::vector<Quad> results(tape.outputs.size());
    replay(z.back(), z.data(), results.data());
    std::vector<std::string> quad;
    for (const Quad& x : results) quad.push_back(to_scientific(x, 36));
    const std::string time = texts.back();
    texts.pop_back();
    j["points"].push_back({{"t", time}, {"z", texts}, {"quad", quad}});
  }
  return j;
}

class EmittedText : public ::testing::Test {
 protected:
  void write(const Equations& equations, bool rational) {
    const std::string path = directory_ / equations.system;
    std::ofstream(path + ".json") << described(equations, rational);
    std::ofstream(path + ".py") << write_sympy(equations);
    std::ofstream(path + ".tex") << write_latex(equations);
    std::ofstream(path + ".wl") << write_mathematica(equations);
    std::ofstream(path + ".jl") << write_julia(equations);
  }
  // Puts `to` in the place of the last `from` in a text.
  void spoil(const std::string& file, const std::string& from, const std::string& to) {
    std::ifstream in(directory_ / file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t where = text.rfind(from);
    ASSERT_NE(where, std::string::npos) << file;
    std::ofstream(directory_ / file) << text.replace(where, from.size(), to);
  }
  // What the reader says, and its exit status. The system's Python is the one that has SymPy's package.
  std::pair<int, std::string> read_back() {
    const std::string python = std::ifstream("/usr/bin/python3").good() ? "/usr/bin/python3" : "python3";
    const std::string said = directory_ / "said";
    const int status = std::system((python + " -B '" PFAFF_GOLDEN "/../core/check_emitted.py' '" +
                                    directory_.path().string() + "' >'" + said + "' 2>&1")
                                       .c_str());
    std::ifstream in(said);
    return {status, {std::istreambuf_iterator<char>(in), {}}};
  }

 private:
  TemporaryDirectory directory_;
};

TEST_F(EmittedText, RandomTapesAreWhatTheirTextsCompute) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) write(rational_equations(seed, 30), true);
  for (const unsigned seed : {5U, 6U, 7U}) write(random_equations(seed, 40), false);
  write(random_equations(8, 60, true), false);
  // Numbers of every kind: negative, small and large fractions, those of quad precision; signs where they
  // matter.
  write(named(record(6, 5,
                     [](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
                       const Recorded root(sqrt(Real(2)));
                       out[0] = root * z[0] - 1e-12_r * z[1] + (2500000000_r * z[2] - t) / 3;
                       out[1] = pow(z[3] * z[3] + 1, -0.3_r) * -root - -z[4];
                       out[2] = Recorded(-0.5_r);
                       out[3] = z[0] - (z[1] - (z[2] + (z[3] - z[4] * (z[5] * 4)))) + -z[0];
                       out[4] = (z[0] + 2) * (z[0] + 2) / (-z[1] - 20) * -0.1_r;
                     }),
              "numbers"),
        false);
  const auto [status, said] = read_back();
  EXPECT_EQ(status, 0) << said;
  EXPECT_EQ(said, "9 samples agree\n");
}

TEST_F(EmittedText, FaultsInTheTextsAreSeen) {
  write(rational_equations(2, 30), true);
  ASSERT_EQ(read_back().first, 0);
  spoil("rational-2.py", " + ", " - ");
  spoil("rational-2.tex", " - ", " + ");
  spoil("rational-2.wl", "]", ")");
  spoil("rational-2.jl", "v1", "v0");
  const auto [status, said] = read_back();
  EXPECT_NE(status, 0);
  for (const char* language : {"sympy", "latex", "julia", "mathematica"})
    EXPECT_NE(said.find("rational-2, " + std::string(language)), std::string::npos) << language << '\n'
                                                                                    << said;
}

}  // namespace
