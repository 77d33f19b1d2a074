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

/// What the method keeps, and the state from which a loop of steps begins: it is given back where the state
/// after the last kernel cannot be brought to an end.
template <class W, class P>
struct WithBeginning : W {
  State<P> beginning;
  template <class M>
  WithBeginning(const M& method, const P& p) : W(method, p), beginning(p.make_state()) {}
};

/// The steps first, ..., first + count - 1 of size h from time t0. Where a kernel does not converge, z is the
/// state after the steps before it. Where the processor does not, z is as it was and `completed` is 0.
template <class M, class P, class W>
Status advance_kernel(const M& method, const P& problem, const Scalar<P>& t0, std::int64_t first,
                      const Scalar<P>& h, std::int64_t count, State<P>& z, W& work, std::int64_t& completed) {
  const auto time = [&](std::int64_t taken) {
    return t0 + Scalar<P>(static_cast<double>(first + taken)) * h;
  };
  completed = 0;
  if (count <= 0) return Status::converged;
  std::copy(z.begin(), z.end(), work.beginning.begin());
  Status status = method.preprocess(problem, time(0), h, z, work);
  if (status != Status::converged) return status;
  std::int64_t taken = 0;
  for (; taken < count; ++taken) {
    status = method.kernel(problem, time(taken), h, z, work);
    if (status != Status::converged) break;
  }
  const Status ended = method.postprocess(problem, time(taken), h, z, work);
  if (ended != Status::converged) {
    std::copy(work.beginning.begin(), work.beginning.end(), z.begin());
    return ended;
  }
  completed = taken;
  return status;
}

}  // namespace pfaff::detail
