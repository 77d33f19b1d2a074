// Processed methods: those whose step is a processor, a kernel and the inverse of the processor. In n steps
// in a row the inverse of one step and the processor of the next cancel,
//
//   (P K P^-1)^n = P K^n P^-1,
//
// so that a loop of steps takes the processor once at its beginning and once at its end, where the state is
// looked at, and the cost of a step is that of the kernel (blanes-casas-ros1999, wisdom-holman-touma1996).
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/allowed_steps.hpp>
#include <pfaff/core/facets/problem.hpp>

namespace pfaff::detail {

/// A method that writes the three parts of its step as members of their own, each with the arguments of a
/// step, and says whether its parameters make use of them.
template <class M, class P, class W>
concept WritesProcessor = requires(const M& m, const P& p, const Scalar<P>& t, State<P>& z, W& w) {
  { m.processed() } -> std::same_as<bool>;
  { m.preprocess(p, t, t, z, w) } -> std::same_as<Status>;
  { m.kernel(p, t, t, z, w) } -> std::same_as<Status>;
  { m.postprocess(p, t, t, z, w) } -> std::same_as<Status>;
};

/// What the method keeps, and the state from which a loop of steps begins, with what compensated sums have
/// rounded off by then: both are given back where no step, or not the processor, comes to an end.
template <class W, class P>
struct WithBeginning : W {
  static constexpr bool carries = requires { requires std::same_as<decltype(W::carry), State<P>>; };
  State<P> beginning, beginning_carry;
  template <class M>
  WithBeginning(const M& method, const P& p)
      : W(method, p), beginning(p.make_state()), beginning_carry(p.make_state()) {}

  void begin(const State<P>& z) {
    std::copy(z.begin(), z.end(), beginning.begin());
    if constexpr (carries) std::copy(this->carry.begin(), this->carry.end(), beginning_carry.begin());
  }
  void give_back(State<P>& z) {
    std::copy(beginning.begin(), beginning.end(), z.begin());
    if constexpr (carries) std::copy(beginning_carry.begin(), beginning_carry.end(), this->carry.begin());
  }
};

/// The steps first, ..., first + count - 1 of size h from time t0. Where a kernel does not converge, z is the
/// state after the steps before it. Where the processor does not, z is as it was and `completed` is 0. Fewer
/// than `count` are completed with the status converged where `steps` allows no more.
template <class M, class P, class W>
Status advance_kernel(const M& method, const P& problem, const Scalar<P>& t0, std::int64_t first,
                      const Scalar<P>& h, std::int64_t count, AllowedSteps<P>& steps, State<P>& z, W& work,
                      std::int64_t& completed) {
  const auto time = [&](std::int64_t taken) {
    return t0 + Scalar<P>(static_cast<double>(first + taken)) * h;
  };
  completed = 0;
  if (count <= 0) return Status::converged;
  work.begin(z);
  Status status = method.preprocess(problem, time(0), h, z, work);
  std::int64_t taken = 0;
  if (status == Status::converged)
    status = steps.repeat(count, taken,
                          [&](std::int64_t k) { return method.kernel(problem, time(k), h, z, work); });
  Status ended = status;
  if (taken > 0) ended = method.postprocess(problem, time(taken), h, z, work);
  if (taken == 0 || ended != Status::converged) {
    work.give_back(z);
    return ended;
  }
  completed = taken;
  return status;
}

/// `rows` loops of `stride` steps each, after which put() looks at the state.
template <class M, class P, class W, class Put>
Status advance_kernels(const M& method, const P& problem, const Scalar<P>& t0, std::int64_t first,
                       const Scalar<P>& h, std::int64_t rows, std::int64_t stride, Put&& put,
                       AllowedSteps<P>& steps, State<P>& z, W& work, std::int64_t& completed) {
  completed = 0;
  for (std::int64_t row = 0; row < rows; ++row) {
    std::int64_t taken = 0;
    const Status status =
        advance_kernel(method, problem, t0, first + completed, h, stride, steps, z, work, taken);
    completed += taken;
    if (status != Status::converged || taken < stride) return status;
    put();
  }
  return Status::converged;
}

}  // namespace pfaff::detail
