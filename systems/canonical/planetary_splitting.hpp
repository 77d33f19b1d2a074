// The splitting H = A + B of n bodies that attract each other into Kepler orbits about the bodies before them
// and an interaction (wisdom-holman1991; rein-tamayo2015), each solved exactly.
//
// Of body i let R_i and P_i be the centre of mass and the momentum of the bodies 0, ..., i, and M_i their
// mass. Jacobi's coordinates, which are canonical, are those of body i relative to the bodies before it, r_i
// = q_i - R_(i-1), with the velocity v_i = p_i/m_i - P_(i-1)/M_(i-1), and those of the centre of mass of all.
// In them the kinetic energy has no products of different bodies, and
//
//   A = |P|^2/(2 M) + sum_(i > 0) [m_i' |v_i|^2/2 - G m_i M_(i-1)/|r_i|],   m_i' = m_i M_(i-1)/M_i
//
// is n - 1 Kepler problems of strength G M_i and a uniform motion. B = H - A depends on positions alone,
//
//   B = -G sum_(0 < j < i) m_i m_j/|q_i - q_j| - sum_i [G m_i m_0/|q_i - q_0| - G m_i M_(i-1)/|r_i|],
//
// and where the first body is much heavier than the others it is small: its flow adds to the momenta. Both
// flows are written for the positions and momenta of the bodies themselves, so that energy, momentum and
// angular momentum are the system's own. A holds the same total momentum and angular momentum as H, and so
// does B.
//
// In B the pulls of the first body and of Kepler's problem nearly cancel. They are subtracted by Encke's
// method: with r = q_i - q_0, r_i = r + d and w = d.(d + 2 r)/|r|^2,
//
//   r_i/|r_i|^3 - r/|r|^3 = (d - F r_i)/|r|^3,   F = 1 - (1 + w)^(-3/2),
//
// in which nothing is subtracted that is alike (battin1999).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/numbers/kepler_flow.hpp>

namespace pfaff {

namespace planetary {
inline constexpr std::size_t kepler = 0, interaction = 1;

/// The time h less `turns` periods of body i about the bodies before it, whose coordinates are made again
/// with twice the digits: what they round off moves the phase of every turn.
template <class T, class Mass, class V = Value<T>>
V time_after_turns(const Mass& mass, const T& constant, std::size_t n, std::size_t d, const T& h, In<T> z,
                   std::size_t i, const V& turns) {
  using Number = TwoTerms<V>;
  const std::size_t half = n * d;
  const auto value = [](const T& x) { return Number(value_of(x)); };
  std::array<Number, 3> centre, total, r, v;
  for (std::size_t x = 0; x < d; ++x) {
    centre[x] = value(z[x * n]);
    total[x] = value(z[half + x * n]);
  }
  Number outer = value(mass(0));
  for (std::size_t j = 1; j <= i; ++j) {
    const Number own = value(mass(j)), inner = outer;
    outer = inner + own;
    for (std::size_t x = 0; x < d; ++x) {
      const Number momentum = value(z[half + x * n + j]);
      r[x] = value(z[x * n + j]) - centre[x];
      v[x] = momentum / own - total[x] / inner;
      centre[x] = centre[x] + own / outer * r[x];
      total[x] = total[x] + momentum;
    }
  }
  return pfaff::time_after_turns<V>(value(constant) * outer, value_of(h), std::span<const Number>(r),
                                    std::span<const Number>(v), turns);
}

/// Outwards from body 1: the change of Jacobi's coordinates of each body, left where its own change will
/// stand, and of all bodies together the mass and the momentum. Of positions it is the whole change or,
/// unless `whole`, what it has beyond the uniform motion. `turned` tells that a body has gone round.
template <class T, class Mass>
Status jacobi_changes(const Mass& mass, const T& constant, std::size_t n, std::size_t d, const T& h, In<T> z,
                      bool whole, Out<T> change, T& inner, std::array<T, 3>& total, bool& turned) {
  const std::size_t half = n * d;
  std::array<T, 3> centre{};  // R_(i-1), as `total` is P_(i-1) and `inner` M_(i-1)
  inner = mass(0);
  for (std::size_t x = 0; x < d; ++x) {
    centre[x] = z[x * n];
    total[x] = z[half + x * n];
  }
  for (std::size_t i = 1; i < n; ++i) {
    const T own = mass(i), outer = inner + own;
    std::array<T, 3> r{}, v{}, dr{}, bend{}, dv{};  // zero beyond direction d
    for (std::size_t x = 0; x < d; ++x) {
      r[x] = z[x * n + i] - centre[x];
      v[x] = z[half + x * n + i] / own - total[x] / inner;
    }
    const auto after_turns = [&](const Value<T>& turns) {
      turned = true;
      return time_after_turns<T>(mass, constant, n, d, h, z, i, turns);
    };
    const Status status =
        kepler_change<T>(T(constant * outer), h, std::span<const T>(r), std::span<const T>(v),
                         std::span<T>(dr), std::span<T>(bend), std::span<T>(dv), after_turns);
    if (status != Status::converged) return status;
    const T share = own / outer, reduced = own * inner / outer;
    for (std::size_t x = 0; x < d; ++x) {
      change[x * n + i] = whole ? dr[x] : bend[x];
      change[half + x * n + i] = reduced * dv[x];
      centre[x] = centre[x] + share * r[x];
      total[x] = total[x] + z[half + x * n + i];
    }
    inner = outer;
  }
  return Status::converged;
}

/// The flow of the Kepler part: writes the change of all positions and momenta, which stand by direction as
/// in Gravitation. `mass(i)` is the mass of body i, `constant` that of gravitation.
template <class T, class Mass>
Status kepler_part(const Mass& mass, const T& constant, std::size_t n, std::size_t d, const T& h, In<T> z,
                   Out<T> change) {
  const std::size_t half = n * d;
  T inner(0);
  std::array<T, 3> moved{}, pushed{}, total{};
  bool turned = false;
  const auto outwards = [&](bool whole) {
    return jacobi_changes(mass, constant, n, d, h, z, whole, change, inner, total, turned);
  };
  Status status = outwards(false);
  // The uniform motion of a body that goes round is longer than its orbit and would cancel.
  const bool whole = turned;
  if (status == Status::converged && whole) status = outwards(true);
  if (status != Status::converged) return status;
  // Inwards: the changes of R_i and P_i, and from them those of body i. The uniform motions of Jacobi's
  // coordinates are together those of the bodies, which move by themselves: added up for the heavy body,
  // whose own is small, they would cancel. Where the changes are whole, the uniform motion of the centre of
  // all masses is the only one.
  const auto uniform = [&](std::size_t i, std::size_t x) {
    return whole ? T(0) : h * (z[half + x * n + i] / mass(i));
  };
  if (whole)
    for (std::size_t x = 0; x < d; ++x) moved[x] = h * (total[x] / inner);
  for (std::size_t i = n; i-- > 1;) {
    const T outer = inner, own = mass(i), share = own / outer;
    inner = inner - own;
    const T rest = inner / outer;
    for (std::size_t x = 0; x < d; ++x) {
      const T dr = change[x * n + i], dp = change[half + x * n + i];
      change[x * n + i] = uniform(i, x) + (moved[x] + rest * dr);
      moved[x] = moved[x] - share * dr;
      change[half + x * n + i] = dp + share * pushed[x];
      pushed[x] = rest * pushed[x] - dp;
    }
  }
  for (std::size_t x = 0; x < d; ++x) {
    change[x * n] = uniform(0, x) + moved[x];
    change[half + x * n] = pushed[x];
  }
  return Status::converged;
}

/// Of r_i = r + d in `directions` directions: `difference` is r_i/|r_i|^3 - r/|r|^3, by Encke's method, and
/// `pull` is r_i/|r_i|^3. `way` is d.
template <class T>
void pulls_apart(std::size_t directions, const std::array<T, 3>& r, const std::array<T, 3>& way,
                 std::array<T, 3>& difference, std::array<T, 3>& pull) {
  T square(0), far(0), mixed(0);
  for (std::size_t x = 0; x < directions; ++x) {
    pull[x] = r[x] + way[x];
    square = square + r[x] * r[x];
    far = far + pull[x] * pull[x];
    mixed = mixed + way[x] * (way[x] + T(2) * r[x]);
  }
  const T w = mixed / square, ratio = T(1) + w, cube = ratio * sqrt(ratio);
  const T shrunk = w * (T(3) + w * (T(3) + w)) / (cube * (T(1) + cube));
  const T near_cube = T(1) / (square * sqrt(square)), far_cube = T(1) / (far * sqrt(far));
  for (std::size_t x = 0; x < directions; ++x) {
    difference[x] = (way[x] - shrunk * pull[x]) * near_cube;
    pull[x] = pull[x] * far_cube;
  }
}

/// The flow of the interaction: no change of positions, and h times the force -dB/dq of momenta.
template <class T, class Mass>
Status interaction_part(const Mass& mass, const T& constant, std::size_t n, std::size_t d, const T& h,
                        In<T> z, Out<T> change) {
  const std::size_t half = n * d;
  for (std::size_t k = 0; k < 2 * half; ++k) change[k] = T(0);
  const T scale = h * constant;
  // By m_j each, sum_(0 < j <= i) m_j (q_j - q_0): what the centre of mass R_i is away from body 0.
  std::array<T, 3> moment{};
  for (std::size_t x = 0; x < d; ++x) moment[x] = mass(1) * (z[x * n + 1] - z[x * n]);
  T others = mass(1);  // m_1 + ... + m_(i-1)
  for (std::size_t i = 2; i < n; ++i) {
    const T own = mass(i), inner = mass(0) + others, strength = scale * own;
    // The first body against Kepler's problem.
    std::array<T, 3> r{}, way{}, difference{}, pull{};
    for (std::size_t x = 0; x < d; ++x) {
      r[x] = z[x * n + i] - z[x * n];
      way[x] = -(moment[x] / inner);
    }
    pulls_apart(d, r, way, difference, pull);
    for (std::size_t x = 0; x < d; ++x) {
      change[half + x * n + i] =
          change[half + x * n + i] + strength * (mass(0) * difference[x] + others * pull[x]);
      change[half + x * n] = change[half + x * n] - strength * mass(0) * difference[x];
      for (std::size_t j = 1; j < i; ++j)
        change[half + x * n + j] = change[half + x * n + j] - strength * mass(j) * pull[x];
    }
    // The others among each other.
    for (std::size_t j = 1; j < i; ++j) {
      std::array<T, 3> apart{};
      T distance(0);
      for (std::size_t x = 0; x < d; ++x) {
        apart[x] = z[x * n + j] - z[x * n + i];
        distance = distance + apart[x] * apart[x];
      }
      const T attraction = strength * mass(j) / (distance * sqrt(distance));
      for (std::size_t x = 0; x < d; ++x) {
        change[half + x * n + i] = change[half + x * n + i] + attraction * apart[x];
        change[half + x * n + j] = change[half + x * n + j] - attraction * apart[x];
      }
    }
    for (std::size_t x = 0; x < d; ++x) moment[x] = moment[x] + own * r[x];
    others = others + own;
  }
  for (std::size_t k = half; k < 2 * half; ++k)
    if (!isfinite(value_of(change[k]))) return Status::non_finite;
  return Status::converged;
}

inline std::vector<std::string> part_names() { return {"Kepler orbits", "interaction"}; }

/// The flow of one of the two parts.
template <class T, class Mass>
Status part_flow(std::size_t part, const Mass& mass, const T& constant, std::size_t n, std::size_t d,
                 const T& h, In<T> z, Out<T> change) {
  return part == kepler ? kepler_part<T>(mass, constant, n, d, h, z, change)
                        : interaction_part<T>(mass, constant, n, d, h, z, change);
}
}  // namespace planetary

}  // namespace pfaff
