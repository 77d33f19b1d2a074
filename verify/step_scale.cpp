#include <pfaff/verify/step_scale.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/tape/rounded_terms.hpp>
#include <pfaff/core/tape/taylor_expansion.hpp>
#include <pfaff/runs/support/scales.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {

namespace {
// The field of a constrained motion may be a formula of a million operations.
constexpr std::size_t few_coordinates = 16, few_operations = 8192;
// Rates between 1/ordinary_rate and ordinary_rate are taken as one; others are brought to the nearer of
// these.
constexpr double ordinary_rate = 8;
constexpr int degrees = 10;

TaylorExpansion<Quad> expanded(const Model& motion, const Real& t, const std::vector<Real>& z) {
  TaylorExpansion<Quad> expansion(motion.tape(Formula::field), degrees);
  std::vector<Quad> at;
  for (const Real& x : z) at.push_back(x.quad());
  expansion.expand(t.quad(), at.data());
  return expansion;
}

// The largest rate at which a coordinate changes in units of its size, from the terms of the degrees first,
// ..., degrees; coordinates of size zero are left out. Zero where nothing changes.
double largest_rate(const TaylorExpansion<Quad>& expansion, int first, const std::vector<double>& sizes) {
  const std::size_t n = sizes.size();
  double rate = 0;
  for (int degree = first; degree <= degrees; ++degree)
    for (std::size_t k = 0; k < n; ++k) {
      const Quad term = abs(expansion.coefficients()[static_cast<std::size_t>(degree) * n + k]);
      if (sizes[k] == 0 || term == Quad(0)) continue;
      const double of_term = static_cast<double>(exp(log(term / Quad(sizes[k])) / Quad(degree)));
      if (!std::isfinite(of_term)) return 0;
      rate = std::max(rate, of_term);
    }
  return rate;
}
// The rate of a motion from z: the size of a term of high degree tells it whatever the sizes of single
// coordinates are.
double rate_of(const TaylorExpansion<Quad>& expansion, const std::vector<Real>& z) {
  return largest_rate(expansion, 6, coordinate_scales(z));
}
// What a motion of that rate makes of coordinate k in its own time.
Quad made_of(const TaylorExpansion<Quad>& expansion, std::size_t k, double rate) {
  Quad size(0), power(1);
  for (int degree = 1; degree <= degrees; ++degree) {
    power = power / Quad(rate);
    const auto term = static_cast<std::size_t>(degree) * expansion.size() + k;
    size = std::max(size, Quad(abs(expansion.coefficients()[term]) * power));
  }
  return size;
}
}  // namespace

bool is_short(const Model& motion) {
  return motion.dimension() <= static_cast<int>(few_coordinates) ||
         motion.tape(Formula::field)->code.size() <= few_operations;
}

std::vector<double> coordinate_scales(const std::vector<Real>& centre) {
  std::vector<double> sizes;
  for (const Real& x : centre) sizes.push_back(std::abs(x.value()));
  return scales_of(sizes);
}

std::vector<double> coordinate_scales(const Model& motion, const Real& t, const std::vector<Real>& z) {
  std::vector<double> scales = coordinate_scales(z);
  double largest = 0;
  for (const Real& x : z) largest = std::max(largest, std::abs(x.value()));
  const auto is_zero = [largest](const Real& x) { return std::abs(x.value()) <= no_size * largest; };
  if (std::none_of(z.begin(), z.end(), is_zero) || !is_short(motion)) return scales;
  const std::size_t n = z.size();
  const TaylorExpansion<Quad> expansion = expanded(motion, t, z);
  std::vector<double> known(n);
  for (std::size_t k = 0; k < n; ++k) known[k] = is_zero(z[k]) ? 0 : scales[k];
  const double rate = largest_rate(expansion, 1, known);
  if (rate == 0) return scales;
  std::vector<Quad> at, sizes;
  for (const Real& x : z) at.push_back(x.quad()), sizes.push_back(abs(x.quad()));
  RoundedTerms<Quad> terms_of_rates(motion.tape(Formula::field));
  const std::vector<Quad>& terms = terms_of_rates(t.quad(), at, sizes);
  for (std::size_t k = 0; k < n; ++k) {
    if (!is_zero(z[k])) continue;
    // Where the terms of a rate cancel, as far from what moves, they tell the size: not what they round.
    const Quad size = std::max(Quad(terms[k] / Quad(64 * rate)), made_of(expansion, k, rate));
    if (size > Quad(0) && isfinite(size)) scales[k] = scales_of({static_cast<double>(size)}).front();
  }
  return scales;
}

std::vector<double> coordinate_scales(const Model& model) {
  return model.moves() ? coordinate_scales(model, generic_time_of(model), model.initial())
                       : coordinate_scales(model.initial());
}

std::string differing_sizes(const Model& model) {
  constexpr int most = 4;
  std::vector<double> scales = coordinate_scales(model);
  if (model.moves() && is_short(model)) {
    // A coordinate that starts small becomes as large as the motion makes it in its own time.
    const auto expansion = expanded(model, generic_time_of(model), model.initial());
    const double rate = rate_of(expansion, model.initial());
    for (std::size_t k = 0; k < scales.size() && rate > 0; ++k)
      scales[k] = std::max(scales[k], static_cast<double>(made_of(expansion, k, rate)));
  }
  const auto [smallest, largest] = std::minmax_element(scales.begin(), scales.end());
  const double power = std::log2(*largest / *smallest);
  if (power <= most) return {};
  return "sizes of coordinates differ by 2^" + std::to_string(static_cast<int>(std::floor(power)));
}

Quad own_time(const Model& motion, const Real& t, const std::vector<Real>& z) {
  if (!is_short(motion)) return Quad(1);
  const double rate = rate_of(expanded(motion, t, z), z);
  if (rate == 0 || (rate <= ordinary_rate && rate >= 1 / ordinary_rate)) return Quad(1);
  const double nearest = rate > 1 ? ordinary_rate : 1 / ordinary_rate;
  return Quad(std::exp2(-std::round(std::log2(rate / nearest))));
}

template <class T>
std::vector<T> step_scales(const Model& motion, const T& t, const T& h, const std::vector<T>& start,
                           const std::vector<T>& end) {
  const std::size_t n = start.size();
  std::vector<T> scales(n);
  for (std::size_t k = 0; k < n; ++k) scales[k] = std::max(T(abs(start[k])), T(abs(end[k])));
  if (!is_short(motion)) {
    const T largest = *std::max_element(scales.begin(), scales.end());
    scales.assign(n, largest);
    return scales;
  }
  RoundedTerms<T> terms_of_rates(motion.tape(Formula::field));
  const std::vector<T> terms = terms_of_rates(t, start, scales);
  for (std::size_t k = 0; k < n; ++k) scales[k] = scales[k] + T(abs(h)) * terms[k];
  // A coordinate that is zero and stays zero has no size of its own; it takes that of the largest one.
  const T largest = *std::max_element(scales.begin(), scales.end());
  for (T& x : scales)
    if (x == T(0)) x = largest == T(0) ? T(1) : largest;
  return scales;
}

template std::vector<double> step_scales(const Model&, const double&, const double&,
                                         const std::vector<double>&, const std::vector<double>&);
template std::vector<Quad> step_scales(const Model&, const Quad&, const Quad&, const std::vector<Quad>&,
                                       const std::vector<Quad>&);

}  // namespace pfaff
