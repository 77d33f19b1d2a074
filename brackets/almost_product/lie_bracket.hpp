// The Lie bracket of two vector fields at a point, [X, Y] = DY X - DX Y, with derivatives by dual numbers.
#pragma once

#include <span>

#include <pfaff/brackets/almost_product/vectors_and_covectors.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// A field F has template <class S> TangentVector<S> at(const std::vector<S>& z) const.
template <class T, class X, class Y>
TangentVector<T> lie_bracket(const X& x, const Y& y, const std::vector<T>& z) {
  using D = Dual<T, 1>;
  // The derivative of a field in a direction.
  const auto slope = [&z](const auto& field, const TangentVector<T>& direction) {
    std::vector<D> moved(z.begin(), z.end());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i].derivative[0] = direction[i];
    const TangentVector<D> value = field.template at<D>(moved);
    TangentVector<T> result(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) result[i] = value[i].derivative[0];
    return result;
  };
  return slope(y, x.template at<T>(z)) - slope(x, y.template at<T>(z));
}

}  // namespace pfaff
