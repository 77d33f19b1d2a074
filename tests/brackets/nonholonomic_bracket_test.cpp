// The nonholonomic bracket: its flow against d'Alembert's principle with multipliers, solved densely from the
// derivatives of the Lagrangian and by no code of the bracket; its rank, Casimirs and Jacobiator.
#include <gtest/gtest.h>

#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/brackets/nonholonomic/nonholonomic_bracket.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace {
using namespace pfaff;

const SystemDescriptor descriptor{.name = "sample", .title = "", .reference = ""};

// w = dz - y dx, unit metric (REFERENCE of the closed forms: pitanga-rodrigues 4.2).
struct ContactParticle {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[1];
    rows[1] = T(0);
    rows[2] = T(1);
  }
};
// The sleigh by its centre of mass, J = 2, r = 3/4.
struct Sleigh : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] / 2) / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[2] = -T(3) / T(4);
  }
};
// Four positions, two constraints, a potential, an inverse metric L L^T that depends on them, and a term
// linear in the momenta (the motion in a magnetic field).
struct Curved {
  static constexpr int dimension = 8, velocity_constraint_count = 2;
  int magnetic = 0, wind = 0;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const auto &x = z[0], &y = z[1], &u = z[2], &w = z[3];
    const T a = z[4] + T(magnetic) * y * w, b = z[5] - T(magnetic) * u * x, c = z[6],
            d = z[7] + T(magnetic) * x * x;
    const T first = a * (T(2) + sin(y)), second = b + a * u / 3, third = c * (T(1) + x * x / 4) + b * cos(w),
            fourth = d + a * x / 5 - c * y / 2;
    return (first * first + second * second + third * third + fourth * fourth) / 2 + sin(x) * u +
           y * y * w / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
    rows[1] = T(1);
    rows[2] = -cos(q[3]);
    rows[3] = q[0] / 2;
    rows[4] = T(0);
    rows[5] = q[2] * q[3];
    rows[6] = T(2);
    rows[7] = T(1) + q[1];
  }
  template <class T>
  void velocity_offsets(const T& /*t*/, In<T> q, Out<T> b) const {
    b[0] = T(wind) * q[2];
    b[1] = T(wind) * q[0];
  }
};
// z = x y + const in disguise: y dx + x dy - dz.
struct Integrable : ContactParticle {
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
    rows[1] = q[0];
    rows[2] = -T(1);
  }
};
struct NotQuadratic : ContactParticle {
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] * p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  }
};

template <class T>
std::vector<T> values(const std::shared_ptr<const Tape>& tape, const std::vector<T>& x) {
  std::vector<T> out(tape->outputs.size());
  Replay<T> replay(tape);
  replay(T(0), x.data(), out.data());
  return out;
}
template <class T>
std::vector<T> state(std::size_t n, int shift) {
  std::vector<T> z;
  for (std::size_t k = 0; k < n; ++k)
    z.push_back(T(static_cast<int>(3 * k + 2) * (k % 2 == 0 ? 1 : -1) + shift) / T(10));
  return z;
}

// d'Alembert's principle with multipliers, all derivatives by duals of the author's struct: the rates of (q,
// p) at (q, p) with A v + b = 0 are (H_p, -H_q - A^T lambda) with d(A v + b)/dt = 0, one dense system in (p',
// lambda), [[I, A^T], [A H_pp, 0]].
template <class T, class S>
std::vector<T> dalembert(const S& system, const std::vector<T>& z) {
  const std::size_t n = z.size() / 2, m = static_cast<std::size_t>(S::velocity_constraint_count);
  using D = Dual<T, 1>;
  using DD = Dual<D, 1>;
  const auto energy = [&](const auto& at) {
    using X = std::decay_t<decltype(at[0])>;
    if constexpr (requires { system.template hamiltonian<X>(X(0), In<X>(at)); }) {
      return system.template hamiltonian<X>(X(0), In<X>(at));
    } else {
      const In<X> all(at);
      return system.template kinetic<X>(X(0), all.subspan(n)) +
             system.template potential<X>(X(0), all.first(n));
    }
  };
  // H_k at a point that moves in a direction: value and derivative.
  const auto slope = [&](std::size_t k, const std::vector<T>& direction) {
    std::vector<DD> x(2 * n);
    for (std::size_t i = 0; i < 2 * n; ++i) {
      x[i].value.value = z[i];
      x[i].value.derivative[0] = direction[i];
    }
    x[k].derivative[0].value = T(1);
    return energy(x).derivative[0];
  };
  const std::vector<T> still(2 * n);
  std::vector<T> v(n), force(n), along(2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    v[k] = slope(n + k, still).value;
    force[k] = -slope(k, still).value;
    along[k] = v[k];  // q moves with v, p is held
  }
  // psi = A(q) v + b(q) where q moves with v and p is held, and A at the point.
  std::vector<D> q(n), rows(m * n), offsets(m);
  for (std::size_t k = 0; k < n; ++k) {
    q[k].value = z[k];
    q[k].derivative[0] = v[k];
  }
  system.template velocity_constraints<D>(D(0), In<D>(q), Out<D>(rows));
  if constexpr (requires { system.template velocity_offsets<D>(D(0), In<D>(q), Out<D>(offsets)); })
    system.template velocity_offsets<D>(D(0), In<D>(q), Out<D>(offsets));
  std::vector<T> right(n + m), solution(n + m);
  LU<T> lu(n + m);
  for (std::size_t k = 0; k < n; ++k) {
    lu(k, k) = T(1);
    right[k] = force[k];
  }
  for (std::size_t a = 0; a < m; ++a) {
    D rate = offsets[a];
    for (std::size_t k = 0; k < n; ++k) {
      const D moving = slope(n + k, along);
      rate = rate + rows[a * n + k] * moving;
      lu(k, n + a) = rows[a * n + k].value;
      for (std::size_t j = 0; j < n; ++j) {
        std::vector<T> unit(2 * n);
        unit[n + j] = T(1);
        lu(n + a, j) = lu(n + a, j) + rows[a * n + k].value * slope(n + k, unit).derivative[0];
      }
    }
    right[n + a] = -rate.derivative[0];
  }
  EXPECT_TRUE(lu.factor());
  lu.solve(right.data(), solution.data());
  std::vector<T> result = v;
  result.insert(result.end(), solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(n));
  return result;
}

template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
  T worst(0);
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!(abs(a[k] - b[k]) <= worst)) worst = abs(a[k] - b[k]);
  return static_cast<double>(worst);
}

// |Pibar grad H - motion| at a constrained state.
template <class T, class S>
double flow_error(const S& system) {
  const auto model = make_model(descriptor, system);
  const NonholonomicBracket bracket(*model);
  double worst = 0;
  for (const int shift : {0, 3, -7}) {
    const auto z = bracket.projected(T(0), state<T>(static_cast<std::size_t>(model->dimension()), shift));
    const auto flow = bracket.tensor(T(0), z) * values(model->tape(Formula::hamiltonian_gradient), z);
    worst = std::max(worst, distance(flow, dalembert(system, z)));
  }
  return worst;
}

// Round-off of dense systems of up to 6 unknowns with entries about 10.
TEST(NonholonomicBracket, FlowIsDAlembertsMotion) {
  for (const int magnetic : {0, 1}) {
    EXPECT_LE(flow_error<double>(Curved{magnetic, 0}), 1e-12);
    EXPECT_LE(flow_error<Quad>(Curved{magnetic, 0}), 1e-30);
  }
  EXPECT_LE(flow_error<double>(ContactParticle{}), 1e-14);
  EXPECT_LE(flow_error<Quad>(ContactParticle{}), 1e-32);
  EXPECT_LE(flow_error<double>(Sleigh{}), 1e-14);
  EXPECT_LE(flow_error<Quad>(Sleigh{}), 1e-32);
  EXPECT_LE(flow_error<Quad>(Integrable{}), 1e-32);
  // Control: constraints with b != 0 do work, and no bracket of the energy gives their motion.
  EXPECT_GT(flow_error<Quad>(Curved{0, 1}), 1e-2);
}

// Controls of (41): the projector along the last coordinates in place of the orthogonal one, and -P in place
// of -P^T.
struct Oblique {
  Sleigh sleigh;
  template <class S>
  [[nodiscard]] MomentumProjection<S> at(const std::vector<S>& q) const {
    std::vector<S> rows(3);
    sleigh.velocity_constraints(S(0), In<S>(q), Out<S>(rows));
    return {oblique(std::vector{Covector<S>(rows)}).admissible(), Covector<S>(3)};
  }
};
TEST(NonholonomicBracket, NeedsTheOrthogonalProjectorAndItsTranspose) {
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = bracket.projected(Quad(0), state<Quad>(6, 1));
  const std::vector<Quad> q(z.begin(), z.begin() + 3), p(z.begin() + 3, z.end());
  const auto slopes = values(model->tape(Formula::hamiltonian_gradient), z), motion = dalembert(Sleigh{}, z);
  const auto wrong = pseudo_poisson_tensor<Quad>(Oblique{}, q, Covector<Quad>(p)) * slopes;
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(abs(wrong[k] - motion[k]), Quad(1e-32));  // q' is right
  EXPECT_GT(distance(wrong, motion), 1e-2);
  Matrix<Quad> printed = bracket.tensor(Quad(0), z);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) printed(3 + i, j) = -printed(i, 3 + j);
  EXPECT_GT(static_cast<double>(largest(printed + printed.transposed())), 1e-2);
  EXPECT_LE(
      static_cast<double>(largest(bracket.tensor(Quad(0), z) + bracket.tensor(Quad(0), z).transposed())),
      1e-32);
}

// (40) with its last column, at p_z = y p_x.
TEST(NonholonomicBracket, ContactParticleInClosedForm) {
  const auto model = make_model(descriptor, ContactParticle{});
  const NonholonomicBracket bracket(*model);
  const Quad y = Quad(3) / Quad(5), px = Quad(7) / Quad(4), d = Quad(1) + y * y;
  const std::vector<Quad> z{Quad(1), y, Quad(2), px, Quad(-1) / Quad(3), y * px};
  Matrix<Quad> expected(6, 6);
  const auto set = [&](std::size_t i, std::size_t j, Quad x) {
    expected(i, j) = x;
    expected(j, i) = -x;
  };
  set(0, 3, Quad(1) / d);
  set(0, 5, y / d);
  set(1, 4, Quad(1));
  set(2, 3, y / d);
  set(2, 5, y * y / d);
  set(3, 4, -y * px / d);
  set(5, 4, px / d);
  EXPECT_LE(static_cast<double>(largest(bracket.tensor(Quad(0), z) - expected)), 1e-32);
  // The Jacobiator y/d^2 of (x, p_x, p_y) and -1/d^2 of (z, p_x, p_y), the largest as y < 1.
  const auto point = nonholonomic_point(*model, Quad(0), z);
  EXPECT_EQ(point.rank, 4U);
  EXPECT_EQ(point.jacobiator.coordinates, (std::array<std::size_t, 3>{2, 3, 4}));
  EXPECT_LE(abs(point.jacobiator.value + Quad(1) / (d * d)), Quad(1e-32));
  const auto slopes = bracket_slopes<Quad>(bracket, Quad(0), In<Quad>(z));
  const auto p = bracket.tensor(Quad(0), z);
  Quad sum(0);
  for (std::size_t l = 0; l < 6; ++l)
    sum += p(0, l) * slopes[l](3, 4) + p(3, l) * slopes[l](4, 0) + p(4, l) * slopes[l](0, 3);
  EXPECT_LE(abs(sum - y / (d * d)), Quad(1e-32));
}

TEST(NonholonomicBracket, RankCasimirsAndJacobi) {
  const auto at = [](const auto& system) {
    const auto model = make_model(descriptor, system);
    return nonholonomic_point(*model, Quad(0), state<Quad>(static_cast<std::size_t>(model->dimension()), 2));
  };
  const auto curved = at(Curved{1, 1}), sleigh = at(Sleigh{}), integrable = at(Integrable{});
  EXPECT_EQ(curved.rank, 4U);  // 2 (4 - 2)
  EXPECT_EQ(sleigh.rank, 4U);
  for (const auto* point : {&curved, &sleigh, &integrable}) {
    EXPECT_LE(point->casimirs, 1e-30);
    EXPECT_LE(point->one_forms, 1e-30);
  }
  EXPECT_GT(abs(curved.jacobiator.value), Quad(1e-3));
  EXPECT_GT(abs(sleigh.jacobiator.value), Quad(1e-3));
  EXPECT_LE(abs(integrable.jacobiator.value), Quad(1e-30));  // a holonomic constraint in disguise
  // Control: another function is no Casimir.
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = state<Quad>(6, 2);
  EXPECT_GT(casimir_residual<Quad>(bracket, Quad(0), In<Quad>(z),
                                   {Quad(0), Quad(0), Quad(1), Quad(0), Quad(0), Quad(0)})
                .relative(),
            1e-3);
}

// The sleigh's Hamiltonian bracket: of the speed u = p_x cos + p_y sin and of omega = p_theta / J it is
// r omega / (J + r^2), linear, so that the two move by the Hamiltonian equations u' = r omega^2,
// omega' = -r u omega / (J + r^2) of the energy (u^2 + (J + r^2) omega^2)/2.
TEST(NonholonomicBracket, ReducedBracketOfTheSleigh) {
  const auto model = make_model(descriptor, Sleigh{});
  const NonholonomicBracket bracket(*model);
  const auto z = bracket.projected(Quad(0), state<Quad>(6, 4));
  const Quad c = cos(z[2]), s = sin(z[2]), j(2), r = Quad(3) / Quad(4), omega = z[5] / j,
             u = z[3] * c + z[4] * s;
  const std::vector<Quad> du{Quad(0), Quad(0), z[4] * c - z[3] * s, c, s, Quad(0)},
      domega{Quad(0), Quad(0), Quad(0), Quad(0), Quad(0), Quad(1) / j};
  const auto tensor = bracket.tensor(Quad(0), z);
  EXPECT_LE(abs(paired(du, tensor, domega) - r * omega / (j + r * r)), Quad(1e-32));
  const auto slopes = values(model->tape(Formula::hamiltonian_gradient), z);
  EXPECT_LE(abs(paired(du, tensor, slopes) - r * omega * omega), Quad(1e-32));
  EXPECT_LE(abs(paired(domega, tensor, slopes) + r * u * omega / (j + r * r)), Quad(1e-32));
}

template <class S>
std::string refusal(const S& system) {
  try {
    (void)NonholonomicBracket(*make_model(descriptor, system));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
// Two constraints that say the same where x = 0.
struct Dependent : Curved {
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    for (std::size_t k = 0; k < 8; ++k) rows[k] = T(1);
    rows[4] = T(1) + q[0];
  }
};
TEST(NonholonomicBracket, BadInputIsNamed) {
  EXPECT_EQ(
      refusal(NotQuadratic{}),
      "nonholonomic bracket: the Hamiltonian of system sample is not quadratic in the momenta; expected a "
      "kinetic energy with a mass matrix M(q)");
  EXPECT_THROW(NonholonomicBracket(*systems().get("pendulum", "system").make({})), InputError);
  const NonholonomicBracket bracket(*make_model(descriptor, Dependent{}));
  EXPECT_NO_THROW((void)bracket.projectors<double>(0, {1, 2, 3, 4}));
  try {
    (void)bracket.projectors<double>(0, {0, 2, 3, 4});
    FAIL() << "dependent constraints were accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "one-forms: row 2 (psi2) is a combination of row 1 (psi1); expected one-forms that are independent");
  }
}

}  // namespace
