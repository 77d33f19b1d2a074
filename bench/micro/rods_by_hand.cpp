// The loops that someone would write for a hanging chain of rods and nothing else: the right-hand sides of
// the full Dirac form (nguyen-turski (4.2)) and of Lagrange multipliers (nguyen-turski (A.5)), and a step of
// RATTLE. Gravity acts, there is no friction. Nanoseconds per rod.
//
// S is tridiagonal. Its elimination runs from both ends at once, the left half of the chain in one lane of a
// pack and the right half, mirrored, in the other: what waits for a division does so for both. An ensemble
// holds one chain in each lane and eliminates from the anchor.
#include "rods.hpp"

namespace {
using namespace pfaff::micro;

template <int D>
void add_loops() {
  for (const int count : chain_sizes) {
    const Rig<D> rig(count);
    add_rods("chain", D, count, "dirac", "by-hand", rig, HalvedChain<D>(rig), [](auto& chain, auto& s) {
      chain.dirac(s.q.data(), s.p.data(), s.rate_q.data(), s.rate_p.data());
    });
    add_rods("chain", D, count, "lmm", "by-hand", rig, HalvedChain<D>(rig), [](auto& chain, auto& s) {
      chain.multipliers(s.q.data(), s.p.data(), s.rate_q.data(), s.rate_p.data());
    });
  }
}

[[maybe_unused]] const bool added = (add_loops<2>(), add_loops<3>(), true);
}  // namespace
