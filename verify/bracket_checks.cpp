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
// What the sharp map of two covectors differs by from the tensor times them: it may be linear along the unit
// covectors, of which the tensor is made, and nowhere else.
std::shared_ptr<const Tape> not_linear(const Tape& sharp, const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, 2 * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto pi = evaluate(tensor, t, z);
    for (std::size_t c = 0; c < 2; ++c) {
      std::vector<Recorded> x(z.begin(), z.end());
      for (std::int64_t k = 0; k < n; ++k)
        x.emplace_back(Real::fraction((k + static_cast<std::int64_t>(c)) % 2 == 0 ? 5 + 2 * k : -3 - k, 4));
      const auto image = evaluate(sharp, t, x);
      for (std::size_t i = 0; i < size; ++i) {
        Recorded sum(0);
        for (std::size_t j = 0; j < size; ++j) sum = sum + pi[i * size + j] * x[size + j];
        out[c * size + i] = image[i] - sum;
      }
    }
  });
}
std::vector<Real> bracket_point(int n) {
  std::vector<Real> z;
  for (int k = 0; k < n; ++k) z.push_back(Real::fraction(3 + 2 * k, 7));
  return z;
}
// States of sizes up to five in each coordinate and more in most, which are positive, as sizes and
// temperatures are.
Region bracket_region(int n) {
  Region region(bracket_point(n));
  for (const std::int64_t factor : {2, 4, 8, 24}) {
    std::vector<Real> z;
    for (const Real& x : bracket_point(n)) z.push_back(Real::fraction(factor, 2) * x);
    region.centres.push_back(std::move(z));
    region.times.push_back(1);
  }
  return region;
}
// A number in a range: the same where it is there, or else as far from the end that is nearer to zero.
Real brought_into(const Range& range, const Real& x) {
  if (within(range, x.quad())) return x;
  const auto [low, high] = range;
  if (std::isfinite(high - low)) return Real(Quad(low)) + Real(Quad(high - low)) * x / (x + Real(1));
  return high <= 0 ? Real(Quad(high)) - x : Real(Quad(low)) + x;
}

// That the Casimirs are ones, and that each has a slope near the first centre, without which it would be a
// Casimir of every bracket.
std::vector<Check> check_casimirs(const std::string& name, const Tape& tensor, const Tape& casimirs,
                                  const Region& region) {
  std::vector<Check> checks;
  both(checks, name, "Casimirs", "", sharp_of_casimirs(tensor, casimirs), region);
  const std::vector<Real>& z = region.centres.front();
  const Tape slopes = jacobian_tape(casimirs);
  std::vector<Quad> values(slopes.outputs.size()), at;
  for (const Real& x : z) at.push_back(x.quad());
  Replay<Quad>(std::make_shared<const Tape>(slopes))(Quad(1), at.data(), values.data());
  for (std::size_t c = 0; c * z.size() < values.size(); ++c) {
    const auto slope = values.begin() + static_cast<std::ptrdiff_t>(c * z.size());
    if (std::any_of(slope, slope + static_cast<std::ptrdiff_t>(z.size()),
                    [](const Quad& x) { return x != Quad(0); }))
      continue;
    checks.front().result = CheckResult::fail;
    checks.front().reason =
        "Casimir " + std::to_string(c + 1) + " is the same at every state, so that it says nothing";
  }
  return checks;
}
}  // namespace

std::vector<Check> check_bracket(const BracketPlugin& plugin, const Assignments& parameters) {
  const BracketInstance bracket = plugin.make(parameters);
  const int n = bracket.dimension;
  const auto tensor = tensor_of(*bracket.sharp, n);
  Region centre = bracket_region(n);
  centre.box = bracket.ranges;
  for (std::vector<Real>& z : centre.centres)
    for (std::size_t k = 0; k < centre.box.size(); ++k) z[k] = brought_into(centre.box[k], z[k]);
  centre = with_branches_of(*tensor, std::move(centre));
  std::vector<Check> checks;
  both(checks, plugin.name(), "sharp is linear", "", not_linear(*bracket.sharp, *tensor, n), centre);
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
    for (Check& check : check_casimirs(plugin.name(), *tensor, *bracket.casimirs,
                                       with_branches_of(*bracket.casimirs, centre)))
      checks.push_back(std::move(check));
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
  // In so(3) with a product of components the unit covectors see nothing.
  const auto bent = record(6, 3, [](const Recorded&, Arguments x, Results out) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      out[a] = x[c] * x[3 + b] - x[b] * x[3 + c];
    }
    out[0] = out[0] + Recorded(Real::fraction(1, 1000000)) * x[3] * x[4];
  });
  control("bracket with a product of components of a covector", "sharp is linear",
          residual(not_linear(bent, *tensor_of(bent, 3), 3), 3));
  const auto constant = record(3, 1, [](const Recorded&, Arguments, Results out) { out[0] = Recorded(1); });
  control("a constant", "Casimirs", check_casimirs("", rotation, constant, Region(bracket_point(3))).front());
  control("bracket skew but for 1e-6", "symmetric", residual(skew_part(lopsided, 2), 2));
  control("bracket skew but for 1e-6", "skew", residual(symmetric_part(lopsided, 2), 2));
  return checks;
}

}  // namespace pfaff
