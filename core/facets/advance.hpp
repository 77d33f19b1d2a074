// advance: the loop around a method's step. Step k starts at t0 + k h, computed from the integer k, so that
// no round-off adds up in the time.
#pragma once

#include <cstdint>
#include <type_traits>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/allowed_steps.hpp>
#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/processed.hpp>

namespace pfaff {

/// The workspace of methods that need none.
struct NoWork {
  template <class M, class P>
  NoWork(const M& /*method*/, const P& /*problem*/) {}
};

namespace detail {
template <class M, class P>
struct WorkOf {
  using type = NoWork;
};
template <class M, class P>
requires requires { typename M::template Work<P>; }
struct WorkOf<M, P> {
  using W = typename M::template Work<P>;
  using type = std::conditional_t<WritesProcessor<M, P, W>, WithBeginning<W, P>, W>;
};
}  // namespace detail

/// What a method keeps between steps of one integration: buffers, compensation, history.
template <class M, class P>
using Work = typename detail::WorkOf<M, P>::type;

/// A method that can step on problems of type P.
template <class M, class P>
concept Steps = requires(const M& m, const P& p, const Scalar<P>& t, State<P>& z) {
  typename Work<M, P>;
}
&&requires(const M& m, const P& p, const Scalar<P>& t, State<P>& z, Work<M, P>& w) {
  { m.step(p, t, t, z, w) } -> std::same_as<Status>;
};

namespace detail {
/// Returns loop(method). Where the method has a member `compensated`, the loop is compiled twice, with true
/// and with false as a constant, so that no step has to test it; for which the loop has to be inlined.
template <class M, class Loop>
Status unswitched(const M& method, Loop&& loop) {
  if constexpr (std::is_trivially_copyable_v<M> && requires { method.compensated; }) {
    M local = method;
    if (method.compensated) {
      local.compensated = true;
      return loop(local);
    }
    local.compensated = false;
    return loop(local);
  } else {
    return loop(method);
  }
}

/// `rows` times `stride` steps as advance() takes them, as many as the budget of this thread allows: fewer
/// with the status converged where it has ended them. Where there is a block, the state after each `stride`
/// steps is put to its next row. A step that does not converge is tried once more: a method forgets the
/// past when its step fails, and what it extrapolated from it may lead away from a solution that is found
/// from the state alone. Where a step throws, `completed` is 0, and of the state nothing is known.
template <class M, class P>
requires Steps<M, P> Status advance_as_allowed(const M& method, const P& problem, const Scalar<P>& t0,
                                               std::int64_t first, const Scalar<P>& h, std::int64_t rows,
                                               std::int64_t stride, Block<Scalar<P>>* block, State<P>& z,
                                               Work<M, P>& work, std::int64_t& completed) {
  using W = Work<M, P>;
  completed = 0;
  AllowedSteps<P> steps(problem);
  const auto loop = [&](State<P>& state, W& w) {
    const auto put = [&] {
      if (block != nullptr) block->states.put(block->rows++, state.data());
    };
    return unswitched(
        method, [&](const M& m) __attribute__((always_inline)) {
          if constexpr (WritesProcessor<M, P, W>)
            if (m.processed())
              return advance_kernels(m, problem, t0, first, h, rows, stride, put, steps, state, w, completed);
          return steps.repeat(
              rows * stride, stride, completed,
              [&](std::int64_t taken) {
                const Scalar<P> t = t0 + Scalar<P>(static_cast<double>(first + taken)) * h;
                const Status status = m.step(problem, t, h, state, w);
                return status == Status::not_converged ? m.step(problem, t, h, state, w) : status;
              },
              put);
        });
  };
  if constexpr (std::is_trivially_copyable_v<State<P>> && std::is_trivially_copyable_v<W>) {
    // Local copies stay in registers through the loop.
    State<P> state = z;
    W local = work;
    const Status status = loop(state, local);
    z = state;
    work = local;
    return status;
  } else {
    return loop(z, work);
  }
}
}  // namespace detail

/// Takes steps first, first + 1, … first + count - 1 of size h from time t0, in place. Stops at the first
/// step that does not converge, also when it is tried once more, leaving z as it was before that step;
/// `completed` says how many were taken.
/// Where the budget of this thread ends the loop, z and `completed` are what was reached, and BudgetSpent is
/// thrown. Processed methods take their processor at the beginning and at the end alone
/// (core/facets/processed.hpp).
template <class M, class P>
requires Steps<M, P> Status advance(const M& method, const P& problem, const Scalar<P>& t0,
                                    std::int64_t first, const Scalar<P>& h, std::int64_t count, State<P>& z,
                                    Work<M, P>& work, std::int64_t& completed) {
  const Status status = detail::advance_as_allowed(
      method, problem, t0, first, h, 1, count, static_cast<Block<Scalar<P>>*>(nullptr), z, work, completed);
  if (status == Status::converged && completed < count) spend(1, 0);
  return status;
}

}  // namespace pfaff
