// Methods whose steps depend on the units in which a system is written, because they add numbers of different
// ones.
#include <algorithm>
#include <array>
#include <cmath>

#include <pfaff/bench/runner/stated_identities.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {
// A canonical system with positions in units of `a` and momenta in units of `c`: H(a Q, c P)/(a c).
std::shared_ptr<const Model> in_units(const Model& model, const Real& a, const Real& c) {
  const ModelSource& old = model.source();
  const int n = model.dimension(), half = n / 2;
  ModelSource source;
  source.name = old.name;
  source.dimension = n;
  source.canonical = true;
  source.coordinates = old.coordinates;
  for (int k = 0; k < n; ++k)
    source.initial.push_back(old.initial[static_cast<std::size_t>(k)] / (k < half ? a : c));
  const auto scaled = [&](Formula formula, int inputs, int of_positions) {
    const auto energy = model.tape(formula);
    source.given[index(formula)] = expression(inputs, 1, [&](const Recorded& t, Arguments z, Results out) {
      std::vector<Recorded> x;
      for (int k = 0; k < inputs; ++k)
        x.push_back(Recorded(k < of_positions ? a : c) * z[static_cast<std::size_t>(k)]);
      out[0] = evaluate(*energy, t, x)[0] / Recorded(a * c);
    });
  };
  if (model.facets().has(Facet::separable)) {
    scaled(Formula::kinetic, half, 0);
    scaled(Formula::potential, half, half);
  } else {
    scaled(Formula::hamiltonian, n, half);
  }
  return std::make_shared<const Model>(std::move(source));
}

Real power_of_two_near(const std::vector<double>& scales, std::size_t first, std::size_t count) {
  const double largest = *std::max_element(scales.begin() + static_cast<std::ptrdiff_t>(first),
                                           scales.begin() + static_cast<std::ptrdiff_t>(first + count));
  return Real(Quad(std::exp2(std::round(std::log2(largest)))));
}
}  // namespace

namespace {
// The sizes of the positions and of the momenta of the chart at the state at which claims are measured.
std::array<double, 2> chart_sizes(const MethodOnModel& on) {
  Replay<Quad> chart(on.model()->tape(Formula::chart));
  std::vector<Quad> z, y(on.start().size());
  for (const Real& x : on.start()) z.push_back(x.quad());
  chart(on.time().quad(), z.data(), y.data());
  std::array<double, 2> sizes{};
  for (std::size_t k = 0; k < y.size(); ++k) {
    double& size = sizes[2 * k / y.size()];
    size = std::max(size, std::abs(static_cast<double>(y[k])));
  }
  return sizes;
}

// A Birkhoffian system with F/c and B/c, whose motion is the same and whose chart has momenta over c. Null
// where it states more that depends on them.
std::shared_ptr<const Model> with_action_over(const Model& model, const Real& c) {
  const ModelSource& old = model.source();
  for (const Formula f : {Formula::structure, Formula::chart_field, Formula::alpha, Formula::hamiltonian})
    if (model.given(f)) return nullptr;
  if (!model.given(Formula::one_form) || !model.given(Formula::birkhoffian) || model.restricted())
    return nullptr;
  const int n = model.dimension();
  ModelSource source;
  source.name = old.name;
  source.dimension = n;
  source.coordinates = old.coordinates;
  source.initial = old.initial;
  const auto scaled = [&](Formula formula, const auto& argument, const auto& result) {
    if (!model.given(formula)) return;
    const auto tape = model.tape(formula);
    source.given[index(formula)] = expression(n, static_cast<int>(tape->outputs.size()),
                                              [&](const Recorded& t, Arguments z, Results out) {
                                                std::vector<Recorded> x;
                                                for (int k = 0; k < n; ++k)
                                                  x.push_back(argument(k) * z[static_cast<std::size_t>(k)]);
                                                const auto values = evaluate(*tape, t, x);
                                                for (std::size_t k = 0; k < values.size(); ++k)
                                                  out[k] = values[k] * result(static_cast<int>(k));
                                              });
  };
  const auto one = [](int) { return Recorded(1); };
  const auto over = [&](int) { return Recorded(Real(1) / c); };
  const auto momenta_over = [&](int k) { return k < n / 2 ? Recorded(1) : Recorded(Real(1) / c); };
  const auto momenta_times = [&](int k) { return k < n / 2 ? Recorded(1) : Recorded(c); };
  scaled(Formula::one_form, one, over);
  scaled(Formula::birkhoffian, one, over);
  scaled(Formula::chart, one, momenta_over);
  scaled(Formula::chart_inverse, momenta_times, one);
  scaled(Formula::chart_hamiltonian, momenta_times, over);
  return std::make_shared<const Model>(std::move(source));
}

// Whether the step of a method on a system whose states have these sizes is the one on the other system.
bool same_step(const MethodOnModel& on, const std::shared_ptr<const Model>& other,
               const std::vector<Real>& units) {
  constexpr double round_off = 1e-25;  // of a step in quad, which ends its iterations at 1e-33 or so
  std::vector<Real> start = on.start();
  for (std::size_t k = 0; k < start.size(); ++k) start[k] = start[k] / units[k];
  MeasuredStep<Quad> here(on.method(), on.model(), on.start(), on.time(), on.step_size()),
      there(on.method(), other, start, on.time(), on.step_size());
  if (!here.end() || !there.end()) return !here.end() == !there.end();
  const std::size_t half = start.size() / 2;
  for (const std::size_t first : {std::size_t{0}, half}) {
    Quad difference(0), size(0);
    for (std::size_t k = first; k < first + half; ++k) {
      size = std::max(size, abs((*here.end())[k]));
      difference = std::max(difference, abs((*there.end())[k] * units[k].quad() - (*here.end())[k]));
    }
    if (difference > Quad(round_off) * size) return false;
  }
  return true;
}
}  // namespace

std::string sizes_that_differ(const MethodOnModel& on) {
  constexpr double most = 4;
  std::string differ = differing_sizes(*on.model());
  if (!differ.empty() || on.model()->source().canonical || !on.method().needs().has(Facet::darboux_chart))
    return differ;
  const auto [positions, momenta] = chart_sizes(on);
  const double power = std::abs(std::log2(positions / momenta));
  if (!(power > most) || std::isinf(power)) return {};
  return "sizes of the chart's positions and momenta differ by 2^" + std::to_string(static_cast<int>(power));
}

bool adds_up_units(const MethodOnModel& on) {
  const Model& model = *on.model();
  if (model.restricted() || model.source().flows != nullptr) return false;
  if (!model.source().canonical) {
    if (!on.method().needs().has(Facet::darboux_chart)) return false;
    const auto [positions, momenta] = chart_sizes(on);
    if (!(positions > 0 && momenta > 0)) return false;
    const auto other =
        with_action_over(model, Real(Quad(std::exp2(std::round(std::log2(momenta / positions))))));
    return other != nullptr && on.method().refuses(*other).empty() &&
           !same_step(on, other, std::vector<Real>(on.start().size(), Real(1)));
  }
  const std::vector<double> scales = coordinate_scales(model);
  const std::size_t half = scales.size() / 2;
  const Real of_positions = power_of_two_near(scales, 0, half),
             of_momenta = power_of_two_near(scales, half, half);
  const auto other = in_units(model, of_positions, of_momenta);
  std::vector<Real> units(half, of_positions);
  units.resize(2 * half, of_momenta);
  return on.method().refuses(*other).empty() && !same_step(on, other, units);
}

}  // namespace pfaff
