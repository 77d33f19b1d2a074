#include <pfaff/bench/experiment/loop_invariant.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pfaff/bench/experiment/carried_states.hpp>
#include <pfaff/bench/experiment/cells.hpp>
#include <pfaff/bench/runner/parallel.hpp>

namespace pfaff {

namespace {

constexpr std::size_t points_of_loop = 64;  // an even number of pairs
constexpr std::int64_t steps_of_loop = 1000;
constexpr int looks_at_loop = 50;
constexpr double extent = 1e-3;  // of the loop, over the sizes of the coordinates

using States = std::vector<std::vector<double>>;

// The integral around a loop of every `stride`-th of the points: the mean of F . dz/ds over s, with the
// derivative of the trigonometric polynomial through these points.
double around(const States& points, const States& forms, std::size_t stride) {
  const std::size_t count = points.size() / stride;
  // What is constant along the loop gives nothing but rounding errors.
  std::vector<double> mean(forms.front().size());
  for (const std::vector<double>& form : forms)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += form[i] / static_cast<double>(forms.size());
  double total = 0;
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t k = 0; k < count; ++k) {
      if (j == k) continue;
      const double angle =
          std::numbers::pi * (static_cast<double>(j) - static_cast<double>(k)) / static_cast<double>(count);
      const double weight = ((j + k) % 2 == 0 ? 0.5 : -0.5) / std::tan(angle);
      const std::vector<double>& form = forms[j * stride];
      double along = 0;
      for (std::size_t i = 0; i < form.size(); ++i)
        along += (form[i] - mean[i]) * (points[k * stride][i] - points.front()[i]);
      total += weight * along;
    }
  return 2 * std::numbers::pi * total / static_cast<double>(count);
}

// F at a state; of canonical systems (p, 0).
class OneForm {
 public:
  explicit OneForm(const std::shared_ptr<const Model>& model) : canonical_(model->source().canonical) {
    if (!canonical_) evaluator_ = make_evaluator<double>(model, Formula::one_form);
  }
  [[nodiscard]] std::vector<double> at(double t, const std::vector<double>& z) const {
    std::vector<double> form(z.size());
    if (canonical_) {
      std::copy(z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end(), form.begin());
    } else {
      evaluator_.call(evaluator_.context, t, z.data(), form.data());
    }
    return form;
  }

 private:
  bool canonical_;
  Evaluator<double> evaluator_;
};

// A circle about the initial state in a plane that is none of the coordinates'.
States loop_about(const std::vector<Real>& initial) {
  double square = 0;
  for (const Real& x : initial) square += x.value() * x.value();
  const double size = square > 0 ? std::sqrt(square / static_cast<double>(initial.size())) : 1;
  States points(points_of_loop);
  for (std::size_t j = 0; j < points_of_loop; ++j) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(points_of_loop);
    for (std::size_t i = 0; i < initial.size(); ++i) {
      const double x = initial[i].value(), scale = extent * std::max(std::abs(x), size / 2);
      const auto turn = static_cast<double>(i);
      points[j].push_back(
          x + scale * (std::cos(1 + 2 * turn) * std::cos(angle) + std::sin(2 + 3 * turn) * std::sin(angle)));
    }
  }
  return points;
}

}  // namespace

bool has_loop_invariant(const ResolvedRun& run) {
  const Model& model = *run.model;
  return !run.adaptive() && model.dimension() <= 64 && !model.restricted() &&
         ((model.source().canonical && model.facets().has(Facet::hamiltonian)) ||
          model.facets().has(Facet::birkhoffian));
}

std::vector<CarriedLoop> carry_loop(const ResolvedRun& run, int looks) {
  const double h = run.step.value(), t0 = run.t0.value();
  const std::int64_t steps = std::min(run.steps, steps_of_loop);
  const OneForm form(run.model);
  States points = loop_about(run.initial);
  std::vector<CarriedLoop> loops;
  double first = 1;
  carry(run, points, steps, looks, [&](std::int64_t step) {
    const double t = static_cast<double>(step) * h;
    States forms;
    for (const std::vector<double>& z : points) forms.push_back(form.at(t0 + t, z));
    const double integral = around(points, forms, 1), coarse = around(points, forms, 2);
    if (step == 0) first = integral;
    const CarriedLoop loop{t, integral / first, std::abs((integral - coarse) / first)};
    if (!std::isfinite(loop.integral)) return false;
    loops.push_back(loop);
    return true;
  });
  return loops;
}

std::string loops_csv(const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries) {
  const auto largest = runs_at_largest_steps(runs, summaries, has_loop_invariant);
  std::vector<std::string> rows(largest.size());
  in_parallel(largest.size(), [&](std::size_t m) {
    const ExperimentRun& run = *largest[m];
    for (const CarriedLoop& loop : carry_loop(run.resolved, looks_at_loop))
      rows[m] += csv_quoted(run.which->name) + "," + csv_quoted(run.method->label) + "," +
                 csv_quoted(run.step) + "," + formatted("%.12g", loop.t) + "," +
                 formatted("%.17g", loop.integral) + "," + formatted("%.3g", loop.uncertainty) + "\n";
  });
  std::string text;
  for (const std::string& row : rows) text += row;
  return text.empty() ? "" : "case,method,step,t,integral,uncertainty\n" + text;
}

}  // namespace pfaff
