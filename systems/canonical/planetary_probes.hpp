// The splitting into Kepler orbits and an interaction (planetary_splitting.hpp) of a probe without mass,
// which n bodies attract and which attracts none of them.
//
// With q and u the place and the velocity of the probe, R, P and M the centre, the momentum and the mass of
// all bodies, r = q - R and v = u - P/M,
//
//   A:  r' = v,  v' = -G M r/|r|^3,   B:  u' = G M r/|r|^3 + G sum_j m_j (q_j - q)/|q_j - q|^3,
//
// which is what Jacobi's coordinates of one body more become as its mass vanishes. In A the centre of the
// bodies moves uniformly, so that A is a Kepler problem, and in B nothing moves.
#pragma once

#include <array>

#include <pfaff/systems/canonical/planetary_splitting.hpp>

namespace pfaff::planetary {

/// The centre of mass of n bodies in d directions and its velocity, in numbers N that are made of the values
/// of z by `number`.
template <class N>
struct Centre {
  N mass{};
  std::array<N, 3> place{}, velocity{};
};
template <class N, class T, class Mass, class ToNumber>
Centre<N> centre_of(const Mass& mass, std::size_t n, std::size_t d, In<T> z, const ToNumber& number) {
  Centre<N> centre;
  std::array<N, 3> momentum{};
  centre.mass = number(mass(0));
  for (std::size_t x = 0; x < d; ++x) {
    centre.place[x] = number(z[x * n]);
    momentum[x] = number(z[(d + x) * n]);
  }
  for (std::size_t j = 1; j < n; ++j) {
    const N own = number(mass(j));
    centre.mass = centre.mass + own;
    for (std::size_t x = 0; x < d; ++x) {
      centre.place[x] = centre.place[x] + own / centre.mass * (number(z[x * n + j]) - centre.place[x]);
      momentum[x] = momentum[x] + number(z[(d + x) * n + j]);
    }
  }
  for (std::size_t x = 0; x < d; ++x) centre.velocity[x] = momentum[x] / centre.mass;
  return centre;
}

/// The flow of A: the changes of all places and velocities of `count` probes, which stand by direction in
/// `probe`, places first. z are the positions and momenta of the bodies at its beginning.
template <class T, class Mass>
Status kepler_part_of_probes(const Mass& mass, const T& constant, std::size_t n, std::size_t d, const T& h,
                             In<T> z, std::size_t count, In<T> probe, Out<T> change) {
  using V = Value<T>;
  using Twice = TwoTerms<V>;
  const Centre<T> centre = centre_of<T, T>(mass, n, d, z, [](const T& x) { return x; });
  for (std::size_t i = 0; i < count; ++i) {
    std::array<T, 3> r{}, v{}, dr{}, bend{}, dv{};
    for (std::size_t x = 0; x < d; ++x) {
      r[x] = probe[x * count + i] - centre.place[x];
      v[x] = probe[(d + x) * count + i] - centre.velocity[x];
    }
    // What the relative coordinates round off moves the phase of every turn.
    const auto after_turns = [&](const V& turns) {
      const auto twice = [](const T& x) { return Twice(value_of(x)); };
      const Centre<Twice> exact = centre_of<Twice, T>(mass, n, d, z, twice);
      std::array<Twice, 3> place, speed;
      for (std::size_t x = 0; x < d; ++x) {
        place[x] = twice(probe[x * count + i]) - exact.place[x];
        speed[x] = twice(probe[(d + x) * count + i]) - exact.velocity[x];
      }
      return pfaff::time_after_turns<V>(twice(constant) * exact.mass, value_of(h),
                                        std::span<const Twice>(place.data(), d),
                                        std::span<const Twice>(speed.data(), d), turns);
    };
    const Status status =
        kepler_change<T>(T(constant * centre.mass), h, std::span<const T>(r), std::span<const T>(v),
                         std::span<T>(dr), std::span<T>(bend), std::span<T>(dv), after_turns);
    if (status != Status::converged) return status;
    for (std::size_t x = 0; x < d; ++x) {
      change[x * count + i] = dr[x] + h * centre.velocity[x];
      change[(d + x) * count + i] = dv[x];
    }
  }
  return Status::converged;
}

/// The flow of B: no change of places, and h times the acceleration.
template <class T, class Mass>
Status interaction_part_of_probes(const Mass& mass, const T& constant, std::size_t n, std::size_t d,
                                  const T& h, In<T> z, std::size_t count, In<T> probe, Out<T> change) {
  const Centre<T> centre = centre_of<T, T>(mass, n, d, z, [](const T& x) { return x; });
  const T others = centre.mass - mass(0);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<T, 3> r{}, way{}, difference{}, pull{};
    for (std::size_t x = 0; x < d; ++x) {
      r[x] = probe[x * count + i] - z[x * n];
      way[x] = z[x * n] - centre.place[x];
    }
    pulls_apart(d, r, way, difference, pull);
    for (std::size_t x = 0; x < d; ++x) pull[x] = mass(0) * difference[x] + others * pull[x];
    for (std::size_t j = 1; j < n; ++j) {
      std::array<T, 3> apart{};
      T square(0);
      for (std::size_t x = 0; x < d; ++x) {
        apart[x] = z[x * n + j] - probe[x * count + i];
        square = square + apart[x] * apart[x];
      }
      const T attraction = mass(j) / (square * sqrt(square));
      for (std::size_t x = 0; x < d; ++x) pull[x] = pull[x] + attraction * apart[x];
    }
    for (std::size_t x = 0; x < d; ++x) {
      change[x * count + i] = T(0);
      change[(d + x) * count + i] = h * constant * pull[x];
      if (!isfinite(value_of(change[(d + x) * count + i]))) return Status::non_finite;
    }
  }
  return Status::converged;
}

}  // namespace pfaff::planetary
