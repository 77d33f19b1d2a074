#include <pfaff/bench/verification/step_scale.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
// Beyond this dimension the field may be too long a formula to be replayed for its rounding, that of
// constrained motion above all.
constexpr std::size_t most_replayed = 16;
constexpr double ordinary = 64;
}  // namespace

std::vector<double> coordinate_scales(const std::vector<Real>& centre,
                                      const std::vector<Coordinate>& coordinates) {
  const auto unit = [&](std::size_t k) {
    return k < coordinates.size() ? coordinates[k].unit : std::string();
  };
  double largest = 0;
  std::map<std::string, double> largest_in;
  for (std::size_t k = 0; k < centre.size(); ++k) {
    const double size = std::abs(centre[k].value());
    largest = std::max(largest, size);
    largest_in[unit(k)] = std::max(largest_in[unit(k)], size);
  }
  std::vector<double> scales;
  for (std::size_t k = 0; k < centre.size(); ++k) {
    double size = std::abs(centre[k].value());
    if (size == 0) size = largest_in[unit(k)];
    if (size == 0) size = largest;
    const bool is_ordinary = size == 0 || (size >= 1 / ordinary && size <= ordinary);
    scales.push_back(is_ordinary ? 1 : std::exp2(std::round(std::log2(size))));
  }
  return scales;
}

template <class T>
std::vector<T> step_scales(const Model& motion, const T& t, const T& h, const std::vector<T>& start,
                           const std::vector<T>& end) {
  const std::size_t n = start.size();
  std::vector<T> scales(n);
  for (std::size_t k = 0; k < n; ++k) scales[k] = std::max(T(abs(start[k])), T(abs(end[k])));
  if (n > most_replayed) {
    const T largest = *std::max_element(scales.begin(), scales.end());
    scales.assign(n, largest);
    return scales;
  }
  Replay<WithRounding<T>> field(motion.tape(Formula::field));
  std::vector<WithRounding<T>> z, rate(n);
  for (std::size_t k = 0; k < n; ++k) z.emplace_back(start[k], scales[k]);
  field(WithRounding<T>(t, T(abs(t))), z.data(), rate.data());
  for (std::size_t k = 0; k < n; ++k) scales[k] = scales[k] + T(abs(h)) * rate[k].error;
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
