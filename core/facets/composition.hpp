// Compositions of a symmetric method of order 2, most of them symmetric:
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
// workspace is passed on to the next. The integrator `composition` brings the weights, or a table of the kind
// "composition", whose step may be a processed one.
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
///
/// Of a processed composition (core/facets/processed.hpp) the first weights are those of the processor, as
/// many at the end those of its inverse, which undo them, and those between them the kernel's.
template <class Base>
struct Composition : Base {
  std::vector<Quad> weights{Quad(1)};
  std::size_t processor = 0;  // how many weights are those of the processor

  std::span<Quad> coefficients() { return weights; }
  [[nodiscard]] bool processed() const { return processor > 0; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    using BaseWork = pfaff::Work<Base, P>;
    static constexpr bool with_history = requires(BaseWork & w) { w.restart(); };

    std::vector<BaseWork> base;  // one for each sub-step, or one for all
    std::size_t holder = 0;      // the one that has what belongs to the state
    std::vector<T> length;       // of sub-steps, in units of h
    // When sub-steps begin, in units of h: after the beginning of a step, and after its end.
    std::vector<T> after_beginning, after_end;
    State<P> before;

    Work(const Composition& method, const P& p) : before(p.make_state()) {
      Quad sum(0), total(0);
      for (const Quad& gamma : method.weights) total += gamma;
      for (const Quad& gamma : method.weights) {
        length.push_back(T(Real(gamma)));
        after_beginning.push_back(T(Real(sum)));
        after_end.push_back(T(Real(sum - total)));
        sum += gamma;
      }
      const std::size_t count = with_history ? length.size() : 1;
      base.reserve(count);
      for (std::size_t i = 0; i < count; ++i) base.emplace_back(method, p);
    }
    void restart() {
      for (BaseWork& w : base) w.restart();
    }
    /// The workspace of a sub-step, with what belongs to the state.
    BaseWork& of(std::size_t i) {
      if constexpr (with_history) {
        if (i != holder) {
          BaseWork &from = base[holder], &to = base[i];
          if constexpr (requires { from.hand_over(to); }) {
            from.hand_over(to);
          } else {
            std::swap(from.carry, to.carry);
          }
          holder = i;
        }
        return base[i];
      } else {
        return base.front();
      }
    }
  };

  template <class P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const { return take(0, weights.size(), p, t, w.after_beginning, h, z, w); }
  template <class P>
  requires Steps<Base, P> Status preprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                            Work<P>& w)
  const { return take_once(0, processor, p, t, w.after_beginning, h, z, w); }
  template <class P>
  requires Steps<Base, P> Status kernel(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                        Work<P>& w)
  const { return take(processor, weights.size() - processor, p, t, w.after_beginning, h, z, w); }
  template <class P>
  requires Steps<Base, P> Status postprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                             Work<P>& w)
  const { return take_once(weights.size() - processor, weights.size(), p, t, w.after_end, h, z, w); }

 private:
  // The sub-steps begin, ..., end - 1, which begin at the times t + start[i] h.
  template <class P>
  Status take(std::size_t begin, std::size_t end, const P& p, const Scalar<P>& t,
              const std::vector<Scalar<P>>& start, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    std::copy(z.begin(), z.end(), w.before.begin());
    for (std::size_t i = begin; i < end; ++i) {
      const Status status = Base::step(p, t + start[i] * h, w.length[i] * h, z, w.of(i));
      if (status != Status::converged) {
        std::copy(w.before.begin(), w.before.end(), z.begin());
        if constexpr (Work<P>::with_history) w.restart();
        return status;
      }
    }
    return Status::converged;
  }
  // The same for sub-steps that a loop of steps takes once: the last ones that their workspaces remember
  // belong to another loop, and may be far away.
  template <class P>
  Status take_once(std::size_t begin, std::size_t end, const P& p, const Scalar<P>& t,
                   const std::vector<Scalar<P>>& start, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if constexpr (Work<P>::with_history)
      for (std::size_t i = begin; i < end; ++i) w.base[i].restart();
    return take(begin, end, p, t, start, h, z, w);
  }
};

}  // namespace pfaff
