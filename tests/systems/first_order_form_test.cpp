// Systems written as K zdot + D = 0: the field, the Poisson tensor and charts, against the same system
// written by F and B, and what is refused because it does not fit together.
#include <gtest/gtest.h>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/verify/check.hpp>

#include "../formula_values.hpp"
#include "samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

// The damped pendulum, twice: e^{nu t} (p' + nu p + sin q) = 0 and e^{nu t} (q' - p) = 0; F, B as su-qin
// (93).
struct ByEquations {
  static constexpr int dimension = 2;
  Real nu = 0.3_r;
  template <class T>
  void structure(const T& t, In<T> /*z*/, Out<T> K) const {
    K[1] = -exp(nu * t);
    K[2] = exp(nu * t);
  }
  template <class T>
  void covector(const T& t, In<T> z, Out<T> D) const {
    D[0] = -(exp(nu * t) * (nu * z[1] + sin(z[0])));
    D[1] = -(exp(nu * t) * z[1]);
  }
};
struct Charted : ByEquations {
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = exp(nu * t) * z[1] + z[0] * z[0];
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = exp(-(nu * t)) * (y[1] - y[0] * y[0]);
  }
};
struct ByActionForm {
  static constexpr int dimension = 2;
  Real nu = 0.3_r;
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return exp(nu * t) * (z[1] * z[1] / 2 - cos(z[0]));
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = exp(nu * t) * z[1];
  }
};
template <class S>
std::shared_ptr<const Model> sample_of(const S& object) {
  SystemDescriptor descriptor;
  descriptor.name = "test";
  descriptor.coordinates = {{"q", ""}, {"p", ""}};
  descriptor.initial = {1, Real::fraction(1, 2)};
  return make_model(descriptor, object);
}

TEST(FirstOrderForm, IsTheSystemOfTheActionForm) {
  const auto written = sample_of(ByEquations{}), charted = sample_of(Charted{}),
             form = sample_of(ByActionForm{});
  EXPECT_TRUE(written->facets().has(Facet::structure));
  EXPECT_TRUE(written->facets().has(Facet::darboux_chart));
  EXPECT_TRUE(written->facets().has(Facet::vector_field));
  EXPECT_FALSE(written->facets().has(Facet::birkhoffian));
  EXPECT_TRUE(form->facets().has(Facet::structure));
  Samples samples(3);
  for (int point = 0; point < 20; ++point) {
    const Numbers z{samples.quad(-2, 2), samples.quad(-2, 2)};
    const Quad t = samples.quad(0, 3);
    for (const Formula formula : {Formula::structure, Formula::covector, Formula::field,
                                  Formula::poisson_tensor, Formula::chart, Formula::chart_field})
      EXPECT_LE(relative_distance(values(written->tape(formula), t, z), values(form->tape(formula), t, z)),
                Quad(1e-32))
          << static_cast<int>(formula);
    // Closed forms, and the field in the author's chart: y1' = e^{nu t} (p' + nu p) + 2 q q'.
    const Quad e = exp(Quad(0.3_r) * t), velocity = z[1], pull = -sin(z[0]) - Quad(0.3_r) * z[1];
    EXPECT_LE(relative_distance(values(written->tape(Formula::field), t, z), {velocity, pull}), Quad(1e-32));
    const Numbers y = values(charted->tape(Formula::chart), t, z);
    EXPECT_LE(relative_distance(values(charted->tape(Formula::chart_field), t, y),
                                {velocity, -(e * sin(z[0])) + Quad(2) * z[0] * velocity}),
              Quad(1e-31));
    EXPECT_GT(relative_distance(
                  values(charted->tape(Formula::chart_field), t, y),  // control: time left out of the chart
                  {velocity, e * pull + Quad(2) * z[0] * velocity}),
              Quad(1e-3) * abs(z[1]));
  }
}

// D that depends on no potential and K on the state: no chart, said why.
struct StateDependent {
  static constexpr int dimension = 2;
  template <class T>
  void structure(const T& /*t*/, In<T> z, Out<T> K) const {
    K[1] = -(1 + z[0] * z[0]);
    K[2] = -K[1];
  }
  template <class T>
  void covector(const T& /*t*/, In<T> z, Out<T> D) const {
    D[0] = -z[0];
    D[1] = -z[1];
  }
};
TEST(FirstOrderForm, WithoutAChartSaysWhy) {
  const auto model = sample_of(StateDependent{});
  EXPECT_FALSE(model->facets().has(Facet::darboux_chart));
  EXPECT_NE(model->advice(FacetSet{}.with(Facet::darboux_chart)).find("depends on the state"),
            std::string::npos);
  const Numbers z{Quad(2), Quad(3)};
  EXPECT_LE(relative_distance(values(model->tape(Formula::field), Quad(0), z),
                              {Quad(3) / Quad(5), Quad(-2) / Quad(5)}),
            Quad(1e-33));
}

TEST(FirstOrderForm, MethodsKeepItsStructure) {
  const auto model = systems().get("magnetic-induction", "system").make({});
  const std::vector<Quad> z{Quad(1), Quad(0.25), Quad(0.2), Quad(0.6)};
  const auto residual = [&](const char* name, const Assignments& set) {
    const auto method = integrators().get(name, "integrator").make(set);
    EXPECT_EQ(method->refuses(*model), "") << name;
    return StructureResidual<Quad>(*method, model)(Quad(0.4), Quad(0.1), z);
  };
  EXPECT_TRUE(StructureResidual<Quad>::applies(*model));
  EXPECT_LE(residual("generating-function", {{"order", "4"}}), Quad(1e-31));
  EXPECT_GT(residual("rk4", {}), Quad(1e-9));  // control
}

}  // namespace
