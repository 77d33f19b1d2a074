#include <pfaff/bench/experiment/contraction.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <pfaff/bench/experiment/carried_states.hpp>
#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/runner/parallel.hpp>

namespace pfaff {

namespace {
constexpr int corners = 96, samples = 120;
constexpr std::size_t outlines = 6;
constexpr double radius = 0.25;  // over the size of the initial state
constexpr double folds = 3;      // the law is followed to e^{-folds}

double area_of(const std::vector<double>& x, const std::vector<double>& y) {
  double twice = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t next = (k + 1) % x.size();
    twice += x[k] * y[next] - x[next] * y[k];
  }
  return twice / 2;
}
}  // namespace

bool contracts(const ResolvedRun& run) {
  const Model& model = *run.model;
  return !run.adaptive() && model.dimension() == 2 && model.facets().has(Facet::conformal) &&
         model.damping() > Real(0);
}

std::vector<CarriedDisc> carry_disc(const ResolvedRun& run, int looks) {
  const double h = run.step.value(), nu = run.model->damping().value();
  const auto steps =
      static_cast<std::int64_t>(std::clamp(std::floor(folds / nu / h), 1.0, static_cast<double>(run.steps)));
  const double q = run.initial[0].value(), p = run.initial[1].value();
  const double size = std::hypot(q, p), r = radius * (size > 0 ? size : 1);
  std::vector<std::vector<double>> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    points.push_back({q + r * std::cos(angle), p + r * std::sin(angle)});
  }
  std::vector<CarriedDisc> discs;
  double first_area = 1;
  carry(run, points, steps, looks, [&](std::int64_t step) {
    CarriedDisc disc;
    disc.t = static_cast<double>(step) * h;
    for (const std::vector<double>& z : points) {
      disc.first.push_back(z[0]);
      disc.second.push_back(z[1]);
    }
    disc.law = std::exp(-nu * disc.t);
    disc.area = area_of(disc.first, disc.second) / first_area;
    if (step == 0) first_area = std::exchange(disc.area, 1);
    if (std::isfinite(disc.area)) discs.push_back(std::move(disc));
    return true;
  });
  return discs;
}

std::string contraction_csv(const std::vector<ExperimentRun>& runs,
                            const std::vector<nlohmann::json>& summaries) {
  const auto largest = runs_at_largest_steps(runs, summaries, contracts);
  if (largest.empty()) return {};
  std::vector<std::string> rows(largest.size());
  in_parallel(largest.size(), [&](std::size_t m) {
    const ExperimentRun& run = *largest[m];
    const std::vector<CarriedDisc> discs = carry_disc(run.resolved, samples);
    const std::size_t last = discs.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      std::string outline;
      bool shown = false;
      for (std::size_t j = 0; j < outlines; ++j) shown = shown || k == j * last / (outlines - 1);
      for (std::size_t i = 0; shown && i < discs[k].first.size(); ++i)
        outline += (outline.empty() ? "" : ";") + formatted("%.6g", discs[k].first[i]) + " " +
                   formatted("%.6g", discs[k].second[i]);
      rows[m] += csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," +
                 csv_quoted(run.step) + "," + formatted("%.12g", discs[k].t) + "," +
                 formatted("%.17g", discs[k].area) + "," + formatted("%.17g", discs[k].law) + "," + outline +
                 "\n";
    }
  });
  std::string text = "case,method,step,t,area,law,outline\n";
  for (const std::string& row : rows) text += row;
  return text;
}

}  // namespace pfaff
