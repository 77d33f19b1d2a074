// Random systems and brackets written as text: expressions of every operation over the names that a model
// declares, of every kind of motion.
#include "grammar.hpp"

namespace pfaff::fuzz {

namespace {
class Expressions {
 public:
  explicit Expressions(Choices& choices) : choices_(choices) {}
  // An expression that reads one name mostly.
  std::string expression(const std::string& name) {
    if (++depth_ > 6 || choices_.once_in(3)) {
      --depth_;
      if (choices_.once_in(60)) return choices_.one_of({"r", "s", "x", "q", "p", "q[2]", "0"});
      if (choices_.once_in(30)) return random_number(choices_);
      return choices_.once_in(4) ? choices_.one_of({"t", "a", "n", "pi", "1/3"}) : name;
    }
    const std::string x = expression(name);
    std::string result;
    switch (choices_.below(9)) {
      case 0:
        result = x + " + " + expression(name);
        break;
      case 1:
        result = x + " - " + expression(name);
        break;
      case 2:
        result = "(" + x + ")*(" + expression(name) + ")";
        break;
      case 3:
        result = x + "/(" + expression(name) + ")";
        break;
      case 4:
        result = "(" + x + ")^" + choices_.one_of({"2", "3", "-1", "(1/2)", "a", "0", "2.5", "t"});
        break;
      case 5:
        result =
            std::string(choices_.one_of({"sqrt(", "exp(", "log(", "sin(", "cos(", "tan(", "-("})) + x + ")";
        break;
      case 6: {
        const std::string index = "i" + std::to_string(depth_);
        result = "sum(" + index + choices_.one_of({", 1, n, ", ", 2, 5, "}) + index + "*(" + x + "))";
        break;
      }
      case 7:
        result = "pow(" + x + ", " + expression(name) + ")";
        break;
      default:
        result = x;
        if (choices_.once_in(20))
          result +=
              choices_.one_of({" ", ")", "(", "*", "[1]", "^^", " < 1", ",", "$", " + vector(i, 1, 2, i)"});
        break;
    }
    --depth_;
    return result;
  }

 private:
  Choices& choices_;
  int depth_ = 0;
};

std::string list(const std::string& first, const std::string& second) {
  return "[" + quoted(first) + ", " + quoted(second) + "]";
}

class TextModel {
 public:
  explicit TextModel(Choices& choices) : choices_(choices), several_(choices.once_in(3)) {}

  std::string text() {
    add("coordinates", several_ ? "{ q = \"n\", p = \"n\" }" : "[\"q\", \"p\"]");
    if (choices_.once_in(2))
      add("initial", several_ ? "[\"vector(i, 1, 2*n, 1/(i + 1))\"]" : "[0.5, \"1/3\"]");
    add("parameters", "{ a = { value = 2, range = [0, 10], unit = \"1/s\" }, n = " +
                          std::to_string(1 + choices_.below(4)) + " }");
    if (choices_.once_in(2))
      add("let", "{ r = " + quoted(expression("a")) + ", s = " + quoted("r + " + expression("t")) + " }");
    add_motion();
    if (choices_.once_in(3)) add("invariants", "{ " + invariant() + " }");
    if (choices_.once_in(4)) add("reversal", list(q(), "-" + p()));
    if (choices_.once_in(5))
      add("holonomic", choices_.once_in(2) ? "[" + quoted(positions()) + "]"
                                           : "{ " + name("rod") + " = " + quoted(positions()) + " }");
    if (choices_.once_in(6))
      add("velocity_constraints",
          "[{ row = [" + quoted(positions()) + "], b = 1, name = " + quoted(name("blade")) + " }]");
    if (choices_.once_in(12))
      add("parts", choices_.once_in(3)
                       ? "\"kepler\""
                       : "[{ name = " + quoted(name("whole")) + ", change = " + list(both(), both()) + " }]");
    if (choices_.once_in(12)) add("friction", "[" + quoted(both() + "^2") + "]");
    if (choices_.once_in(12)) add("exact_solution", list(q() + " + " + p() + "*elapsed", p() + " - t0"));
    if (choices_.once_in(12)) add("constraints", list(q(), p()));
    if (choices_.once_in(12))
      add("alpha",
          "{ w_hat = " + list("new_q - old_q", "new_p") + ", w = " + list("old_q", "new_p*t0") + " }");
    return text_;
  }

 private:
  void add(const std::string& key, const std::string& value) { text_ += key + " = " + value + '\n'; }
  std::string expression(const std::string& name) { return random_expression(choices_, name); }
  [[nodiscard]] std::string q() const { return several_ ? "q[1]" : "q"; }
  [[nodiscard]] std::string p() const { return several_ ? "p[n]" : "p"; }
  std::string positions() { return expression(q()); }
  std::string momenta() { return p() + "^2/2 + " + expression(p()); }
  std::string both() { return expression(q()) + " + " + expression(p()); }

  // A name, every other one too long for the memory of a string itself, which holds 15 characters.
  std::string name(const std::string& text) {
    return choices_.once_in(2) ? text + "-of-the-whole-model" : text;
  }
  // Of one value, or of a table in which something may be missing or of another kind.
  std::string invariant() {
    const std::string what = name(choices_.one_of({"H", "angular-momentum"})) + " = ";
    switch (choices_.below(6)) {
      case 0:
        return what + quoted(both());
      case 1:
        return what + quoted(both() + choices_.one_of({" +", ")", "", "[1]", "*sin"}));
      case 2:
        return what + "{ unit = " + quoted(name("kg m^2/s")) + " }";
      case 3:
        return what +
               choices_.one_of({"true", "[]", "{ of = true }", "{ of = {} }", "{ of = \"q\", unit = 1 }"});
      case 4:
        return what + "{ of = " + quoted(both()) + ", unit = " + quoted(name("J")) + ", behaviour = " +
               quoted(choices_.one_of({"conserved", "free", "decreasing", "is-no-behaviour-at-all"})) + " }";
      default:
        return what + "{ of = " + quoted(both()) + ", quadratic = true }";
    }
  }

  void add_motion() {
    switch (choices_.below(7)) {
      case 0:
        add("kinetic", quoted(momenta()));
        add("potential", quoted(positions()));
        if (choices_.once_in(3)) add("damping", quoted("a/2"));
        return;
      case 1:
        add("hamiltonian", quoted(both()));
        if (choices_.once_in(2))
          add("bracket", choices_.one_of({"\"canonical(degrees=1)\"", "[[\"0\", \"q\"], [\"-q\", \"0\"]]",
                                          "\"lie-poisson\""}));
        if (choices_.once_in(3)) {
          add("symmetric_bracket", "[[\"0\", \"0\"], [\"0\", \"a\"]]");
          if (choices_.once_in(2)) add("entropy", quoted(both()));
        }
        return;
      case 2:
        add("field", list(both(), both()));
        return;
      case 3:
        add("birkhoffian", quoted(both()));
        add("one_form", list(p() + "*" + both(), "-" + q()));
        if (choices_.once_in(2)) {
          add("chart", list(q(), "exp(a*t)*" + p()));
          add("chart_inverse", list("y[1]", "exp(-a*t)*y[2]"));
        }
        return;
      case 4:
        add("structure", "[[\"0\", \"-1\"], [\"1\", \"0\"]]");
        add("covector", list(both(), both()));
        return;
      case 5:
        add("lagrangian", quoted(choices_.one_of({"v[1]^2/2*(2 + ", "v[1]^4 + (", "v[1] + (",
                                                  "sum(k, 1, n, v[k]^2)/2 + ("}) +
                                 positions() + ")"));
        return;
      default:
        add("hamiltonian", quoted(both()));
        add("constraints", choices_.once_in(2) ? list(positions(), momenta()) : "[" + quoted(both()) + "]");
        return;
    }
  }

  Choices& choices_;
  bool several_;
  std::string text_;
};
}  // namespace

std::string random_expression(Choices& choices, const std::string& name) {
  return Expressions(choices).expression(name);
}

std::string random_text_model(Choices& choices) { return TextModel(choices).text(); }

std::string random_text_bracket(Choices& choices) {
  const bool several = choices.once_in(3);
  const std::string x = several ? "z[1]" : "x", y = several ? "z[n]" : "y";
  std::string text =
      several ? "coordinates = { z = \"n\" }\n" : "coordinates = [\"x\", { name = \"y\", unit = \"m\" }]\n";
  text += "parameters = { a = { value = 2, range = [0, 10] }, n = " + std::to_string(1 + choices.below(3)) +
          " }\n";
  if (choices.once_in(2))
    text += "let = { r = " + quoted(random_expression(choices, x)) + ", s = \"2*r\" }\n";
  const std::string entry = choices.once_in(3) ? "r" : random_expression(choices, choices.once_in(2) ? x : y);
  const std::string symmetry = choices.one_of({"skew", "skew", "symmetric", "none"});
  if (several && choices.once_in(2)) {
    text += "tensor = [[\"vector(i, 1, n^2, " + entry + ")\"]]\n";
  } else {
    const std::string other = symmetry == "skew" ? "-(" + entry + ")" : entry;
    text += "tensor = [" + list("0", entry) + ", " + list(other, symmetry == "skew" ? "0" : "a") + "]\n";
  }
  text += "symmetry = \"" + symmetry + "\"\n";
  if (choices.once_in(2)) text += std::string("jacobi = ") + choices.one_of({"true", "false", "1"}) + '\n';
  if (choices.once_in(4)) text += "semimetric = true\n";
  if (choices.once_in(3)) text += "casimirs = [" + quoted(random_expression(choices, x)) + "]\n";
  if (choices.once_in(5)) text += "title = \"A bracket\"\nreference = \"none\"\nname = \"a-bracket\"\n";
  return text;
}

}  // namespace pfaff::fuzz
