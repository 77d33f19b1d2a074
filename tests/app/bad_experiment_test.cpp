// Experiments that are not well formed are refused: with one line that says where, exit status 2, and nothing
// written.
#include "command.hpp"

namespace {

using namespace pfaff::testing;
using Arguments = std::vector<std::string>;

const std::string good = R"(schema = 1
title = "A test"
[[method]]
label = "RK4"
integrator = "rk4"
[[case]]
name = "short"
system = "damped-oscillator"
time = "2"
steps = ["0.5"]
)";

// The experiment with `what` replaced, or `what` added at its end where it is not there.
void refused(const std::string& what, const std::string& by, const Arguments& fragments) {
  std::string text = good;
  if (what.empty()) {
    text += by;
  } else {
    ASSERT_NE(text.find(what), std::string::npos) << what;
    text.replace(text.find(what), what.size(), by);
  }
  const TemporaryDirectory files;
  write(files / "test.toml", text);
  SCOPED_TRACE(by);
  expect_refused({"compare", files / "test.toml", "--out", "out"}, fragments);
}

TEST(BadExperiment, UnknownKeys) {
  refused("title", "titel", {"test.toml", "'title' is missing"});
  refused("title = \"A test\"\n", "title = \"A test\"\nnote = []\n", {"unknown key 'note'", "'notes'?"});
  refused("", "stpes = [1]\n", {"[[case]]", "unknown key 'stpes'", "did you mean 'steps'?"});
  refused("label = \"RK4\"", "label = \"RK4\"\nintergator = 1", {"[[method]]", "did you mean 'integrator'?"});
  refused("", "[case.quick]\ntimes = 1\n", {"[case.quick]", "unknown key 'times'", "did you mean 'time'?"});
  refused("", "set = { mu = 1 }\n", {"case short", "unknown parameter 'mu'", "did you mean 'nu'?"});
  refused("", "conserved = \"enrgy\"\n",
          {"case short", "unknown invariant 'enrgy'", "did you mean 'energy'?"});
}

TEST(BadExperiment, UnknownNames) {
  refused("\"rk4\"", "\"rk5\"", {"method RK4", "unknown integrator 'rk5'", "did you mean 'rk4'?"});
  refused("damped-oscillator", "damped-oscilator", {"unknown system", "did you mean 'damped-oscillator'?"});
  refused("", "methods = [\"RK 4\"]\n", {"[[case]] short", "unknown method 'RK 4'", "did you mean 'RK4'?"});
  refused("", "precision = \"singel\"\n",
          {"test.toml [[case]], line 11", "'precision'", "unknown precision 'singel'"});
  refused("\"rk4\"", "\"verlet\"", {"verlet needs separable; damped-oscillator offers vector-field"});
}

TEST(BadExperiment, WrongTypes) {
  refused("steps = [\"0.5\"]", "steps = 0.5", {"[[case]], line 10: key 'steps': expected a list"});
  refused("steps = [\"0.5\"]", "steps = [[0.5]]", {"line 10: key 'steps': expected a number or a string"});
  refused("steps = [\"0.5\"]", "steps = []", {"line 10: key 'steps': expected at least one"});
  refused("time = \"2\"", "time = [2]", {"'time'", "expected a number or a string"});
  refused("", "set = 3\n", {"'set'", "expected a table"});
  refused("", "quick = 3\n", {"'quick'", "expected a table"});
  refused("[[case]]", "[case]", {"expected at least one [[case]]"});
  refused("[[method]]", "[[methods]]", {"expected at least one [[method]]"});
  refused("schema = 1", "schema = 2", {"'schema'", "expected 1, got 2"});
  refused("schema = 1\n", "", {"'schema' is missing"});
}

TEST(BadExperiment, NumbersOutOfRange) {
  refused("\"0.5\"", "\"-0.5\"", {"case short", "--step: expected a number > 0"});
  refused("\"0.5\"", "\"5\"", {"case short", "at most the duration 2"});
  refused("\"0.5\"", "\"half\"", {"'half'"});
  refused("\"2\"", "inf", {"'inf'"});
  refused("", "set = { nu = 11 }\n", {"case short", "'nu'", "0 .. 10", "'11'"});
  refused("", "initial = [1]\n", {"case short", "expected 2 numbers, got 1"});
  refused("", "initial = []\n", {"[[case]]", "'initial'", "empty list"});
}

TEST(BadExperiment, AutomaticSteps) {
  const std::string list = "steps = [\"0.5\"]", automatic = "steps = \"auto\"";
  refused(list, "steps = \"aut\"", {"[[case]], line 10", "'steps'", "expected a list", "\"auto\"", "'aut'"});
  refused(list, automatic + "\nreference = \"none\"", {"[[case]] short", "chooses by the distance"});
  refused(list, automatic + "\nevaluations = 20",
          {"[[case]], line 11", "'evaluations'", "100 .. 1e12", "'20'"});
  refused(list, automatic + "\nevaluations = \"many\"", {"'evaluations'", "'many'"});
  refused("", "evaluations = 1000\n", {"[[case]] short", "'evaluations'", "expected steps = \"auto\""});
  refused(list, automatic + "\nset = { mu = 1 }", {"case short", "unknown parameter 'mu'"});
  const std::string finding =
      "[[finding]]\ncase = \"short\"\nmeasure = \"error_max\"\nmethod = \"RK4\"\nrelation = "
      "\"stays-below\"\nbound = 1.0\n";
  refused(list, automatic + "\n" + finding + "step = 0.1", {"[[finding]]", "case short", "without 'than'"});
}

TEST(BadExperiment, ErrorsOfQuantities) {
  refused("", "error = \"energi\"\n", {"case short", "'error'", "unknown error 'energi'"});
  refused("", "error = \"energy\"\n", {"case short", "'error'", "expected a conserved quantity", "'energy'"});
  refused("", "error = \"solution\"\nreference = \"none\"\n",
          {"[[case]] short", "'error'", "name of a conserved quantity", "'solution'"});
}

TEST(BadExperiment, SyntaxErrorsNameTheLine) {
  refused("label = \"RK4\"", "label = RK4\"", {"test.toml:4:"});
  refused("", "initial = [1, 0\n", {"test.toml:11:"});
  refused("", "time = 3\n", {"test.toml:11:"});  // twice
}

TEST(BadExperiment, SeedsTolerancesAndReferences) {
  refused("", "seeds = \"many\"\n", {"[[case]] short", "'seeds'", "whole number", "'many'"});
  refused("", "seeds = -1\n", {"'seeds'", "'-1'"});
  refused("", "seeds = 3\n", {"case short", "unknown parameter", "seed"});
  refused("", "seeds = 0\n[case.quick]\nseeds = 3\n", {"[case.quick]", "'seeds'"});
  refused("", "reference = \"non\"\n", {"unknown reference 'non'", "did you mean 'none'?"});
  refused("", "structure = \"yes\"\n", {"unknown structure 'yes'"});
  refused("integrator = \"rk4\"", "integrator = \"rk4\"\ntolerance = \"1e-8\"",
          {"method RK4", "rk4 takes fixed steps only"});
  refused("integrator = \"rk4\"", "integrator = \"odeint-dopri5\"\ntolerance = [\"2\"]",
          {"--tolerance: expected a number in (0, 1], got '2'"});
}

TEST(BadExperiment, Findings) {
  const std::string finding =
      "[[finding]]\ncase = \"short\"\nmeasure = \"error_max\"\nmethod = \"RK4\"\nrelation = "
      "\"stays-below\"\n";
  refused("", finding, {"[[finding]]", "'than'", "'bound'"});
  refused("", finding + "bound = 1.0\nthan = \"RK4\"\n", {"expected one of the keys 'than'"});
  refused("", finding + "bound = -1\n", {"'bound'", "expected a number > 0", "'-1'"});
  refused("", finding + "than = \"RK\"\n", {"unknown method 'RK'", "did you mean 'RK4'?"});
  refused("", finding + "bound = 1.0\nat_least = 2\n", {"'at_least'", "expected at most 1", "got 2"});
  refused("", finding + "bound = 1.0\nstep = 0.1\n", {"no runs to compare at 0.1; there are runs at "});
  refused("", finding + "bound = 1.0\nbounds = 1\n", {"unknown key 'bounds'", "did you mean 'bound'?"});
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = finding + "bound = 1.0\n";
    return text.replace(text.find(what), what.size(), by);
  };
  refused("", with("error_max", "eror_max"), {"unknown measure 'eror_max'", "did you mean 'error_max'?"});
  refused("", with("\"short\"", "\"shrt\""), {"unknown case 'shrt'", "did you mean 'short'?"});
  refused("", with("stays-below", "below"), {"unknown relation 'below'"});
}

TEST(BadExperiment, SelectionsOfMethods) {
  const std::string schema = "schema = 1\n";
  const auto with = [&](const std::string& line, const Arguments& fragments) {
    refused(schema, schema + line + "\n", fragments);
  };
  with("methods = \"al\"", {"test.toml, line 2", "'methods'", "or methods = \"all\""});
  with("methods = { keeps = \"symplektic\" }",
       {"test.toml methods, line 2", "'keeps'", "unknown claim", "did you mean 'symplectic'?"});
  with("methods = { keep = \"symplectic\" }", {"line 2", "unknown key 'keep'", "did you mean 'keeps'?"});
  with("methods = { needs = [\"seperable\"] }", {"line 2", "unknown facet", "did you mean 'separable'?"});
  with("methods = { order = \"~ 4\" }", {"line 2", "'order'", "expected an order such as 4", "'~ 4'"});
  with("methods = { order = 4.5 }", {"line 2", "'order'", "'4.5'"});
  with("methods = { set = { stage = 3 } }", {"line 2", "'set'", "'stage'", "did you mean 'stages'?"});
  with("methods = { set = { stages = [] } }", {"line 2", "'stages'", "empty list"});
  refused("[[method]]\nlabel = \"RK4\"\nintegrator = \"rk4\"\n", "methods = { keeps = \"symplectic\" }\n",
          {"case short", "none of the methods selected fits"});
}

TEST(BadExperiment, Includes) {
  refused("schema = 1\n", "schema = 1\ninclude = \"missing.toml\"\n",
          {"test.toml, line 2", "'include'", "expected a TOML file", "'missing.toml'"});
  refused("schema = 1\n", "schema = 1\ninclude = \"test.toml\"\n", {"line 2", "'test.toml' includes itself"});
  refused("", "[case.quick]\ntitles = 1\n", {"[case.quick], line 12", "did you mean 'title'?"});
}

// Runs are kept by name: two that would share one directory are refused, not mixed.
TEST(BadExperiment, RunsWithTheSameName) {
  const std::string second = "[[method]]\nlabel = \"rk4\"\nintegrator = \"gauss\"\n";
  refused("[[case]]", second + "[[case]]", {"would share the directory runs/short-rk4-h0.5"});
  refused("[\"0.5\"]", "[\"0.5\", \"0.5\"]", {"would share the directory runs/short-rk4-h0.5"});
  refused("", good.substr(good.find("[[case]]")),
          {"cases 'short' and 'short' would share the names of their figures"});
}

}  // namespace
