// The claims of brackets: symmetry, Jacobi's identity and Casimirs, measured at random points drawn with a
// fixed seed.
#include <pfaff/core/bracket.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::shared_ptr<const Tape> jacobiator(const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto pi = evaluate(tensor, t, z);
    const auto slope = jacobian(tensor, t, z);  // slope[(i n + j) n + l]
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t k = 0; k < size; ++k) {
          Recorded sum(0);
          for (std::size_t l = 0; l < size; ++l)
            sum = sum + pi[i * size + l] * slope[(j * size + k) * size + l] +
                  pi[j * size + l] * slope[(k * size + i) * size + l] +
                  pi[k * size + l] * slope[(i * size + j) * size + l];
          out[(i * size + j) * size + k] = sum;
        }
  });
}

std::shared_ptr<const Tape> sharp_of_casimirs(const Tape& tensor, const Tape& casimirs) {
  const auto size = static_cast<std::size_t>(casimirs.inputs);
  return expression(casimirs.inputs, static_cast<int>(casimirs.outputs.size() * size),
                    [&](const Recorded& t, Arguments z, Results out) {
                      const auto pi = evaluate(tensor, t, z), slopes = jacobian(casimirs, t, z);
                      for (std::size_t c = 0; c * size < slopes.size(); ++c)
                        for (std::size_t i = 0; i < size; ++i)
                          for (std::size_t j = 0; j < size; ++j)
                            out[c * size + i] = out[c * size + i] + pi[i * size + j] * slopes[c * size + j];
                    });
}

namespace {
// The tensor of a sharp map, recorded column by column.
std::shared_ptr<const Tape> tensor_of(const Tape& sharp, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    for (std::size_t j = 0; j < size; ++j) {
      std::vector<Recorded> x(z.begin(), z.end());
      x.resize(2 * size);
      x[size + j] = Recorded(1);
      const auto column = evaluate(sharp, t, x);
      for (std::size_t i = 0; i < size; ++i) out[i * size + j] = column[i];
    }
  });
}
std::shared_ptr<const Tape> skew_part(const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto g = evaluate(tensor, t, z);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) out[i * size + j] = g[i * size + j] - g[j * size + i];
  });
}
std::vector<Real> bracket_point(int n) {
  std::vector<Real> z;
  for (int k = 0; k < n; ++k) z.push_back(Real::fraction(3 + 2 * k, 7));
  return z;
}
// States of all sizes up to ten, with coordinates that are positive, as sizes and temperatures are.
Region bracket_region(int n) {
  Region region(bracket_point(n));
  for (const std::int64_t factor : {2, 4, 8}) {
    std::vector<Real> z;
    for (const Real& x : bracket_point(n)) z.push_back(Real::fraction(factor, 2) * x);
    region.centres.push_back(std::move(z));
    region.times.push_back(1);
  }
  return region;
}
}  // namespace

std::vector<Check> check_bracket(const BracketPlugin& plugin, const Assignments& parameters) {
  const BracketInstance bracket = plugin.make(parameters);
  const int n = bracket.dimension;
  const auto tensor = tensor_of(*bracket.sharp, n);
  Region centre = bracket_region(n);
  centre.box = bracket.ranges;
  std::vector<Check> checks;
  if (plugin.descriptor().symmetry == Symmetry::skew)
    both(checks, plugin.name(), "skew", "", symmetric_part(*tensor, n), centre);
  if (plugin.descriptor().symmetry == Symmetry::symmetric)
    both(checks, plugin.name(), "symmetric", "", skew_part(*tensor, n), centre);
  if (plugin.descriptor().jacobi)
    both(checks, plugin.name(), "Jacobi identity", "", jacobiator(*tensor, n), centre);
  if (plugin.descriptor().semimetric)
    for (Check& check : check_not_negative(plugin.name(), "semimetric", "", tensor, centre))
      checks.push_back(std::move(check));
  if (bracket.casimirs != nullptr)
    both(checks, plugin.name(), "Casimirs", "", sharp_of_casimirs(*tensor, *bracket.casimirs), centre);
  for (Check& check : checks) check.parameters = parameters;
  return checks;
}

std::vector<Assignments> instances_of(const BracketPlugin& plugin) {
  std::vector<Assignments> instances{{}};
  for (const Parameter& p : plugin.parameters())
    if (p.kind == Parameter::Kind::choice)
      for (std::size_t k = 1; k < p.choices.size(); ++k) instances.push_back({{p.name, p.choices[k]}});
  return instances;
}

std::vector<Check> check_false_brackets() {
  std::vector<Check> checks;
  // {f, g} = a.(grad f x grad g) obeys Jacobi exactly when a.curl a = 0; here a = (y, -x, 1), a.curl a = -2.
  const auto twisted = record(3, 9, [](const Recorded&, Arguments z, Results out) {
    const std::array<Recorded, 3> a{z[1], -z[0], Recorded(1)};
    out[1] = a[2];
    out[3] = -a[2];
    out[5] = a[0];
    out[7] = -a[0];
    out[6] = a[1];
    out[2] = -a[1];
  });
  const auto lopsided = record(2, 4, [](const Recorded&, Arguments z, Results out) {
    out[1] = z[0];
    out[2] = z[0] * Recorded(Real::fraction(-999999, 1000000));
  });
  // {f, g} = z.(grad f x grad g) keeps |z|^2, not |z|^2 + 1e-6 z_1.
  const auto rotation = record(3, 9, [](const Recorded&, Arguments z, Results out) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      out[a * 3 + b] = z[c];
      out[b * 3 + a] = -z[c];
    }
  });
  const auto no_casimir = record(3, 1, [](const Recorded&, Arguments z, Results out) {
    out[0] = z[0] * z[0] + z[1] * z[1] + z[2] * z[2] + Recorded(Real::fraction(1, 1000000)) * z[0];
  });
  const auto control = [&](const char* plugin, const char* claim, Check check) {
    check.plugin = plugin;
    check.claim = claim;
    check.scope = "control";
    check.control = true;
    check.result = check.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
    checks.push_back(std::move(check));
  };
  const auto residual = [](const std::shared_ptr<const Tape>& tape, int n) {
    return named("", "", "", "quad", largest<Quad>(tape, bracket_point(n)), residual_tolerance<Quad>());
  };
  control("bracket a x grad, a.curl a = -2", "Jacobi identity", residual(jacobiator(twisted, 3), 3));
  // G = [[1, 2], [2, 1]] has a negative eigenvalue and so is no semimetric.
  const auto indefinite = expression(2, 4, [](const Recorded&, Arguments, Results out) {
    out[0] = out[3] = Recorded(1);
    out[1] = out[2] = Recorded(2);
  });
  control("bracket [[1, 2], [2, 1]]", "semimetric",
          check_not_negative("", "semimetric", "", indefinite, bracket_point(2)).back());
  // The lowest eigenvalue of this one is -4, along (1, -1, 0)/sqrt 2, a direction that hardly any list of
  // covectors contains.
  const auto slanted = expression(3, 9, [](const Recorded&, Arguments, Results out) {
    out[0] = out[4] = Recorded(3);
    out[1] = out[3] = Recorded(7);
    out[8] = Recorded(100);
  });
  control("bracket [[3, 7, 0], [7, 3, 0], [0, 0, 100]]", "semimetric",
          check_not_negative("", "semimetric", "", slanted, bracket_point(3)).back());
  control("|z|^2 with 1e-6 of a component added", "Casimirs",
          residual(sharp_of_casimirs(rotation, no_casimir), 3));
  control("bracket skew but for 1e-6", "symmetric", residual(skew_part(lopsided, 2), 2));
  control("bracket skew but for 1e-6", "skew", residual(symmetric_part(lopsided, 2), 2));
  return checks;
}

}  // namespace pfaff
