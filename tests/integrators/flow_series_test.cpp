// The terms of the flow's Taylor series from compiled fields, in two lanes without loops and in one with
// them, and from tapes, against the series from the tape in quad.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating/flow_series.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {
namespace {

// The degrees up to which two lanes are compiled without loops, the next one, and the last that fits.
constexpr std::size_t degrees[] = {1, 2, 7, 11, 12, 15};

// The largest difference of a term from that of the tape's series in quad, relative to the larger of the term
// and of the first term.
template <class Series>
double worst_difference(Series& series, const Model& model, double t, double h, double field_time) {
  const auto n = static_cast<std::size_t>(model.dimension());
  std::vector<double> z, y(n);
  for (const Real& x : generic_state(model)) z.push_back(x.value());
  Replay<double>(model.tape(Formula::chart))(t, z.data(), y.data());
  std::vector<Quad> exact_y(y.begin(), y.end());
  TaylorExpansion<Quad> exact(model.tape(Formula::chart_field), static_cast<int>(series.degree()));
  exact.expand(Quad(field_time), exact_y.data());
  series.expand(t, h, y.data());
  double worst = 0;
  Quad power(1);
  double first = 0;
  for (std::size_t l = 1; l <= series.degree(); ++l) {
    power = power * Quad(h);
    for (std::size_t k = 0; k < n; ++k) {
      const auto expected = static_cast<double>(power * exact.coefficients()[l * n + k]);
      if (l == 1) first = std::max(first, std::abs(expected));
      const double difference = std::abs(static_cast<double>(series.term(k, l)) - expected);
      worst = std::max(worst, std::isnan(difference) ? INFINITY : difference / (std::abs(expected) + first));
    }
  }
  return worst;
}

// Sums of at most 15 products each, in 15 recurrences one after the other.
constexpr double tolerance = 1e-13;

TEST(FlowSeries, CompiledAndTapedIsThatOfEveryRegisteredField) {
  int compiled = 0;
  for (const SystemPlugin* plugin : systems().all()) {
    const auto model = plugin->make({});
    if (!model->facets().has(Facet::darboux_chart)) continue;
    SCOPED_TRACE(plugin->name());
    const Problem<double> problem(model);
    for (const std::size_t degree : degrees)
      // The second step is another one, so that nothing of the first is taken for it.
      for (FlowSeries<double> series(problem, degree); const double h : {0.05, -0.02}) {
        SCOPED_TRACE(degree);
        EXPECT_EQ(series.degree(), degree);
        compiled += series.is_compiled() ? 1 : 0;
        EXPECT_LE(worst_difference(series, *model, 0.4, h, 0.4), tolerance);
        TapedFlowSeries<double> taped(model->tape(Formula::chart_field), degree);
        EXPECT_LE(worst_difference(taped, *model, 0.4, h, 0.4), tolerance);
      }
  }
  EXPECT_GE(compiled, 7 * 2 * static_cast<int>(std::size(degrees)));
}

// The control: the field at a time that is 1e-9 later.
TEST(FlowSeries, TellsAnotherTimeApart) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  FlowSeries<double> series(Problem<double>(model), 7);
  EXPECT_TRUE(series.is_compiled());
  EXPECT_GT(worst_difference(series, *model, 0.4, 0.05, 0.4 + 1e-9), 1e-11);
}

}  // namespace
}  // namespace pfaff
