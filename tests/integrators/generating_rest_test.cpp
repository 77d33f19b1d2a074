// Generating-function schemes for motions that come to rest, where a momentum in the chart is smaller than
// what the forces round that cancel each other there.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/systems/birkhoffian/exponential_chart.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;

// Damped pendula, each turned by a torque and coupled to the next: at rest, sin r = torque for all of them.
template <int count>
struct TurnedPendula : ExponentialChart<TurnedPendula<count>> {
  static constexpr int dimension = 2 * count;
  Real nu = Real::fraction(2, 5), torque = Real::fraction(1, 2), coupling = Real::fraction(1, 10);

  template <class T>
  T potential_of(In<T> r) const {
    T sum(0);
    for (std::size_t k = 0; k < count; ++k) {
      sum = sum - cos(r[k]) - torque * r[k];
      if (k > 0) sum = sum + coupling * (r[k] - r[k - 1]) * (r[k] - r[k - 1]) / 2;
    }
    return sum;
  }
  template <class T>
  T pull(In<T> r, std::size_t k) const {
    T sum = torque - sin(r[k]);
    if (k > 0) sum = sum - coupling * (r[k] - r[k - 1]);
    if (k + 1 < count) sum = sum + coupling * (r[k + 1] - r[k]);
    return sum;
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    T sum = potential_of<T>(z.first(count));
    for (std::size_t k = 0; k < count; ++k)
      sum = sum + z[count + k] * z[count + k] / 2 + nu * z[k] * z[count + k] / 2;
    return this->growth(t) * sum;
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    const T factor = this->growth(t);
    for (std::size_t k = 0; k < count; ++k) {
      rate[k] = y[count + k] / factor;
      rate[count + k] = factor * pull<T>(y.first(count), k);
    }
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < count; ++k) {
      rate[k] = z[count + k];
      rate[count + k] = pull<T>(z.first(count), k) - nu * z[count + k];
    }
  }
  // The same as damped-pendulum's, for each of them.
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    for (std::size_t k = 0; k < count; ++k) {
      const T new_p = this->growth(t) * new_z[count + k], old_p = this->growth(t0) * old_z[count + k];
      const T rise = new_p - old_p, turn = new_z[k] - old_z[k];
      w_hat[k] = rise;
      w_hat[count + k] = turn;
      w[k] = (new_z[k] + old_z[k] + turn * turn) / 2;
      w[count + k] = rise * turn - (new_p + old_p) / 2;
    }
  }
};

template <int count>
std::shared_ptr<const Model> turned_pendula() {
  SystemDescriptor descriptor{.name = "turned", .title = "turned pendula", .reference = "su-qin"};
  for (const char* kind : {"r", "p"})
    for (int k = 0; k < count; ++k) descriptor.coordinates.push_back({kind + std::to_string(k), ""});
  for (int k = 0; k < 2 * count; ++k) descriptor.initial.push_back(Real::fraction(k < count ? 9 + k : 3, 10));
  return make_model(descriptor, TurnedPendula<count>());
}

// Comes to rest at sin r = torque to what the forces round: they cancel to about h u, and pull back once a
// step.
template <int count, class T>
void comes_to_rest(const Assignments& settings, const T& h, double time,
                   const char* name = "generating-function") {
  const std::shared_ptr<const MethodInstance> method = method_named(name, settings);
  SCOPED_TRACE(method->called() + " of " + std::to_string(count));
  Integration<T> run = integrate<T>(turned_pendula<count>(), method, h);
  const Outcome outcome = run.steps(static_cast<std::int64_t>(time / static_cast<double>(h)));
  EXPECT_TRUE(outcome.reached()) << outcome.message();
  const T place = asin(T(1) / T(2));
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_LE(abs(T(run.state()[k] - place)), 64 * unit_roundoff<T>() * place) << k;
    EXPECT_LE(abs(run.state()[count + k]), 64 * unit_roundoff<T>()) << k;
  }
}

TEST(GeneratingRest, EveryOrderComesToIt) {
  for (const char* order : {"1", "2", "3", "4", "6", "8"})
    for (const double h : {0.1, 0.25, 0.8}) comes_to_rest<1, double>({{"order", order}}, h, 400);
  for (const char* form : {"qhat-p", "q-phat"})
    comes_to_rest<1, double>({{"order", "2"}, {"form", form}}, 0.1, 400);
  comes_to_rest<1, double>({{"order", "4"}, {"variant", "P"}}, 0.25, 400);
}
TEST(GeneratingRest, EveryOrderComesToItInQuad) {
  for (const char* order : {"2", "3", "6"})
    comes_to_rest<1, Quad>({{"order", order}}, Quad(4) / Quad(5), 480);
}
// Corrected with a matrix, and without one.
TEST(GeneratingRest, SystemsOfEverySizeComeToIt) {
  for (const char* order : {"2", "4", "6"}) {
    comes_to_rest<3, double>({{"order", order}}, 0.25, 400);
    comes_to_rest<6, double>({{"order", order}}, 0.25, 400);
  }
}
TEST(GeneratingRest, SchemesWithoutAChartComeToIt) {
  for (const char* order : {"1", "2", "3", "4"}) {
    for (const double h : {0.1, 0.25, 0.8})
      comes_to_rest<1, double>({{"order", order}}, h, 200, "generating-function-alpha");
    comes_to_rest<1, Quad>({{"order", order}}, Quad(1) / Quad(4), 400, "generating-function-alpha");
  }
  comes_to_rest<3, double>({{"order", "2"}}, 0.25, 200, "generating-function-alpha");
}

// A position of 1e-5 and a momentum of 1e-24, which change by their own size with each other: a derivative of
// the momentum of 1e-19 is as large as one of 1 is.
TEST(GeneratingRest, DerivativesAreCorrectedInTheUnitsOfTheirComponents) {
  using T = Dual<double, 2>;
  const auto number = [](double value, double by_position, double by_momentum) {
    T x(value);
    x.derivative = {by_position, by_momentum};
    return x;
  };
  const std::vector<T> state{number(1e-5, 1, 1e19), number(1e-24, 1e-19, 1)};
  const std::vector<T> still(2, T(0));
  const auto of = [&](const T& position, const T& momentum) {
    return largest_correction<T>(std::vector<T>{position, momentum}, state, still);
  };
  EXPECT_NEAR(of(number(0, 0, 0), number(0, 1e-22, 0)), 1e-3, 1e-15);
  EXPECT_NEAR(of(number(0, 0, 1e16), number(0, 0, 0)), 1e-3, 1e-15);
  EXPECT_NEAR(of(number(1e-8, 0, 0), number(0, 0, 0)), 1e-3, 1e-15);
  EXPECT_TRUE(std::isnan(of(number(0, NAN, 0), number(0, 0, 0))));
  EXPECT_TRUE(std::isnan(of(number(NAN, 0, 0), number(1, 0, 0))));
}

}  // namespace
}  // namespace pfaff
