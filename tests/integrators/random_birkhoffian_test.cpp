// The engine on random Birkhoffian systems. Each is a random polynomial Hamiltonian with the canonical
// one-form, pulled back through random polynomial shears that depend on time. The composed shears are the
// Darboux chart, so that F, B and the chart are known; K(z, t), the field and the field in the chart are
// derived.
#include <gtest/gtest.h>

#include <random>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/check.hpp>

#include "generating_samples.hpp"
#include "methods.hpp"

namespace pfaff {
namespace {

using testing::generating_scheme;
using testing::structure_residual;

constexpr int degrees = 2, states = 2 * degrees;

// y = (q + g(p', t), p') after p' = p + f(q, t) with gradients f = grad f0(q), so that K in z is not
// canonical: the shears act on q or p componentwise by arbitrary polynomials, which makes them
// non-symplectic.
class RandomSystem {
 public:
  explicit RandomSystem(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> coefficient(-9, 9);
    const auto draw = [&] { return Real::fraction(coefficient(random), 20); };
    for (auto* list : {&first_, &second_})
      for (Real& c : *list) c = draw();
    for (Real& c : energy_) c = draw();
  }

  // p += f(q, t), then q += g(p, t).
  template <class T>
  void chart(const T& t, std::span<const T> z, std::span<T> y) const {
    for (int i = 0; i < degrees; ++i)
      y[at(degrees + i)] = z[at(degrees + i)] + shear(first_, i, t, z[0], z[1]);
    for (int i = 0; i < degrees; ++i) y[at(i)] = z[at(i)] + shear(second_, i, t, y[2], y[3]);
  }
  template <class T>
  void chart_inverse(const T& t, std::span<const T> y, std::span<T> z) const {
    for (int i = 0; i < degrees; ++i) z[at(i)] = y[at(i)] - shear(second_, i, t, y[2], y[3]);
    for (int i = 0; i < degrees; ++i)
      z[at(degrees + i)] = y[at(degrees + i)] - shear(first_, i, t, z[0], z[1]);
  }
  // Definite quadratic part with random cubic and time-dependent terms.
  template <class T>
  T energy(const T& t, std::span<const T> y) const {
    T sum = (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]) / 2;
    for (int i = 0; i < states; ++i)
      for (int j = 0; j < states; ++j)
        sum = sum + energy_[at(i * states + j)] * (y[at(i)] * y[at(i)] * y[at(j)]) / 4 +
              energy_[at(states * states + i)] * sin(t) * y[at(i)] / 8;
    return sum;
  }

  [[nodiscard]] std::shared_ptr<const Model> model() const {
    ModelSource source;
    source.name = "random";
    source.dimension = states;
    for (int k = 0; k < states; ++k)
      source.coordinates.push_back({std::string("z").append(std::to_string(k)), ""});
    source.initial = {Real::fraction(3, 10), Real::fraction(-1, 5), Real::fraction(1, 10),
                      Real::fraction(2, 5)};
    const auto give = [&](Formula formula, int outputs, auto&& f) {
      source.given[index(formula)] = std::make_shared<const Tape>(record(states, outputs, f));
    };
    using R = Recorded;
    using In_ = std::span<const R>;
    using Out_ = std::span<R>;
    give(Formula::chart, states, [&](const R& t, In_ z, Out_ y) { chart<R>(t, z, y); });
    give(Formula::chart_inverse, states, [&](const R& t, In_ y, Out_ z) { chart_inverse<R>(t, y, z); });
    const auto chart_tape = source.given[index(Formula::chart)];
    // p dq - H dt in y, pulled back: F_i = y_p . d y_q / d z_i,  B = H - y_p . d y_q / dt.
    give(Formula::one_form, states, [&](const R& t, In_ z, Out_ form) {
      const auto y = evaluate(*chart_tape, t, z);
      const auto slope = jacobian(*chart_tape, t, z);
      for (std::size_t i = 0; i < states; ++i)
        for (std::size_t a = 0; a < degrees; ++a) form[i] = form[i] + y[degrees + a] * slope[a * states + i];
    });
    give(Formula::birkhoffian, 1, [&](const R& t, In_ z, Out_ b) {
      const auto y = evaluate(*chart_tape, t, z);
      const auto rate = time_derivative(*chart_tape, t, z);
      b[0] = energy<R>(t, y);
      for (std::size_t a = 0; a < degrees; ++a) b[0] = b[0] - y[degrees + a] * rate[a];
    });
    return std::make_shared<const Model>(std::move(source));
  }

 private:
  static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
  template <class T>
  static T shear(const std::array<Real, 12>& c, int i, const T& t, const T& a, const T& b) {
    const auto k = at(6 * i);
    return (c[k] * a * a + c[k + 1] * a * b + c[k + 2] * b * b) * (1 + c[k + 3] * t) + c[k + 4] * a * a * b +
           c[k + 5] * sin(t) * a;
  }
  std::array<Real, 12> first_, second_;
  std::array<Real, states * states + states> energy_;
};

TEST(RandomBirkhoffian, EveryOrderKeepsTheStructureAtRoundOff) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto model = RandomSystem(seed).model();
    for (int order = 1; order <= 8; ++order) {
      // Structure to the residual's own round-off: products of three 4 x 4 matrices, pulled through two
      // charts.
      EXPECT_LE(structure_residual<double>(*generating_scheme(order, "P"), model), 1e-14)
          << seed << ' ' << order;
      EXPECT_LE(structure_residual<Quad>(*generating_scheme(order, "P"), model), 1e-31)
          << seed << ' ' << order;
      if (order % 2 == 0) {
        EXPECT_LE(structure_residual<Quad>(*generating_scheme(order, "S"), model), 1e-31)
            << seed << ' ' << order;
      }
    }
  }
}

struct Rival {
  const char* name;
  Assignments parameters;
  int order;
};
std::vector<Rival> rivals() {
  return {{"gauss-darboux", {{"stages", "1"}}, 2}, {"gauss-darboux", {{"stages", "2"}}, 4},
          {"gauss-darboux", {{"stages", "4"}}, 8}, {"yoshida", {{"order", "4"}}, 4},
          {"suzuki", {{"order", "4"}}, 4},         {"kahan-li", {{"order", "6"}}, 6}};
}

TEST(RandomBirkhoffian, MethodsInDarbouxCoordinatesKeepItToo) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto model = RandomSystem(seed).model();
    for (const Rival& rival : rivals()) {
      const auto method = integrators().get(rival.name, "").make(rival.parameters);
      EXPECT_LE(structure_residual<double>(*method, model), 1e-14) << seed << ' ' << rival.name;
      EXPECT_LE(structure_residual<Quad>(*method, model), 1e-31) << seed << ' ' << rival.name;
      EXPECT_NEAR(measure_order(*method, model).slope, rival.order, 0.1) << seed << ' ' << rival.name;
    }
  }
}

TEST(RandomBirkhoffian, OthersDoNot) {  // control
  const auto model = RandomSystem(1).model();
  for (const char* name : {"rk4", "implicit-midpoint", "gauss", "leap-frog"})
    EXPECT_GT(structure_residual<Quad>(*integrators().get(name, "").make({}), model), 1e-10) << name;
}

TEST(RandomBirkhoffian, OrdersAreExact) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto model = RandomSystem(seed).model();
    for (int order = 1; order <= 6; ++order) {
      const MeasuredOrder p = measure_order(*generating_scheme(order, "P"), model);
      EXPECT_NEAR(p.slope, order, 0.1) << "variant P, seed " << seed;
      if (order % 2 == 0) {
        EXPECT_NEAR(measure_order(*generating_scheme(order, "S"), model).slope, order, 0.1) << seed;
      }
    }
  }
}

TEST(RandomBirkhoffian, FieldInTheChartIsTheFieldCarriedThere) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto model = RandomSystem(seed).model();
    const auto chart = model->tape(Formula::chart), field = model->tape(Formula::field);
    const auto in_chart = model->tape(Formula::chart_field);
    const Tape difference =
        record(states, states, [&](const Recorded& t, std::span<const Recorded> z, std::span<Recorded> out) {
          const auto carried = directional_derivative(*chart, t, Recorded(1), z, evaluate(*field, t, z));
          const auto there = evaluate(*in_chart, t, evaluate(*chart, t, z));
          for (std::size_t k = 0; k < states; ++k) out[k] = carried[k] - there[k];
        });
    Replay<Quad> replay(std::make_shared<const Tape>(difference));
    std::vector<Quad> z, out(states);
    for (const Real& x : model->initial()) z.push_back(x.quad());
    replay(Quad(0.7), z.data(), out.data());
    for (const Quad& x : out) EXPECT_LE(static_cast<double>(abs(x)), 1e-31) << seed;
  }
}

}  // namespace
}  // namespace pfaff
