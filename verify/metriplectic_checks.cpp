// The claims of metriplectic systems (morrison1986). The field is zdot = Pi dH + G dS with Pi dS = 0 and G dH
// = 0, so that the energy is conserved and the entropy never falls, or zdot = Pi dH - G dH, so that the
// energy never rises. G is symmetric and non-negative in both.
#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {

std::vector<Recorded> slope_of(const Tape& function, const Recorded& t, Arguments z) {
  const std::vector<Recorded> one{Recorded(1)};
  return gradient(function, t, z, one);
}

// The vector tensor d(function), which has to vanish.
std::shared_ptr<const Tape> sharp_of(const Tape& tensor, const Tape& function) {
  return expression(function.inputs, function.inputs, [&](const Recorded& t, Arguments z, Results out) {
    const auto matrix = evaluate(tensor, t, z), slope = slope_of(function, t, z);
    for (std::size_t i = 0; i < z.size(); ++i)
      for (std::size_t j = 0; j < z.size(); ++j) out[i] = out[i] + matrix[i * z.size() + j] * slope[j];
  });
}

// The rate of a function along the field. Where the function may rise, only the falling part is returned, and
// the other way round; `neither` returns the whole rate.
enum class May { neither, rise, fall };
std::shared_ptr<const Tape> rate_of(const Tape& function, const Tape& field, May may) {
  return expression(function.inputs, 1, [&](const Recorded& t, Arguments z, Results out) {
    const auto x = evaluate(field, t, z);
    const Recorded rate = directional_derivative(function, t, Recorded(1), z, x)[0];
    out[0] = may == May::neither ? rate
             : may == May::rise  ? select(rate, Recorded(0), -rate)
                                 : select(rate, rate, Recorded(0));
  });
}

// The number of negative or indefinite pivots of a symmetric tensor over random states; by Sylvester's law of
// inertia it is zero where the tensor is non-negative.
template <class T>
Check not_negative(const std::string& plugin, const std::string& claim, const std::string& system,
                   const std::shared_ptr<const Tape>& tensor, const Region& region, const char* precision) {
  NearbyStates<T> states(region);
  Replay<T> replay(tensor);
  const std::size_t n = region.centres.front().size();
  std::vector<T> g(n * n);
  double negative = 0;
  for (int k = 0; k < states.count(); ++k) {
    T time;
    const std::vector<T>& z = states.next(time);
    replay(time, z.data(), g.data());
    bool finite = true;
    for (const T& x : g) finite = finite && isfinite(x);
    if (!finite && states.far()) continue;
    if (!finite) {
      negative = NAN;
      break;
    }
    // A pivot that is zero but for rounding has any sign.
    T largest(0);
    for (const T& x : g) largest = std::max(largest, T(abs(x)));
    const T rounding = T(static_cast<double>(64 * n)) * unit_roundoff<T>() * largest;
    // A pair of rows is taken where what is left has next to nothing on its diagonal, and is indefinite.
    for (const auto& pivot : classify(Matrix<T>(n, g), Symmetry::symmetric).pivots)
      if (pivot.rows.size() == 2 ? abs(pivot.value) > rounding * rounding : pivot.value < -rounding)
        ++negative;
  }
  return named(plugin, claim, system, precision, negative, 0);
}

}  // namespace

std::vector<Check> check_not_negative(const std::string& plugin, const std::string& claim,
                                      const std::string& system, const std::shared_ptr<const Tape>& tensor,
                                      const Region& region) {
  return {not_negative<double>(plugin, claim, system, tensor, region, "double"),
          not_negative<Quad>(plugin, claim, system, tensor, region, "quad")};
}

std::vector<Check> check_metriplectic(const std::string& name, const Model& model) {
  std::vector<Check> checks;
  const Region region = region_of(model, generic_state(model));
  const auto n = static_cast<std::size_t>(model.dimension());
  const auto poisson = model.tape(Formula::poisson_tensor), symmetric = model.tape(Formula::symmetric_tensor),
             energy = model.tape(Formula::hamiltonian), field = model.tape(Formula::field);
  const auto skew_part = expression(model.dimension(), model.dimension() * model.dimension(),
                                    [&](const Recorded& t, Arguments z, Results out) {
                                      const auto g = evaluate(*symmetric, t, z);
                                      for (std::size_t i = 0; i < n; ++i)
                                        for (std::size_t j = 0; j < n; ++j)
                                          out[i * n + j] = g[i * n + j] - g[j * n + i];
                                    });
  both(checks, name, "symmetric bracket is symmetric", name, skew_part, region);
  for (Check& check : check_not_negative(name, "symmetric bracket is non-negative", name, symmetric,
                                         with_branches_of(*symmetric, region)))
    checks.push_back(std::move(check));
  // A rate of one sign alone has a branch of its own, which is none of the system's.
  const auto rate_is = [&](const char* claim, const Tape& function, May may) {
    both(checks, name, claim, name, rate_of(function, *field, may),
         with_branches_of(*rate_of(function, *field, May::neither), region));
  };
  const auto vanishes = [&](const char* claim, const std::shared_ptr<const Tape>& residual) {
    both(checks, name, claim, name, residual, with_branches_of(*residual, region));
  };
  if (!model.given(Formula::entropy)) {
    rate_is("energy does not rise", *energy, May::fall);
    return checks;
  }
  const auto entropy = model.tape(Formula::entropy);
  vanishes("entropy is a Casimir of the Poisson bracket", sharp_of(*poisson, *entropy));
  vanishes("energy is degenerate for the symmetric bracket", sharp_of(*symmetric, *energy));
  rate_is("energy is conserved", *energy, May::neither);
  rate_is("entropy does not fall", *entropy, May::rise);
  return checks;
}

namespace {

// A body that turns about its centre of mass, with a relaxation that is wrong in one of these ways.
enum class FalseBracketSum { none, moves_energy, not_symmetric, indefinite, entropy_no_casimir };
struct FaultyBracket {
  FalseBracketSum fault;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const T millionth(Real::fraction(1, 1000000));
    const std::array<T, 3> w{z[0], 2 * z[1], 3 * z[2]};
    const T square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const T along = w[0] * covector[0] + w[1] * covector[1] + w[2] * covector[2];
    for (std::size_t a = 0; a < 3; ++a) vector[a] = square * covector[a] - w[a] * along;
    if (fault == FalseBracketSum::indefinite)
      for (T& x : vector) x = -x;
    if (fault == FalseBracketSum::moves_energy) vector[0] = vector[0] + millionth * covector[0];
    if (fault == FalseBracketSum::not_symmetric) vector[0] = vector[0] + millionth * covector[1];
  }
};
struct RotationBracket {
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      vector[a] = z[b] * covector[c] - z[c] * covector[b];
    }
  }
};
struct FaultyBody {
  static constexpr int dimension = 3;
  FalseBracketSum fault = FalseBracketSum::none;
  [[nodiscard]] RotationBracket bracket() const { return {}; }
  [[nodiscard]] FaultyBracket symmetric_bracket() const { return {fault}; }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + 2 * z[1] * z[1] + 3 * z[2] * z[2]) / 2;
  }
  template <class T>
  T entropy(const T& /*t*/, In<T> z) const {
    const T square = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) / 2;
    return fault == FalseBracketSum::entropy_no_casimir ? square + z[0] * Real::fraction(1, 1000000) : square;
  }
};

}  // namespace

std::vector<Check> check_false_metriplectic() {
  std::vector<Check> controls;
  const auto control = [&](const std::string& what, FalseBracketSum fault, const std::string& claim) {
    const auto model = make_model(SystemDescriptor{.name = "faulty-body",
                                                   .title = "",
                                                   .reference = "",
                                                   .initial = {Real(1), Real::fraction(1, 2), Real(2)}},
                                  FaultyBody{fault});
    add_controls(controls, what, claim, check_metriplectic("faulty-body", *model),
                 [&](const Check& check) { return check.claim == claim && check.precision == "quad"; });
  };
  control("relaxation with 1e-6 added along an axis", FalseBracketSum::moves_energy,
          "energy is degenerate for the symmetric bracket");
  control("relaxation with 1e-6 added along an axis", FalseBracketSum::moves_energy, "energy is conserved");
  control("relaxation with 1e-6 added beside the diagonal", FalseBracketSum::not_symmetric,
          "symmetric bracket is symmetric");
  control("relaxation with its sign turned", FalseBracketSum::indefinite,
          "symmetric bracket is non-negative");
  control("relaxation with its sign turned", FalseBracketSum::indefinite, "entropy does not fall");
  control("entropy with 1e-6 of a component added", FalseBracketSum::entropy_no_casimir,
          "entropy is a Casimir of the Poisson bracket");
  return controls;
}

}  // namespace pfaff
