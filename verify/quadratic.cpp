// Whether an invariant that is called quadratic is a polynomial of degree two in the state.
#include <map>
#include <memory>
#include <mutex>

#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::shared_ptr<const Tape> third_difference(const Tape& values, std::size_t k,
                                             const std::vector<double>& scales) {
  return expression(values.inputs, 1, [&](const Recorded& t, Arguments z, Results out) {
    const auto at = [&](int steps) {
      std::vector<Recorded> moved(z.begin(), z.end());
      for (std::size_t i = 0; i < moved.size(); ++i)
        moved[i] = moved[i] +
                   Recorded(Real::fraction(std::int64_t{steps} * static_cast<std::int64_t>(5 + i % 7), 64) *
                            Real(Quad(scales[i])));
      return evaluate(values, t, moved)[k];
    };
    out[0] = at(3) - 3 * at(2) + 3 * at(1) - at(0);
  });
}

bool is_quadratic(const std::shared_ptr<const Model>& model, std::size_t invariant) {
  // Claims ask it at every step of a run. A weak pointer tells a model from a later one in its place.
  static std::mutex mutex;
  static std::map<std::weak_ptr<const Model>, std::map<std::size_t, bool>, std::owner_less<>> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const auto& of_one) { return of_one.first.expired(); });
  auto& of_model = known[model];
  const auto found = of_model.find(invariant);
  if (found != of_model.end()) return found->second;
  const auto difference =
      third_difference(*model->tape(Formula::invariants), invariant, coordinate_scales(model->initial()));
  return of_model[invariant] = largest<Quad>(difference, model->initial()) <= residual_tolerance<Quad>();
}

}  // namespace pfaff
