// Random methods as text: tables of coefficients whose numbers mostly fulfil their order conditions, and maps
// of random expressions.
#include <array>

#include "grammar.hpp"

namespace pfaff::fuzz {

namespace {
// Tables that are what they say, and of which one line or more is then made odd.
struct Sample {
  const char* kind;
  const char* order;
  const char* keys;
};
constexpr std::array samples{
    Sample{"splitting", "2", "drift = [0.5, \"1/2\"]\nkick = [1]\n"},
    Sample{"splitting", "1", "first = \"kick\"\ndrift = [1]\nkick = [1]\npreserves = [\"symplectic\"]\n"},
    Sample{"splitting", "4",
           "let = { g = \"1/(2 - 2^(1/3))\", k = \"1 - 2*g\" }\n"
           "drift = [\"g/2\", \"(g + k)/2\", \"(g + k)/2\", \"g/2\"]\nkick = [\"g\", \"k\", \"g\"]\n"},
    Sample{"rkn-splitting", "2", "drift = [\"vector(i, 1, 2, 1/2)\"]\nkick = [1.0]\n"},
    Sample{"runge-kutta", "1", "a = [[]]\nb = [1]\n"},
    Sample{"runge-kutta", "2", "a = [[\"1/2\"]]\nb = [1]\n"},
    Sample{"runge-kutta", "4",
           "a = [[], [\"1/2\"], [0, 0.5], [0, 0, 1]]\nb = [\"1/6\", \"1/3\", \"1/3\", \"1/6\"]\nc = [0, "
           "0.5, 0.5, 1]\n"},
    Sample{"runge-kutta", "4",
           "let = { s = \"sqrt(3)/6\" }\na = [[\"1/4\", \"1/4 - s\"], [\"1/4 + s\", \"1/4\"]]\nb = [0.5, "
           "0.5]\npreserves = [\"symplectic\", \"symmetric\"]\n"},
    Sample{"composition", "4",
           "base = \"verlet\"\nlet = { g = \"1/(2 - 2^(1/3))\" }\nweights = [\"g\", \"1 - 2*g\", \"g\"]\n"},
    Sample{"composition", "2", "base = \"verlet(compensated=no)\"\nweights = [0.25, 0.75]\n"},
    Sample{"processed", "2",
           "pre = { first = \"drift\", drift = [\"-1/2\"], kick = [0] }\nkernel = { drift = [1], kick = [1] "
           "}\n"},
    Sample{"multistep", "2", "rho = [0, -1, 1]\nsigma = [\"-1/2\", \"3/2\", 0]\n"},
    Sample{"multistep", "2", "rho = [-1, 0, 1]\nsigma = [0, 2, 0]\n"},
    Sample{"multistep", "4", "rho = [-1, 0, 1]\nsigma = [\"1/3\", \"4/3\", \"1/3\"]\n"},
};

std::string assignment(const std::string& name, const std::string& right) {
  return '"' + name + " = " + right + '"';
}

// A map: of the whole state, of positions and momenta, or of the coordinates of one system.
std::string random_map(Choices& choices) {
  std::string text =
      "name = \"fuzz-map\"\nkind = \"map\"\norder = " + std::to_string(1 + choices.below(3)) + '\n';
  if (choices.once_in(2)) text += "let = { r = \"1/2\", s = \"r^2\" }\n";
  if (choices.once_in(2)) text += "parameters = { a = { value = 1, range = [0, 10] }, n = 2 }\n";
  if (choices.once_in(3)) text += "preserves = [\"symplectic\"]\n";
  std::string step;
  switch (choices.below(3)) {
    case 0:
      step =
          assignment("k", "field(t + h/2, " + random_expression(choices, "z") + ")") + ", " +
          assignment("z", choices.one_of({"z + h*(", "z - (", "("}) + random_expression(choices, "k") + ")");
      break;
    case 1:
      step = assignment("p", "p + h*force(" + random_expression(choices, "t") + ", q)") + ", " +
             assignment("q", "q + h*velocity(t, " + random_expression(choices, "p") + ")");
      break;
    default:
      text += "system = \"damped-pendulum\"\ncoordinates = [\"r\", \"p\"]\nsystem_parameters = [\"nu\"]\n";
      step = assignment("p", "p - h*(" + random_expression(choices, "r") + ")") + ", " +
             assignment("r", "r + h*nu*(" + random_expression(choices, "p") + ")");
  }
  return text + "step = [" + step + "]\n";
}
}  // namespace

std::string random_table(Choices& choices) {
  if (choices.once_in(3)) return random_map(choices);
  const Sample& sample = choices.one_of(samples);
  std::string text = std::string("name = \"") +
                     choices.one_of({"fuzz-table", "fuzz-table-with-a-long-name"}) + "\"\nkind = \"" +
                     std::string(sample.kind) + "\"\norder = " + sample.order + '\n';
  if (choices.once_in(4))
    text += "title = \"A table\"\nreference = \"none\"\ndescription = \"Of numbers.\"\n";
  if (choices.once_in(8)) text += "precision = \"double\"\n";
  return text + sample.keys;
}

}  // namespace pfaff::fuzz
