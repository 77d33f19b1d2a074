// The bracket of two functions as a function: it has a gradient again, so that brackets nest.
#pragma once

#include <vector>

#include <pfaff/brackets/conformance/residuals.hpp>

namespace pfaff {

/// The gradient at z of a function f that can be evaluated with any scalar, f.operator()<T>(z), by dual
/// numbers.
template <class T, class F>
std::vector<T> gradient_by_duals(const F& f, In<T> z) {
  using D = Dual<T, 1>;
  std::vector<D> x(z.begin(), z.end());
  std::vector<T> slope(z.size());
  for (std::size_t k = 0; k < z.size(); ++k) {
    x[k].derivative[0] = T(1);
    slope[k] = f.template operator()<D>(x).derivative[0];
    x[k].derivative[0] = T(0);
  }
  return slope;
}

/// z -> {f, g}(z) of a bracket at time 0. F and G have operator()<T>(z) and gradient<T>(z), as Polynomial and
/// this class do. References are kept.
template <class B, class F, class G>
class BracketFunction {
 public:
  BracketFunction(const B& bracket, const F& f, const G& g) : bracket_(bracket), f_(f), g_(g) {}

  template <class T>
  T operator()(In<T> z) const {
    const auto df = f_.template gradient<T>(z);
    const auto image = sharp_at<T>(bracket_, T(0), z, g_.template gradient<T>(z));
    T sum(0);
    for (std::size_t i = 0; i < df.size(); ++i) sum = sum + df[i] * image[i];
    return sum;
  }
  template <class T>
  std::vector<T> gradient(In<T> z) const {
    return gradient_by_duals<T>(*this, z);
  }

 private:
  const B& bracket_;
  const F& f_;
  const G& g_;
};

}  // namespace pfaff
