// The loops that someone would write for a hanging chain of rods and nothing else: right-hand sides of the
// full Dirac form (nguyen-turski (4.2)) and of Lagrange multipliers (nguyen-turski (A.5)). Gravity acts and
// there is no friction. Times are in nanoseconds per rod.
//
// S is tridiagonal. For a single chain its elimination runs from both ends at once, with the left half of the
// chain in one lane of a pack and the right half, mirrored, in the other, so that each division serves both
// halves. An ensemble holds one chain in each lane and eliminates from the anchor.
#include "chain_ensemble.hpp"
#include "halved_chain.hpp"

namespace {
using namespace pfaff::micro;

template <int D>
void add_chain(int count) {
  const Rig<D> rig(count);
  const std::string shape = "chain-" + std::to_string(D) + "d-" + std::to_string(count);
  add_rods(shape, "dirac", "by-hand", count, [chain = HalvedChain<D>(rig), s = RodState<D>(rig)]() mutable {
    benchmark::DoNotOptimize(s.q.data());
    chain.dirac(s.q.data(), s.p.data(), s.rate_q.data(), s.rate_p.data());
    benchmark::ClobberMemory();
  });
  add_rods(shape, "lmm", "by-hand", count, [chain = HalvedChain<D>(rig), s = RodState<D>(rig)]() mutable {
    benchmark::DoNotOptimize(s.q.data());
    chain.multipliers(s.q.data(), s.p.data(), s.rate_q.data(), s.rate_p.data());
    benchmark::ClobberMemory();
  });
}

template <int D, int Lanes>
void add_ensemble(int count) {
  const std::string shape =
      std::to_string(Lanes) + "-chains-" + std::to_string(D) + "d-" + std::to_string(count);
  add_rods(shape, "dirac", "by-hand", Lanes * count,
           [ensemble = Ensemble<D, Lanes>(Rig<D>(count))]() mutable {
             benchmark::DoNotOptimize(ensemble.state());
             ensemble.dirac();
             benchmark::ClobberMemory();
           });
}

template <int D>
void add_chains() {
  for (const int count : chain_sizes) {
    add_chain<D>(count);
    add_ensemble<D, 2>(count);
    add_ensemble<D, 4>(count);
    add_ensemble<D, 8>(count);
  }
}

[[maybe_unused]] const bool added = (add_chains<2>(), add_chains<3>(), true);
}  // namespace
