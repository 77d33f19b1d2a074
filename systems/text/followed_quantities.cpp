#include <pfaff/systems/text/followed_quantities.hpp>

#include <algorithm>
#include <array>
#include <span>

#include <pfaff/core/facets/followed_invariants.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::text {

namespace {
using Tapes = std::shared_ptr<const Tape>;

bool reads_time(const Tapes& tape) { return tape != nullptr && !tape->autonomous(); }

// A function of the whole state; null where the model gives none without the time in it.
Tapes energy_of(const ModelSource& source) {
  const auto given = [&](Formula f) { return source.given[index(f)]; };
  const Tapes kinetic = given(Formula::kinetic), potential = given(Formula::potential);
  Tapes whole = given(Formula::hamiltonian);
  if (reads_time(whole) || reads_time(kinetic) || reads_time(potential)) return nullptr;
  if (whole != nullptr) return whole;
  if (kinetic == nullptr) return nullptr;
  const auto half = static_cast<std::size_t>(source.dimension) / 2;
  return std::make_shared<const Tape>(
      record(source.dimension, 1, [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
        const std::vector<Recorded> q(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(half)),
            p(z.begin() + static_cast<std::ptrdiff_t>(half), z.end());
        out[0] = evaluate(*kinetic, t, p)[0] + evaluate(*potential, t, q)[0];
      }));
}

// False where something may take from the energy, or give to it.
bool is_conserved(const ModelSource& source) {
  const auto given = [&](Formula f) { return source.given[index(f)]; };
  const auto acts = [&](Formula f) { return given(f) != nullptr && !given(f)->zero(); };
  return (!source.damping || *source.damping == Real(0)) && !acts(Formula::friction) &&
         !acts(Formula::applied_force) &&
         (!acts(Formula::symmetric_tensor) || given(Formula::entropy) != nullptr) &&
         !acts(Formula::velocity_offsets) && !reads_time(given(Formula::holonomic)) &&
         !reads_time(given(Formula::constraints)) && !reads_time(given(Formula::velocity_constraints)) &&
         !reads_time(given(Formula::poisson_tensor));
}

// The slopes of the results of a tape at the initial state, or at any other where there is none, and at a
// state beside it: one behind the other. Each derivative is multiplied by its coordinate, so that the slopes
// do not depend on the units of coordinates, of which momenta may be 1e20 times as large as velocities.
using Slopes = std::array<std::vector<Quad>, 2>;
Slopes slopes_of(const Tape& tape, const ModelSource& source) {
  Slopes slopes;
  Replay<Quad> replay(std::make_shared<const Tape>(jacobian_tape(tape)));
  for (std::size_t place = 0; place < slopes.size(); ++place) {
    std::vector<Quad> z;
    for (int k = 0; k < source.dimension; ++k) {
      const Quad x = source.initial.empty() ? Quad(2 * k + 3) / Quad(7)
                                            : source.initial[static_cast<std::size_t>(k)].quad();
      const Quad size = x == Quad(0) ? Quad(1) : Quad(abs(x));
      z.push_back(x + Quad(static_cast<int>(place)) * size / Quad(20 + k));
    }
    slopes[place].resize(tape.outputs.size() * z.size());
    replay(Quad(0), z.data(), slopes[place].data());
    for (std::size_t k = 0; k < slopes[place].size(); ++k) slopes[place][k] *= z[k % z.size()];
  }
  return slopes;
}

// Whether each part of one is the same multiple of that of the other, but for the rounding of both.
bool parallel(std::span<const Quad> a, std::span<const Quad> b) {
  constexpr double rounding = 1e-25;
  const auto larger = [](const Quad& x, const Quad& y) { return abs(x) < abs(y); };
  const auto largest = static_cast<std::size_t>(std::max_element(a.begin(), a.end(), larger) - a.begin());
  const Quad of_a = a[largest], of_b = b[largest],
             whole = abs(of_a * *std::max_element(b.begin(), b.end(), larger));
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Quad one = a[k] * of_b, other = of_a * b[k];
    if (abs(one - other) > Quad(rounding) * (abs(one) + abs(other)) + Quad(1e-30) * whole) return false;
  }
  return true;
}

// Adds quantities that the author has not stated.
class Followed {
 public:
  explicit Followed(ModelSource& source) : source_(source) {
    if (const Tapes& stated = source.given[index(Formula::invariants)]; stated != nullptr)
      stated_ = slopes_of(*stated, source);
  }
  void add(const Tapes& tape, std::size_t output, Invariant invariant) {
    const auto same_name = [&](const Invariant& one) { return one.name == invariant.name; };
    if (std::any_of(source_.invariants.begin(), source_.invariants.end(), same_name) ||
        is_stated(*tape, output))
      return;
    added_.push_back({std::move(invariant), tape, output});
  }
  void finish() { follow(source_, added_); }

 private:
  // True where a conserved quantity that the author states is a function of this one.
  [[nodiscard]] bool is_stated(const Tape& tape, std::size_t output) const {
    if (stated_.front().empty()) return false;
    const auto n = static_cast<std::size_t>(source_.dimension);
    const Slopes own = slopes_of(tape, source_);
    for (std::size_t k = 0; k * n < stated_.front().size(); ++k) {
      bool same = source_.invariants[k].behaviour == Behaviour::conserved;
      for (std::size_t place = 0; place < own.size(); ++place)
        same = same && parallel(std::span(own[place]).subspan(output * n, n),
                                std::span(stated_[place]).subspan(k * n, n));
      if (same) return true;
    }
    return false;
  }

  ModelSource& source_;
  Slopes stated_;  // of the author's invariants
  std::vector<FollowedQuantity> added_;
};
}  // namespace

void leave_out_zero_offsets(ModelSource& source) {
  Tapes& offsets = source.given[index(Formula::velocity_offsets)];
  if (offsets != nullptr && offsets->zero()) offsets = nullptr;
}

void add_followed_quantities(ModelSource& source) {
  Followed followed(source);
  if (const Tapes energy = energy_of(source); energy != nullptr)
    followed.add(energy, 0,
                 {"energy", "", is_conserved(source) ? Behaviour::conserved : Behaviour::free, false});
  if (const Tapes& casimirs = source.given[index(Formula::casimirs)];
      casimirs != nullptr && source.given[index(Formula::symmetric_tensor)] == nullptr &&
      !reads_time(casimirs))
    for (std::size_t k = 0; k < casimirs->outputs.size(); ++k)
      followed.add(casimirs, k, conserved("casimir" + std::to_string(k + 1), ""));
  const Tapes birkhoffian = source.given[index(Formula::birkhoffian)];
  if (birkhoffian != nullptr && !reads_time(birkhoffian) &&
      !reads_time(source.given[index(Formula::one_form)]))
    followed.add(birkhoffian, 0,
                 {"birkhoffian", "", is_conserved(source) ? Behaviour::conserved : Behaviour::free, false});
  followed.finish();
}

}  // namespace pfaff::text
