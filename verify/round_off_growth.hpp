// How rounding moves conserved quantities over many steps: an ensemble of runs of one method in double, from
// starts drawn with a fixed seed.
//
// The error e of a quantity I is the change of I(z_n), evaluated in quad at the states in double, since the
// first steps of a run; what a method rounds off once, when it starts, is no growth. Where roundings are
// independent and have no bias, e does a random walk: its mean over the ensemble is zero within its own
// uncertainty, and its rms grows as n^(1/2). A bias that is the same in all runs shows in the mean. One whose
// sign depends on the start shows in the exponent, which a trend in each run raises to 1. States are rounded
// to double when they are looked at, whatever the method carries on; that noise does not grow, and is
// averaged over some steps in a row. What is left of it, and of other parts of e that are bounded, is taken
// off before the exponent is fitted.
//
// The size of the walk is compared with that of a method which rounds no more than what a step adds to the
// state, every component once, with an error between -u and u of which all sizes are as likely: after n
// steps, u (n/3 mean_steps (sum_k |dI/dz_k| a_k)^2)^(1/2), where a_k^2 = (z'_k - z_k)^2 + (h e_k)^2 and u e_k
// is the bound of what the field rounds at a rounded state; where positions have become large beside what
// they change by in a step, that is what is left. A method that rounds the whole state in each step walks
// further than that, by |z| over |z' - z|.
//
// Truncation must not be seen. The step is the longest one at which the energy's change over some steps in
// quad stays far below the walk. Where the method claims nothing that rules a trend of the energy out, and of
// other quantities, it has to stay there when it grows in proportion to time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>

namespace pfaff {

/// The ensemble. Each run takes `steps` steps after its first ones, a multiple of round_off_blocks.
struct RoundOffEnsemble {
  std::uint64_t seed = 1;
  int starts = 24;
  std::int64_t steps = 16384;
  double spread = 0.05;  // of the starts, in each coordinate and in units of its scale
};

/// Runs are looked at after so many parts of equal length.
inline constexpr int round_off_blocks = 128;

/// How one conserved quantity fares.
struct RoundOffGrowth {
  std::string quantity;
  double rms = 0;           // of e at the end of the runs, in the quantity's unit
  double significance = 0;  // t: the mean of e at the end, in units of its own standard deviation
  double exponent = 0;      // of the growth of the rms change with the number of steps
  double size = 0;          // the rms at the end, in units of the walk of what steps add
  double at_rest = 0;       // what one rounding of the whole state amounts to
};

/// The longest of the steps 2/5, 1/5, ... 1/80 of `time` at which truncation is out of the energy's sight in
/// runs of so many steps from z, and the conserved quantities of which the same is true there: the energy,
/// numbered 0, and the invariants k that are conserved, numbered k + 1. nullopt where there is none, or where
/// a step does not converge. No step is a power of two, since products with such steps are never rounded.
struct RoundOffStep {
  Real h;
  std::vector<std::size_t> quantities;
};
std::optional<RoundOffStep> round_off_step(const MethodInstance& method,
                                           const std::shared_ptr<const Model>& model,
                                           const std::vector<Real>& z, const Real& t, const Real& time,
                                           std::int64_t steps);

/// The growth of these quantities, with steps from time t and states near `centre`. The model must have an
/// energy and no constraints. nullopt where a step does not converge. A quantity that no run changes at all
/// has zeros.
std::optional<std::vector<RoundOffGrowth>> round_off_growth(const MethodInstance& method,
                                                            const std::shared_ptr<const Model>& model,
                                                            const std::vector<Real>& centre, const Real& t,
                                                            const RoundOffStep& step,
                                                            const RoundOffEnsemble& ensemble);

/// By how much the growth exceeds a random walk of roundings of what steps add, the largest over the
/// quantities: within 1 are |t| < 3, an exponent of at most 0.6, and a size below one. A quantity that has
/// moved by no more than one rounding of the state has not grown.
double excess_over_random_walk(const std::vector<RoundOffGrowth>& growth);

}  // namespace pfaff
