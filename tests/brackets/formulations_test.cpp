// What formulations keep and what they do not, off the surface of constraints, for any mass matrix, with
// friction and with constraints that move.
#include <gtest/gtest.h>

#include <random>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "rods.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

constexpr int points = 10;

std::shared_ptr<const Model> named(const char* name, const Assignments& set = {}) {
  return systems().get(name, "system").make(set);
}
/// The hanging chain of four, friction or none, about the golden state on the surface.
std::shared_ptr<const Model> chain(std::vector<Real> drag) {
  Rods rods = golden_rods();
  rods.drag = std::move(drag);
  const nlohmann::json state = golden_pendulum()["states"][0];
  std::vector<Real> initial = reals_of(state["q"]);
  for (const Real& x : reals_of(state["p"])) initial.push_back(x);
  return make_model(SystemDescriptor{.name = "rods", .title = "", .reference = "", .initial = initial}, rods);
}
std::vector<std::shared_ptr<const Model>> holonomic_models() {
  return {chain({}),
          named("spherical-pendulum"),
          named("sphere-particle"),
          named("torus-particle"),
          named("polar-double-pendulum"),
          named("shaken-pendulum")};
}

template <class T>
constexpr double bound = std::is_same_v<T, double> ? 1e-14 : 1e-31;

/// Random states within a tenth of the initial one: off the surface, where constraints are independent.
template <class T>
class Points {
 public:
  std::vector<T> near(const Model& model) {
    std::vector<T> z;
    for (const Real& x : model.initial()) z.push_back(T(x) + T(offset_(random_)));
    return z;
  }
  T time() { return T(1 + offset_(random_)); }

 private:
  std::mt19937_64 random_{20044};
  std::uniform_real_distribution<double> offset_{-0.1, 0.1};
};

template <class T>
std::vector<T> values(const std::shared_ptr<const Tape>& tape, const T& t, const std::vector<T>& z) {
  std::vector<T> out(tape->outputs.size());
  Replay<T> replay(tape);
  replay(t, z.data(), out.data());
  return out;
}
template <class T>
std::vector<T> field(const std::shared_ptr<const Model>& model, const T& t, const std::vector<T>& z) {
  const Evaluator<T> f = make_evaluator<T>(model, Formula::field);
  std::vector<T> rate(z.size());
  f.call(f.context, t, z.data(), rate.data());
  return rate;
}
template <class T>
double distance(std::span<const T> a, std::span<const T> b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0;
  T size(1);
  for (const T& x : b) size = std::max(size, abs(x));
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto d = static_cast<double>(abs(a[k] - b[k]) / size);
    worst = std::isnan(d) ? INFINITY : std::max(worst, d);
  }
  return worst;
}

/// The rates of all constraints (each phi followed by its phi~) and of H along a motion, with the partial
/// derivative of H in time; and the largest of the terms that they are sums of.
template <class T>
struct Rates {
  Rates(const Model& model, const std::vector<T>& field, const T& t, const std::vector<T>& z) {
    const auto phi = model.tape(Formula::constraints), slopes = model.tape(Formula::constraint_gradients);
    const auto energy = model.tape(Formula::hamiltonian_gradient);
    const std::size_t n = z.size(), count = phi->outputs.size();
    const auto still = std::make_shared<const Tape>(
        record(phi->inputs, static_cast<int>(count), [&](const Recorded& s, Arguments x, Results out) {
          const auto rest = time_derivative(*phi, s, x);
          std::copy(rest.begin(), rest.end(), out.begin());
        }));
    const auto rows = values(slopes, t, z), moving = values(still, t, z), dh = values(energy, t, z);
    const auto add = [&](T& sum, const T& term) {
      sum = sum + term;
      size = std::max(size, abs(term));
    };
    for (std::size_t i = 0; i < count; ++i) {
      T sum(0);
      add(sum, moving[i]);
      for (std::size_t a = 0; a < n; ++a) add(sum, rows[i * n + a] * field[a]);
      (i % 2 == 0 ? phi_rates : hidden_rates).push_back(sum);
    }
    for (std::size_t a = 0; a < n; ++a) add(energy_rate, dh[a] * field[a]);
  }
  std::vector<T> phi_rates, hidden_rates;
  T energy_rate{0}, size{1};

  [[nodiscard]] double relative(const T& x) const { return static_cast<double>(abs(x) / size); }
  [[nodiscard]] double worst(const std::vector<T>& x) const {
    double largest = 0;
    for (const T& value : x)
      largest = std::max(largest, std::isnan(relative(value)) ? INFINITY : relative(value));
    return largest;
  }
};

// Rounding of the terms, times what solves with S amplify it by: its condition is below a hundred here.
template <class T>
constexpr double kept = 100 * bound<T>;

template <class T>
void dirac_keeps_everything() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto dirac = motion(model, "dirac"), simple = motion(model, "simplified-dirac");
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const Rates<T> rates(*model, field(dirac, t, z), t, z), others(*model, field(simple, t, z), t, z);
      EXPECT_LE(rates.worst(rates.phi_rates), kept<T>);
      EXPECT_LE(rates.worst(rates.hidden_rates), kept<T>);
      EXPECT_GT(others.worst(others.phi_rates), 1e-6) << "the control keeps phi";
      if (model->name() == "shaken-pendulum") continue;  // the support does work
      EXPECT_LE(rates.relative(rates.energy_rate), kept<T>);
      EXPECT_GT(others.relative(others.energy_rate), 1e-6) << "the control keeps H";
    }
  }
}
TEST(Formulations, DiracKeepsBothLevelsAndEnergyOffTheSurface) {
  dirac_keeps_everything<double>();
  dirac_keeps_everything<Quad>();
}

template <class T>
void simplified_statements() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto simple = motion(model, "simplified-dirac"), multipliers = motion(model, "lmm"),
               stabilised = motion(model, "ggl");
    const auto constraints = model->template holonomic_constraints<T>();
    const std::size_t n = constraints->degrees();
    std::vector<T> s(constraints->count());
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const auto rate = field(simple, t, z);
      ASSERT_EQ(constraints->place(t, In<T>(z).first(n), In<T>(z).subspan(n)), Status::converged);
      const Rates<T> rates(*model, rate, t, z);
      // phi' = phi~, phi~' = 0, H' = -phi~.S^-1 h
      EXPECT_LE(distance<T>(rates.phi_rates, constraints->hidden()), kept<T>);
      EXPECT_LE(rates.worst(rates.hidden_rates), kept<T>);
      constraints->solve(constraints->hidden_rates(), s);
      T expected(0);
      for (std::size_t i = 0; i < s.size(); ++i) expected = expected - constraints->hidden()[i] * s[i];
      if (model->name() != "shaken-pendulum") {
        EXPECT_LE(rates.relative(rates.energy_rate - expected), kept<T>);
      }
      // Lagrange's multipliers without friction and stabilisation are the same field.
      EXPECT_LE(distance<T>(field(multipliers, t, z), rate), bound<T>);
      // The stabilised index 2 keeps both levels, and not the energy.
      const Rates<T> ggl(*model, field(stabilised, t, z), t, z);
      EXPECT_LE(ggl.worst(ggl.phi_rates), kept<T>);
      EXPECT_LE(ggl.worst(ggl.hidden_rates), kept<T>);
      if (model->name() != "shaken-pendulum") {
        EXPECT_GT(ggl.relative(ggl.energy_rate), 1e-6);
      }
    }
  }
}
TEST(Formulations, SimplifiedDiracIsLagrangesMultipliersAndLetsPositionsDrift) {
  simplified_statements<double>();
  simplified_statements<Quad>();
}

TEST(Formulations, OnTheSurfaceAllAreOneMotion) {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    std::vector<Quad> z;
    for (const Real& x : model->initial()) z.push_back(x.quad());
    const auto dirac = field(motion(model, "dirac"), Quad(0), z);
    for (const char* other : {"simplified-dirac", "lmm", "ggl"})
      EXPECT_LE(distance<Quad>(field(motion(model, other), Quad(0), z), dirac), kept<Quad>) << other;
  }
}

template <class T>
void baumgarte() {
  const T alpha(2), beta(3);
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto damped = motion(model, "lmm", {{"baumgarte-alpha", "2"}, {"baumgarte-beta", "3"}});
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model);
      const auto phi = values(model->tape(Formula::constraints), t, z);
      const Rates<T> rates(*model, field(damped, t, z), t, z);
      for (std::size_t i = 0; i < rates.phi_rates.size(); ++i) {
        const T expected = -(T(2) * alpha * phi[2 * i + 1] + beta * beta * phi[2 * i]);
        EXPECT_LE(rates.relative(rates.phi_rates[i] - phi[2 * i + 1]), kept<T>);
        EXPECT_LE(rates.relative(rates.hidden_rates[i] - expected), kept<T>);
        EXPECT_GT(rates.relative(rates.hidden_rates[i]), 1e-6) << "nothing is stabilised";
      }
    }
  }
}
TEST(Formulations, BaumgarteDampsTheConstraintsAtItsRates) {
  baumgarte<double>();
  baumgarte<Quad>();
}

// <H, H>_D of the symmetric bracket, densely: v.Lambda v - w.(S^D)^-1 w with w = P Lambda v.
Quad dissipation(const Model& model, Quad t, const std::vector<Quad>& z) {
  const auto constraints = model.holonomic_constraints<Quad>();
  const std::size_t n = constraints->degrees(), count = constraints->count();
  EXPECT_EQ(constraints->place(t, In<Quad>(z).first(n), In<Quad>(z).subspan(n)), Status::converged);
  Matrix<Quad> p(count, n);
  for (std::size_t a = 0; a < n; ++a) {
    std::vector<Quad> unit(n), column(count);
    unit[a] = Quad(1);
    constraints->hidden_by_momentum(unit, column);
    for (std::size_t i = 0; i < count; ++i) p(i, a) = column[i];
  }
  const In<Quad> lambda = constraints->friction(), v = constraints->velocities();
  LU<Quad> lu(count);
  std::vector<Quad> w(count), x(count);
  Quad sum(0);
  for (std::size_t a = 0; a < n; ++a) sum += v[a] * lambda[a] * v[a];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < n; ++a) w[i] += p(i, a) * lambda[a] * v[a];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      lu(i, j) = Quad(0);
      for (std::size_t a = 0; a < n; ++a) lu(i, j) = lu(i, j) + p(i, a) * lambda[a] * p(j, a);
    }
  EXPECT_TRUE(lu.factor());
  lu.solve(w.data(), x.data());
  for (std::size_t i = 0; i < count; ++i) sum -= w[i] * x[i];
  return sum;
}

TEST(Formulations, MetriplecticFrictionDissipatesByTheSymmetricDiracBracket) {
  const auto model = chain(golden_rods().drag);
  Points<Quad> at;
  for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"})
    for (int k = 0; k < points; ++k) {
      const auto z = at.near(*model);
      const auto rate = [&](const char* form) {
        return Rates<Quad>(*model, field(motion(model, formulation, {{"friction-form", form}}), Quad(0), z),
                           Quad(0), z);
      };
      const Rates<Quad> none = rate("none"), metriplectic = rate("metriplectic"), stokes = rate("stokes");
      const Quad lost = dissipation(*model, Quad(0), z);
      EXPECT_GT(lost, Quad(0));
      EXPECT_LE(none.relative(metriplectic.energy_rate - none.energy_rate + lost), kept<Quad>);
      EXPECT_GT(none.relative(stokes.energy_rate - none.energy_rate + lost), 1e-3);
      // Neither form moves the hidden constraints.
      for (std::size_t i = 0; i < none.hidden_rates.size(); ++i) {
        EXPECT_LE(none.relative(metriplectic.hidden_rates[i] - none.hidden_rates[i]), kept<Quad>);
        EXPECT_LE(none.relative(stokes.hidden_rates[i] - none.hidden_rates[i]), kept<Quad>);
      }
    }
}

template <class T>
double difference_of_friction_forms(const std::vector<Real>& drag) {
  const auto model = chain(drag);
  Points<T> at;
  double worst = 0;
  for (int k = 0; k < points; ++k) {
    const auto z = at.near(*model);
    worst = std::max(worst,
                     distance<T>(field(motion(model, "dirac", {{"friction-form", "metriplectic"}}), T(0), z),
                                 field(motion(model, "dirac", {{"friction-form", "stokes"}}), T(0), z)));
  }
  return worst;
}
TEST(Formulations, FrictionFormsCoincideWhereItIsProportionalToMass) {
  std::vector<Real> drag = golden_rods().masses;
  for (Real& x : drag) x = x * 3 / 10;
  EXPECT_LE(difference_of_friction_forms<double>(drag), kept<double>);
  EXPECT_LE(difference_of_friction_forms<Quad>(drag), kept<Quad>);
  drag.back() = drag.back() + Real::fraction(1, 1000);  // the control
  EXPECT_GT(difference_of_friction_forms<Quad>(drag), 1e-7);
  EXPECT_GT(difference_of_friction_forms<Quad>(golden_rods().drag), 1e-3);
}

// (1.2) word for word with the dense W of all constraints: Pi dH - X_i (W^-1)_ij (dphi_j Pi dH + d_t phi_j).
template <class T>
std::vector<T> dense_dirac(const Model& model, const T& t, const std::vector<T>& z) {
  const std::size_t n = z.size();
  const auto phi = model.tape(Formula::constraints);
  const std::size_t count = phi->outputs.size();
  const auto still = std::make_shared<const Tape>(
      record(phi->inputs, static_cast<int>(count), [&](const Recorded& s, Arguments x, Results out) {
        const auto rest = time_derivative(*phi, s, x);
        std::copy(rest.begin(), rest.end(), out.begin());
      }));
  const Matrix<T> rows(count, values(model.tape(Formula::constraint_gradients), t, z));
  const Matrix<T> pi(n, values(model.tape(Formula::poisson_tensor), t, z));
  const Matrix<T> slope(n, values(model.tape(Formula::hamiltonian_gradient), t, z));
  const Matrix<T> moving(count, values(still, t, z));
  const Matrix<T> x = pi * rows.transposed(), free = pi * slope;
  const Matrix<T> w = rows * x, right = rows * free + moving;
  LU<T> lu(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) lu(i, j) = w(i, j);
  EXPECT_TRUE(lu.factor());
  std::vector<T> c(count), rate(n);
  lu.solve(right.entries().data(), c.data());
  for (std::size_t a = 0; a < n; ++a) {
    rate[a] = free(a, 0);
    for (std::size_t i = 0; i < count; ++i) rate[a] = rate[a] - x(a, i) * c[i];
  }
  return rate;
}

template <class T>
void generic_bracket_is_the_structured_one() {
  for (const auto& model : holonomic_models()) {
    SCOPED_TRACE(model->name());
    const auto dirac = motion(model, "dirac"), simple = motion(model, "simplified-dirac");
    Points<T> at;
    for (int k = 0; k < points; ++k) {
      const T t = at.time();
      const auto z = at.near(*model), dense = dense_dirac(*model, t, z);
      EXPECT_LE(distance<T>(field(dirac, t, z), dense), 10 * kept<T>);  // W has the condition of S twice
      EXPECT_GT(distance<T>(field(simple, t, z), dense), 1e-6) << "the control is the same off the surface";
    }
  }
}
TEST(Formulations, GenericDiracBracketIsTheStructuredOne) {
  generic_bracket_is_the_structured_one<double>();
  generic_bracket_is_the_structured_one<Quad>();
}

template <class T>
void tapes_are_the_fields() {
  auto models = holonomic_models();
  models.push_back(chain(golden_rods().drag));
  for (const auto& model : models) {
    SCOPED_TRACE(model->name());
    for (const char* formulation : {"dirac", "simplified-dirac", "lmm", "ggl"}) {
      const auto moving = motion(model, formulation);
      ASSERT_NE(moving->program(Formula::field), nullptr);
      Points<T> at;
      for (int k = 0; k < points; ++k) {
        const T t = at.time();
        const auto z = at.near(*model);
        const auto direct = field(moving, t, z);
        EXPECT_LE(distance<T>(values(moving->tape(Formula::field), t, z), direct), kept<T>) << formulation;
        auto changed = z;
        changed[0] = changed[0] + T(1e-5);
        EXPECT_GT(distance<T>(values(moving->tape(Formula::field), t, changed), direct), kept<T>);
      }
    }
  }
}
TEST(Formulations, RecordedTapesAreTheFields) {
  tapes_are_the_fields<double>();
  tapes_are_the_fields<Quad>();
}

// The chain of rods with phi and phi~ written as constraints of the phase space, and its friction as a
// symmetric bracket: the same equations by the dense way.
struct Drag {
  std::vector<Real> coefficients;
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    const std::size_t half = covector.size() / 2;
    for (std::size_t k = 0; k < half; ++k) {
      vector[k] = T(0);
      vector[half + k] = coefficients[k / 2] * covector[half + k];
    }
  }
};
struct DenseRods {
  Rods rods;
  [[nodiscard]] int dimension() const { return rods.dimension(); }
  [[nodiscard]] int constraint_count() const { return 2 * rods.constraint_count(); }
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return rods.kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return rods.potential(t, q);
  }
  [[nodiscard]] Drag symmetric_bracket() const { return {rods.drag}; }
  template <class T>
  void constraints(const T& t, In<T> z, Out<T> phi) const {
    const std::size_t half = z.size() / 2, count = rods.masses.size();
    rods.holonomic(t, z.first(half), phi.first(count));
    for (std::size_t k = 0; k < count; ++k) {
      T sum(0);
      for (std::size_t c = 0; c < 2; ++c) {
        const std::size_t i = 2 * k + c;
        const T v = z[half + i] / rods.masses[k];
        sum = sum + (k == 0 ? z[i] * v : (z[i - 2] - z[i]) * (z[half + i - 2] / rods.masses[k - 1] - v));
      }
      phi[count + k] = sum;
    }
  }
};
TEST(Formulations, ConstraintsOfThePhaseSpaceGiveTheSameMotion) {
  const auto structured = chain(golden_rods().drag);
  const auto dense = make_model(SystemDescriptor{.name = "dense-rods", .title = "", .reference = ""},
                                DenseRods{golden_rods()});
  EXPECT_FALSE(dense->facets().has(Facet::holonomic));
  Points<Quad> at;
  for (const char* form : {"none", "metriplectic"})
    for (int k = 0; k < points; ++k) {
      const auto z = at.near(*structured);
      EXPECT_LE(distance<Quad>(field(motion(dense, "dirac", {{"friction-form", form}}), Quad(0), z),
                               field(motion(structured, "dirac", {{"friction-form", form}}), Quad(0), z)),
                10 * kept<Quad>)
          << form;
    }
  EXPECT_THROW(motion(dense, "lmm"), InputError);
}

}  // namespace
