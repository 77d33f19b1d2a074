// Closed loops of states, which a measure lays about the start of a run, and integrals around them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

namespace detail {
inline const Real pi = 3.141592653589793238462643383279502884_r;
}

/// The states centre + a cos s + b sin s for `points` values of s, evenly spaced around the ellipse.
template <class T>
std::vector<std::vector<T>> ellipse(std::span<const T> centre, const std::vector<T>& a,
                                    const std::vector<T>& b, int points) {
  std::vector<std::vector<T>> states;
  for (int k = 0; k < points; ++k) {
    const T angle = T(2) * T(detail::pi) * T(k) / T(points), along = cos(angle), across = sin(angle);
    std::vector<T>& state = states.emplace_back(centre.begin(), centre.end());
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += a[i] * along + b[i] * across;
  }
  return states;
}

/// The one-form F of a model, which is (p, 0) of canonical systems.
template <class T>
class OneForm {
 public:
  explicit OneForm(const std::shared_ptr<const Model>& model) {
    if (!model->source().canonical) stated_ = make_evaluator<T>(model, Formula::one_form);
  }
  [[nodiscard]] std::vector<T> at(const T& t, std::span<const T> z) const {
    std::vector<T> form(z.size(), T(0));
    if (stated_) {
      stated_->call(stated_->context, t, z.data(), form.data());
    } else {
      std::copy(z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end(), form.begin());
    }
    return form;
  }

 private:
  std::optional<Evaluator<T>> stated_;
};

/// The integral of one-forms, `forms` at `points`, around a loop of every `stride`-th of the points, whose
/// number that divides: the mean of F . dz/ds over s, with the derivative of the trigonometric polynomial
/// through these points.
template <class T>
T loop_integral(const std::vector<std::vector<T>>& points, const std::vector<std::vector<T>>& forms,
                std::size_t stride) {
  const std::size_t count = points.size() / stride;
  // What is constant along the loop gives nothing but rounding errors.
  std::vector<T> mean(forms.front().size(), T(0));
  for (const std::vector<T>& form : forms)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += form[i] / T(static_cast<double>(forms.size()));
  T total(0);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t k = 0; k < count; ++k) {
      if (j == k) continue;
      const T angle = T(detail::pi) * (T(static_cast<double>(j)) - T(static_cast<double>(k))) /
                      T(static_cast<double>(count));
      // Of an even number of points the highest cosine has no derivative at them.
      const T weight = T((j + k) % 2 == 0 ? 0.5 : -0.5) * (count % 2 == 0 ? cos(angle) : T(1)) / sin(angle);
      T along(0);
      for (std::size_t i = 0; i < mean.size(); ++i)
        along += (forms[j * stride][i] - mean[i]) * (points[k * stride][i] - points.front()[i]);
      total += weight * along;
    }
  return T(2) * T(detail::pi) * total / T(static_cast<double>(count));
}

}  // namespace pfaff
