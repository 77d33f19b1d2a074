// Symmetric compositions of a symmetric method of order 2:
//
//   step(h) = S(gamma_s h) ... S(gamma_2 h) S(gamma_1 h),   gamma_i = gamma_{s+1-i}
//
// (hairer-lubich-wanner2006 II.4, V.3). A composition keeps whatever its base keeps for steps of either sign:
// over Stoermer-Verlet it is symplectic and explicit, over the midpoint rule in Darboux coordinates
// K(z,t)-symplectic. A method's struct says how it is composed by its member `Composed`, for most of them
//
//   using Composed = Composition<Verlet>;
//
// so that sub-steps are compiled with the method: none is a virtual call, and what a sub-step keeps in its
// workspace is passed on to the next. The integrator `composition` brings the weights.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

/// Takes steps of Base with the lengths weights[i] h. Bases that extrapolate from past steps, whose
/// workspaces can restart(), have one workspace for each sub-step, because each sub-step has a history of its
/// own. What belongs to the state then has to be passed on from sub-step to sub-step: by the workspace's
/// hand_over(next) where it has one, else by swapping its `carry`, what the base has rounded off.
template <class Base>
struct Composition : Base {
  std::vector<Quad> weights{Quad(1)};

  std::span<Quad> coefficients() { return weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    using BaseWork = pfaff::Work<Base, P>;
    static constexpr bool with_history = requires(BaseWork & w) { w.restart(); };

    std::vector<BaseWork> base;    // one for each sub-step, or one for all
    std::vector<T> length, start;  // of sub-steps, in units of h
    State<P> before;

    Work(const Composition& method, const P& p) : before(p.make_state()) {
      Quad sum(0);
      for (const Quad& gamma : method.weights) {
        length.push_back(T(Real(gamma)));
        start.push_back(T(Real(sum)));
        sum += gamma;
      }
      const std::size_t count = with_history ? length.size() : 1;
      base.reserve(count);
      for (std::size_t i = 0; i < count; ++i) base.emplace_back(method, p);
    }
    void restart() {
      for (BaseWork& w : base) w.restart();
    }
  };

  template <class P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    std::copy(z.begin(), z.end(), w.before.begin());
    for (std::size_t i = 0; i < w.length.size(); ++i) {
      auto& base = w.base[i % w.base.size()];
      const Status status = Base::step(p, t + w.start[i] * h, w.length[i] * h, z, base);
      if (status != Status::converged) {
        std::copy(w.before.begin(), w.before.end(), z.begin());
        if constexpr (Work<P>::with_history) w.restart();
        return status;
      }
      if constexpr (Work<P>::with_history) {
        auto& next = w.base[(i + 1) % w.base.size()];
        if constexpr (requires { base.hand_over(next); }) {
          base.hand_over(next);
        } else {
          std::swap(base.carry, next.carry);
        }
      }
    }
    return Status::converged;
  }
};

}  // namespace pfaff
