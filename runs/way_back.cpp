#include <pfaff/runs/way_back.hpp>

#include <algorithm>

namespace pfaff {

template <class T>
WayBack<T>::WayBack(const std::shared_ptr<const Model>& reversing) {
  if (reversing != nullptr) reversal_ = make_evaluator<T>(reversing, Formula::reversal);
}

template <class T>
std::vector<T> WayBack<T>::image(std::span<const T> z) const {
  std::vector<T> image(z.begin(), z.end());
  if (reversal_) reversal_->call(reversal_->context, T(0), z.data(), image.data());
  return image;
}

template <class T>
std::optional<std::vector<T>> WayBack<T>::operator()(Integration<T>& run, std::int64_t steps) const {
  std::vector<T> turn = image(run.state());
  if (!std::all_of(turn.begin(), turn.end(), [](const T& x) { return isfinite(x); })) return std::nullopt;
  run.go_on_from(std::move(turn), run.time(), by_reversal() ? run.step() : T(-run.step()));
  if (!run.steps(steps).reached()) return std::nullopt;
  return image(run.state());
}

template class WayBack<double>;
template class WayBack<Quad>;

}  // namespace pfaff
