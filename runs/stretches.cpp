#include <pfaff/runs/stretches.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace pfaff {

template <class T>
std::int64_t steps_of_a_turn(const Measured<T>& run, const Plane& plane, const ReferenceSolution* solution,
                             std::int64_t longest) {
  constexpr std::int64_t fewest = 12;
  const auto [first, second] = plane;
  const std::span<const T> z = run.start.state();
  const Quad t0 = Quad(run.start.time()), h = Quad(run.start.step());
  std::optional<Integration<T>> along;
  if (solution == nullptr) along.emplace(run.start.beside({z.begin(), z.end()}));
  std::array<double, 2> last{double(z[first]), double(z[second])}, before{};
  double turned = 0;  // the sum of the angles between steps
  for (std::int64_t step = 1; step <= longest; ++step) {
    std::array<double, 2> here{};
    if (along) {
      if (!along->steps(step - along->steps_taken()).reached()) return step;
      here = {double(along->state()[first]), double(along->state()[second])};
    } else {
      const Quad t = t0 + Quad(static_cast<double>(step)) * h;
      if (!solution->covers(t)) return longest;
      const std::vector<Quad> solved = solution->at(t);
      here = {double(solved[first]), double(solved[second])};
    }
    const double u = here[0] - last[0], v = here[1] - last[1];
    if (step > 1)
      turned += std::abs(std::atan2(before[0] * v - before[1] * u, before[0] * u + before[1] * v));
    before = {u, v}, last = here;
    if (step >= fewest && turned >= 2 * std::numbers::pi) return step;
  }
  return longest;
}
template std::int64_t steps_of_a_turn(const Measured<double>&, const Plane&, const ReferenceSolution*,
                                      std::int64_t);
template std::int64_t steps_of_a_turn(const Measured<Quad>&, const Plane&, const ReferenceSolution*,
                                      std::int64_t);

std::vector<std::int64_t> stretches(std::int64_t steps, std::int64_t length, int most, std::int64_t alone) {
  const std::int64_t count = std::clamp<std::int64_t>(steps / (2 * length), 1, most);
  if (count == 1) length = std::min(steps, alone);
  std::vector<std::int64_t> found;
  for (std::int64_t k = 0; k < count; ++k) {
    const std::int64_t begin = count == 1 ? 0 : (steps - length) * k / (count - 1);
    for (std::int64_t step = begin; step <= begin + length; ++step) found.push_back(step);
  }
  return found;
}

}  // namespace pfaff
