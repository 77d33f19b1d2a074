// Birkhoffian systems: K is skew and closed, the chart is Darboux, the field solves K z' = grad B + F_t.
#include <gtest/gtest.h>

#include <functional>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/tape/derivatives.hpp>

#include "../formula_values.hpp"
#include "samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

constexpr int structure_points = 20;
constexpr double structure_bound = 1e-31;

struct Residuals {
  double skew = 0, closed = 0, darboux = 0, inverse = 0, field = 0, poisson = 0, chart_field = 0;
};

// The largest residual of each identity over random points, relative to 1 + |K|.
Residuals residuals(const Model& model, Samples& samples) {
  const std::size_t n = static_cast<std::size_t>(model.dimension()), half = n / 2;
  const auto structure = model.tape(Formula::structure), chart = model.tape(Formula::chart);
  const Tape slopes = jacobian_tape(*structure), chart_slopes = jacobian_tape(*chart);
  const Tape covector =
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto slope =
            gradient(*model.tape(Formula::birkhoffian), t, z, std::vector<Recorded>{Recorded(1)});
        const auto timed = time_derivative(*model.tape(Formula::one_form), t, z);
        for (std::size_t k = 0; k < z.size(); ++k) out[k] = slope[k] + timed[k];
      });
  const Tape chart_rate =
      record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
        const auto timed = time_derivative(*chart, t, z);
        std::copy(timed.begin(), timed.end(), out.begin());
      });
  Residuals r;
  for (int point = 0; point < structure_points; ++point) {
    const Numbers z = samples.state(model, 0.3);
    const Quad t = samples.quad(0, 2);
    const Numbers k = values(*structure, t, z), dk = values(slopes, t, z), m = values(chart_slopes, t, z);
    const Numbers x = values(*model.tape(Formula::field), t, z), g = values(covector, t, z);
    const Numbers pi = values(*model.tape(Formula::poisson_tensor), t, z);
    Quad size(1);
    for (const Quad e : k) size = std::max(size, abs(e));
    const auto note = [&](double& worst, Quad value) {
      worst = isfinite(value) ? std::max(worst, static_cast<double>(abs(value) / size)) : INFINITY;
    };
    for (std::size_t i = 0; i < n; ++i) {
      Quad solved = -g[i];
      for (std::size_t j = 0; j < n; ++j) {
        note(r.skew, k[i * n + j] + k[j * n + i]);
        solved += k[i * n + j] * x[j];
        for (std::size_t l = 0; l < n; ++l)
          note(r.closed, dk[(i * n + j) * n + l] + dk[(j * n + l) * n + i] + dk[(l * n + i) * n + j]);
        // chart_z^T K_c chart_z with K_c = [[0, -I], [I, 0]].
        Quad pulled(0), identity(i == j ? -1 : 0);
        for (std::size_t a = 0; a < half; ++a)
          pulled += m[(half + a) * n + i] * m[a * n + j] - m[a * n + i] * m[(half + a) * n + j];
        note(r.darboux, pulled - k[i * n + j]);
        for (std::size_t l = 0; l < n; ++l) identity += pi[i * n + l] * k[l * n + j];
        note(r.poisson, identity);
      }
      note(r.field, solved);
    }
    const Numbers y = values(*chart, t, z), back = values(*model.tape(Formula::chart_inverse), t, y);
    const Numbers rate = values(*model.tape(Formula::chart_field), t, y), chart_t = values(chart_rate, t, z);
    for (std::size_t i = 0; i < n; ++i) {
      note(r.inverse, back[i] - z[i]);
      Quad pushed = chart_t[i];  // y' = chart_z X + chart_t
      for (std::size_t j = 0; j < n; ++j) pushed += m[i * n + j] * x[j];
      note(r.chart_field, rate[i] - pushed);
    }
  }
  return r;
}

void expect_sound(const Model& model, Samples& samples) {
  const Residuals r = residuals(model, samples);
  EXPECT_LE(r.skew, structure_bound) << model.name();
  EXPECT_LE(r.closed, structure_bound) << model.name();
  EXPECT_LE(r.darboux, structure_bound) << model.name();
  EXPECT_LE(r.inverse, structure_bound) << model.name();
  EXPECT_LE(r.field, structure_bound) << model.name();
  EXPECT_LE(r.poisson, structure_bound) << model.name();
  EXPECT_LE(r.chart_field, structure_bound) << model.name();
}

TEST(Birkhoffian, SystemsSatisfyTheirIdentities) {
  int found = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    Samples samples(51);
    for (int instance = 0; instance < 3; ++instance) {
      const auto model = plugin->make(samples.parameters(*plugin));
      if (!model->facets().has(Facet::birkhoffian) || !model->facets().has(Facet::darboux_chart)) continue;
      ++found;
      expect_sound(*model, samples);
    }
  }
  EXPECT_GE(found, 6);
}

// Two coupled oscillators in coordinates that mix everything, to try what two dimensions cannot: the chart is
// y = (z1, z2, e^t z3 + z1 z2, z4 (1 + z2^2)), so that F = (y3, y4, 0, 0) and B = H(y); plus the gauge
// d(e^{2t} z1 z3), or the parts of the field in the chart that come from time would vanish. `wrong` spoils
// the chart.
struct Folded {
  static constexpr int dimension = 4;
  int wrong = 0;
  [[nodiscard]] Real factor(int place) const { return wrong == place ? 1.000000001_r : Real(1); }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    const T y3 = exp(t) * z[2] + z[0] * z[1], y4 = z[3] * (1 + z[1] * z[1]);
    return (y3 * y3 + y4 * y4 + z[0] * z[0]) / 2 - cos(z[0] - z[1]) - 2 * exp(2 * t) * z[0] * z[2];
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = exp(t) * z[2] + z[0] * z[1] + exp(2 * t) * z[2];
    form[1] = z[3] * (1 + z[1] * z[1]);
    form[2] = exp(2 * t) * z[0];
    form[3] = T(0);
  }
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = z[1];
    y[2] = exp(factor(1) * t) * z[2] + factor(2) * z[0] * z[1];
    y[3] = z[3] * (1 + factor(3) * z[1] * z[1]);
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = y[1];
    z[2] = exp(-(factor(1) * t)) * (y[2] - factor(2) * y[0] * y[1]);
    z[3] = y[3] / (1 + factor(3) * factor(4) * y[1] * y[1]);
  }
};

TEST(Birkhoffian, IdentitiesHoldInFourDimensionsAndFailForAWrongChart) {
  const SystemDescriptor descriptor{
      .name = "folded", .title = "", .reference = "", .initial = {1, 0.5_r, 0.3_r, 0.7_r}};
  for (int wrong = 0; wrong <= 4; ++wrong) {
    Samples samples(52);
    const auto model = make_model(descriptor, Folded{wrong});
    if (wrong == 0) {
      expect_sound(*model, samples);
      continue;
    }
    const Residuals r = residuals(*model, samples);
    EXPECT_LE(r.closed, structure_bound);  // the chart has no part in K
    EXPECT_LE(r.field, structure_bound);
    EXPECT_EQ(r.darboux > 1e-12, wrong != 4) << wrong;
    EXPECT_EQ(r.inverse > 1e-12, wrong == 4) << wrong;
  }
}

// A charge in a magnetic field of strength b: K is constant and couples all variables, and so is folded away.
struct Charge {
  static constexpr int dimension = 4;
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3]) / 2;
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    form[0] = z[2] - 3 * z[1] / 2;
    form[1] = z[3] + 3 * z[0] / 2;
    form[2] = form[3] = T(0);
  }
  template <class T>
  void chart(const T& /*t*/, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = z[1];
    y[2] = z[2] - 3 * z[1];
    y[3] = z[3];
  }
  template <class T>
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = y[1];
    z[2] = y[2] + 3 * y[1];
    z[3] = y[3];
  }
};

TEST(Birkhoffian, AConstantCoupledStructureIsInverted) {
  const SystemDescriptor descriptor{
      .name = "charge", .title = "", .reference = "", .initial = {1, 0.5_r, 0.3_r, 0.7_r}};
  const auto model = make_model(descriptor, Charge{});
  Samples samples(53);
  expect_sound(*model, samples);
  for (const Instruction& i : model->tape(Formula::poisson_tensor)->code)
    EXPECT_EQ(i.operation, Operation::constant);
}

// Two masses with drag in a magnetic field that grows in time, without a chart of its author's: K(t) is
// dense. With `swirl` K depends on the state; with `degenerate` z4 has no partner.
struct Chartless {
  static constexpr int dimension = 4;
  bool swirl = false, degenerate = false;
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return exp(t / 3) * (z[2] * z[2] + z[3] * z[3]) / 2 - cos(z[0]) + z[0] * z[1] * z[1] + z[1] * z[2] / 5;
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = exp(t / 3) * z[2] - (2 + sin(t)) * z[1] + z[3] / 7;
    form[1] = degenerate ? T(0) : exp(t / 4) * z[3] + t * z[2] / 9;
    form[2] = z[3] * t / 5;
    form[3] = T(0);
    if (swirl) form[1] = form[1] + z[0] * z[0];
    if (degenerate) form[0] = exp(t) * z[2], form[2] = T(0);
  }
};

const SystemDescriptor chartless{
    .name = "chartless", .title = "", .reference = "", .initial = {1, 0.5_r, 0.3_r, 0.7_r}};

TEST(Birkhoffian, AStructureOfTimeAloneGetsItsChart) {
  const auto model = make_model(chartless, Chartless{});
  ASSERT_TRUE(model->facets().has(Facet::darboux_chart));
  EXPECT_FALSE(model->given(Formula::chart));
  Samples samples(54);
  expect_sound(*model, samples);
  // What is replayed only adds, multiplies and divides beyond the structure itself.
  for (const Instruction& i : model->tape(Formula::chart)->code)
    EXPECT_TRUE(i.operation != Operation::solve && i.operation != Operation::select);
}

TEST(Birkhoffian, NoChartIsDerivedWhereKDependsOnTheStateOrIsDegenerate) {
  const FacetSet chart = FacetSet().with(Facet::darboux_chart);
  const auto swirling = make_model(chartless, Chartless{.swirl = true});
  EXPECT_FALSE(swirling->facets().has(Facet::darboux_chart));
  EXPECT_NE(swirling->advice(chart).find("depends on the state: write chart and chart_inverse"),
            std::string::npos);
  const auto degenerate = make_model(chartless, Chartless{.degenerate = true});
  EXPECT_FALSE(degenerate->facets().has(Facet::darboux_chart));
  EXPECT_NE(degenerate->advice(chart).find("degenerate at t = 0"), std::string::npos);
  EXPECT_EQ(make_model(chartless, Chartless{})->advice(chart), "");
  // The message of a method, as users see it.
  const auto method = integrators().get("generating-function", "integrator").make({});
  EXPECT_EQ(method->refuses(*swirling),
            "generating-function needs darboux-chart; chartless offers vector-field, structure, birkhoffian; "
            "its structure K depends on the state: write chart and chart_inverse");
  EXPECT_EQ(method->refuses(*make_model(chartless, Chartless{})), "");
  EXPECT_EQ(swirling->advice(FacetSet().with(Facet::separable)), "");
}

}  // namespace
