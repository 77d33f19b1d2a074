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

template <class T>
std::optional<WayBack<T>> way_back(const Integration<T>& start, bool remembers) {
  const Model& model = *start.model();
  const std::vector<Claim> claims = claims_in_scope(start.method().preserves(model), model);
  const auto holds = [&](Claim claim) {
    return !remembers || std::find(claims.begin(), claims.end(), claim) != claims.end();
  };
  const bool stated = model.given(Formula::reversal) && model.autonomous();
  if (stated && holds(Claim::reversible)) return WayBack<T>(start.model());
  if (holds(Claim::symmetric)) return WayBack<T>();
  return std::nullopt;
}

template class WayBack<double>;
template class WayBack<Quad>;
template std::optional<WayBack<double>> way_back(const Integration<double>&, bool);
template std::optional<WayBack<Quad>> way_back(const Integration<Quad>&, bool);

}  // namespace pfaff
