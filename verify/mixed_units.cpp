// Methods whose steps depend on the units in which a system is written, because they add numbers of different
// ones.
#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/stated_identities.hpp>
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

bool adds_up_units(const MethodOnModel& on) {
  constexpr double round_off = 1e-25;  // of a step in quad, which ends its iterations at 1e-33 or so
  const Model& model = *on.model();
  if (!model.source().canonical || model.restricted() || model.source().flows != nullptr) return false;
  const std::vector<double> scales = coordinate_scales(model);
  const std::size_t half = scales.size() / 2;
  const std::vector<Real> units{power_of_two_near(scales, 0, half), power_of_two_near(scales, half, half)};
  const auto other = in_units(model, units[0], units[1]);
  if (!on.method().refuses(*other).empty()) return false;
  std::vector<Real> start = on.start();
  for (std::size_t k = 0; k < start.size(); ++k) start[k] = start[k] / units[k / half];
  MeasuredStep<Quad> here(on.method(), on.model(), on.start(), on.time(), on.step_size()),
      there(on.method(), other, start, on.time(), on.step_size());
  if (!here.end() || !there.end()) return !here.end() != !there.end();
  for (const std::size_t first : {std::size_t{0}, half}) {
    Quad difference(0), size(0);
    for (std::size_t k = first; k < first + half; ++k) {
      size = std::max(size, abs((*here.end())[k]));
      difference = std::max(difference, abs((*there.end())[k] * units[k / half].quad() - (*here.end())[k]));
    }
    if (difference > Quad(round_off) * size) return true;
  }
  return false;
}

}  // namespace pfaff
