// Prints a polynomial system as the source of a plug-in.
#include <algorithm>
#include <array>

#include <pfaff/bench/random_systems/polynomial_system.hpp>

namespace pfaff {

namespace {

// How an author writes a formula: what it reads and what it writes, or no name there for a value.
struct Signature {
  Formula formula;
  std::string_view name, reads, writes;
};
constexpr std::array signatures{Signature{Formula::field, "field", "z", "rate"},
                                Signature{Formula::hamiltonian, "hamiltonian", "z", ""},
                                Signature{Formula::kinetic, "kinetic", "p", ""},
                                Signature{Formula::potential, "potential", "q", ""},
                                Signature{Formula::birkhoffian, "birkhoffian", "z", ""},
                                Signature{Formula::one_form, "one_form", "z", "form"},
                                Signature{Formula::chart, "chart", "z", "y"},
                                Signature{Formula::chart_inverse, "chart_inverse", "y", "z"},
                                Signature{Formula::holonomic, "holonomic", "q", "phi"},
                                Signature{Formula::constraints, "constraints", "z", "phi"},
                                Signature{Formula::velocity_constraints, "velocity_constraints", "q", "rows"},
                                Signature{Formula::entropy, "entropy", "z", ""},
                                Signature{Formula::invariants, "invariants", "z", "values"},
                                Signature{Formula::reversal, "reversal", "z", "reversed"}};

std::string element(std::string_view of, std::size_t k) {
  return std::string(of) + "[" + std::to_string(k) + "]";
}

std::function<std::string(std::size_t)> named(std::string_view of, std::size_t variables) {
  return [=](std::size_t k) { return k == variables ? "t" : element(of, k); };
}

// `name` as the name of a parameter, in comments where no polynomial uses it.
std::string parameter_name(const std::string& name, bool used) {
  return used ? " " + name : " /*" + name + "*/";
}

// "const T& t, In<T> z", with the names that are used.
std::string arguments(const Polynomials& polynomials, std::string_view reads) {
  bool time = false, state = false;
  for (const SparsePolynomial& p : polynomials) {
    time = time || p.depends_on(p.variables());
    for (std::size_t k = 0; k < p.variables(); ++k) state = state || p.depends_on(k);
  }
  return "const T&" + parameter_name("t", time) + ", In<T>" + parameter_name(std::string(reads), state);
}

std::string text_of(const SparsePolynomial& p, std::string_view reads) {
  return p.text(named(reads, p.variables()));
}

// A function as a factor of a product.
std::string text_of(const AppliedFunction& f, std::string_view reads) {
  const std::string x = element(reads, f.variable);
  switch (f.function) {
    case Function::sine:
      return "sin(" + x + ")";
    case Function::exponential:
      return "exp(" + x + ")";
    case Function::root:
      return "sqrt(1 + " + x + " * " + x + ")";
    case Function::bell:
      break;
  }
  return "(1 / (1 + " + x + " * " + x + "))";
}

// The polynomial, whose last variables stand for functions.
std::string text_of(const SparsePolynomial& p, const std::vector<AppliedFunction>& applied,
                    std::string_view reads) {
  const std::size_t read = p.variables() - applied.size();
  return p.text([&](std::size_t k) {
    return k == p.variables() ? "t" : k < read ? element(reads, k) : text_of(applied[k - read], reads);
  });
}

// The polynomial as a factor: in parentheses where it has several terms or a sign.
std::string grouped(const SparsePolynomial& p, std::string_view reads) {
  const std::string text = text_of(p, reads);
  return p.terms().size() > 1 || text.starts_with('-') ? "(" + text + ")" : text;
}

std::string member(const Signature& s, const PolynomialSystem& system) {
  const Polynomials& results = system.formulas.at(s.formula);
  Polynomials all = results;
  const bool divided = s.formula == Formula::chart_inverse && !system.chart_divisors.empty();
  if (divided) all.insert(all.end(), system.chart_divisors.begin(), system.chart_divisors.end());
  const auto found = system.applied.find(s.formula);
  const auto applied = found == system.applied.end() ? std::vector<AppliedFunction>() : found->second;
  const std::string name(s.name);
  std::string text = "  template <class T>\n";
  if (s.writes.empty())
    return text + "  T " + name + "(" + arguments(all, s.reads) + ") const {\n    return " +
           text_of(results.front(), applied, s.reads) + ";\n  }\n";
  text +=
      "  void " + name + "(" + arguments(all, s.reads) + ", Out<T> " + std::string(s.writes) + ") const {\n";
  for (std::size_t k = 0; k < results.size(); ++k) {
    std::string value = text_of(results[k], applied, s.reads);
    if (divided && system.chart_divisors[k].degree() > 0)
      value = grouped(results[k], s.reads) + " / (" + text_of(system.chart_divisors[k], s.reads) + ")";
    text += "    " + element(s.writes, k) + " = " + value + ";\n";
  }
  return text + "  }\n";
}

// alpha, whose polynomials are in (new_z, old_z, t0) and t.
std::string alpha_member(const Polynomials& results, std::size_t n) {
  const auto name = [n](std::size_t k) {
    return k < n        ? element("new_z", k)
           : k < 2 * n  ? element("old_z", k - n)
           : k == 2 * n ? std::string("t0")
                        : std::string("t");
  };
  const auto used = [&](std::size_t k) {
    return std::any_of(results.begin(), results.end(), [k](const auto& p) { return p.depends_on(k); });
  };
  std::string text = "  template <class T>\n  void alpha(const T&" + parameter_name("t", used(2 * n + 1)) +
                     ", const T&" + parameter_name("t0", used(2 * n)) +
                     ", In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {\n";
  for (std::size_t k = 0; k < 2 * n; ++k)
    text +=
        "    " + (k < n ? element("w_hat", k) : element("w", k - n)) + " = " + results[k].text(name) + ";\n";
  return text + "  }\n";
}

// A bracket with this tensor, n x n row-major, and these Casimirs.
std::string bracket(const std::string& type, const Polynomials& tensor, const Polynomials& casimirs,
                    std::size_t n) {
  std::string text = "struct " + type + " {\n";
  if (!casimirs.empty()) {
    text += "  [[nodiscard]] int casimir_count() const { return " + std::to_string(casimirs.size()) +
            "; }\n  template <class T>\n  void casimirs(" + arguments(casimirs, "z") +
            ", Out<T> values) const {\n";
    for (std::size_t k = 0; k < casimirs.size(); ++k)
      text += "    " + element("values", k) + " = " + text_of(casimirs[k], "z") + ";\n";
    text += "  }\n";
  }
  std::string lines;
  bool used = false;
  for (std::size_t i = 0; i < n; ++i) {
    std::string sum;
    for (std::size_t j = 0; j < n; ++j)
      if (const SparsePolynomial& entry = tensor[i * n + j]; !entry.zero())
        sum += (sum.empty() ? "" : " + ") + grouped(entry, "z") + " * " + element("covector", j);
    used = used || !sum.empty();
    lines += "    " + element("vector", i) + " = " + (sum.empty() ? "T(0)" : sum) + ";\n";
  }
  return text + "  template <class T>\n  void sharp(" + arguments(tensor, "z") + ", In<T>" +
         parameter_name("covector", used) + ", Out<T> vector) const {\n" + lines + "  }\n};\n\n";
}

std::string listed(const std::vector<Invariant>& invariants) {
  std::string text;
  for (const Invariant& i : invariants) {
    const std::string behaviour(to_string(i.behaviour));
    text += (text.empty() ? "" : ", ") + ("{\"" + i.name + "\", \"\", Behaviour::") + behaviour + ", " +
            (i.quadratic ? "true" : "false") + "}";
  }
  return text;
}

// The last place before `limit` where a line may be broken: a space outside of texts in quotes. npos where
// there is none.
std::size_t break_of(const std::string& line, std::size_t limit) {
  std::size_t place = std::string::npos;
  bool quoted = false;
  for (std::size_t k = 0; k < limit; ++k) {
    if (line[k] == '"') quoted = !quoted;
    if (line[k] == ' ' && !quoted && k >= 16) place = k;
  }
  return place;
}

// Breaks lines that are longer than 110 columns, with an indent of eight. Comments stay as they are.
std::string broken(const std::string& source) {
  constexpr std::size_t most = 110;
  std::string text;
  for (std::size_t begin = 0; begin < source.size();) {
    const std::size_t end = source.find('\n', begin);
    std::string line = source.substr(begin, end - begin);
    while (line.size() > most && !line.starts_with("//")) {
      const std::size_t space = break_of(line, most);
      if (space == std::string::npos || line.find_first_not_of(' ') > space) break;
      text += line.substr(0, space) + '\n';
      line = "        " + line.substr(space + 1);
    }
    text += line + '\n';
    begin = end + 1;
  }
  return text;
}

}  // namespace

std::string plugin_source(const PolynomialSystem& system, const std::vector<std::string>& comment) {
  const auto has = [&](Formula f) { return system.formulas.contains(f); };
  const auto of = [&](Formula f) { return has(f) ? system.formulas.at(f) : Polynomials(); };
  std::string text;
  for (const std::string& line : comment) text += line.empty() ? "//\n" : "// " + line + "\n";
  text += "#include <pfaff/core/system.hpp>\n\nnamespace {\nusing namespace pfaff;\n\n";
  if (has(Formula::poisson_tensor))
    text += bracket("PoissonBracket", of(Formula::poisson_tensor), of(Formula::casimirs), system.dimension);
  if (has(Formula::symmetric_tensor))
    text += bracket("SymmetricBracket", of(Formula::symmetric_tensor), {}, system.dimension);
  text += "struct Found {\n  static constexpr int dimension = " + std::to_string(system.dimension) + ";\n";
  for (const Formula f : {Formula::holonomic, Formula::constraints})
    if (has(f)) text += "  static constexpr int constraint_count = " + std::to_string(of(f).size()) + ";\n";
  if (has(Formula::velocity_constraints))
    text += "  static constexpr int velocity_constraint_count = " +
            std::to_string(of(Formula::velocity_constraints).size() / (system.dimension / 2)) + ";\n";
  if (has(Formula::poisson_tensor)) text += "  [[nodiscard]] PoissonBracket bracket() const { return {}; }\n";
  if (has(Formula::symmetric_tensor))
    text += "  [[nodiscard]] SymmetricBracket symmetric_bracket() const { return {}; }\n";
  if (system.damping)
    text += "  [[nodiscard]] Real damping() const { return " + cpp_constant(*system.damping) + "; }\n";
  for (const Signature& s : signatures)
    if (has(s.formula)) text += member(s, system);
  if (has(Formula::alpha)) text += alpha_member(of(Formula::alpha), system.dimension);
  std::string initial;
  for (const Real& x : system.initial) initial += (initial.empty() ? "" : ", ") + cpp_constant(x);
  text += "};\n\nconst System<Found> registered{{.name = \"" + system.name + "\",\n";
  text += "                                .title = \"" + system.title + "\",\n";
  text += "                                .reference = \"\",\n";
  text += "                                .initial = {" + initial + "}";
  if (!system.invariants.empty())
    text += ",\n                                .invariants = {" + listed(system.invariants) + "}";
  return broken(text + "}};\n}  // namespace\n");
}

}  // namespace pfaff
