// What tests of verification have in common: the claims that a verification finds fault with, and a method of
// order 4 to find none with.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff::testing {

using Names = std::vector<std::string>;

/// The claims that are not as they should be, each once, in the order of the alphabet.
inline Names bad(const std::vector<Check>& checks) {
  Names names;
  for (const Check& check : checks)
    if (!check.control && !good(check) && std::find(names.begin(), names.end(), check.claim) == names.end())
      names.push_back(check.claim);
  std::sort(names.begin(), names.end());
  return names;
}

/// The classical Runge-Kutta method, with coefficients in the scalar of the step or in double, as those of
/// libraries are.
template <bool doubles>
struct Classical {
  template <class P>
  struct Work {
    State<P> slope, stage, sum;
    Work(const Classical& /*method*/, const P& p)
        : slope(p.make_state()), stage(p.make_state()), sum(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const T outer = doubles ? T(1.0 / 6) : T(1) / T(6), inner = doubles ? T(1.0 / 3) : T(1) / T(3);
    p.field(t, z, w.slope);
    for (std::size_t i = 0; i < z.size(); ++i) w.sum[i] = outer * w.slope[i];
    for (int k = 1; k < 4; ++k) {
      const T part = k == 3 ? h : h / T(2);
      for (std::size_t i = 0; i < z.size(); ++i) w.stage[i] = z[i] + part * w.slope[i];
      p.field(t + part, w.stage, w.slope);
      for (std::size_t i = 0; i < z.size(); ++i) w.sum[i] = w.sum[i] + (k == 3 ? outer : inner) * w.slope[i];
    }
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = z[i] + h * w.sum[i];
    return Status::converged;
  }
};

}  // namespace pfaff::testing
