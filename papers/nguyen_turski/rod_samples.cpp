#include <pfaff/papers/nguyen_turski/rod_samples.hpp>

#include <array>

namespace pfaff::nguyen_turski {

namespace {

Numbers quads_of(const std::vector<Real>& values) {
  Numbers list;
  for (const Real& x : values) list.push_back(x.quad());
  return list;
}
std::vector<Real> fractions(const std::vector<std::array<int, 2>>& values) {
  std::vector<Real> list;
  for (const auto& [numerator, denominator] : values) list.push_back(Real::fraction(numerator, denominator));
  return list;
}

// Completes a sample whose rods have the directions `units`, vectors of length 1, from bead to bead.
RodSample sample(BeadRodDescription d, bool pendulum, const std::vector<Real>& lengths,
                 const std::vector<std::vector<Real>>& units, const Real& gravity) {
  const std::size_t axes = d.axes(), beads = d.beads();
  if (!gravity.is(0)) {
    d.gravity.assign(axes, Real(0));
    d.gravity.back() = -gravity;
  }
  if (pendulum) d.anchors = {{"origin", std::vector<Real>(axes, Real(0))}};
  d.positions.assign(beads * axes, Real(0));
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const std::size_t to = pendulum ? k : k + 1, from = pendulum && k == 0 ? beads : to - 1;
    // The first point of a rod is a bead: where a rod hangs from the origin that is the lower one.
    d.rods.push_back(from == beads ? Rod{to, from, lengths[k]} : Rod{from, to, lengths[k]});
    for (std::size_t x = 0; x < axes; ++x)
      d.positions[to * axes + x] =
          (from == beads ? Real(0) : d.positions[from * axes + x]) + lengths[k] * units[k][x];
  }
  for (std::size_t k = 0; k < beads * axes; ++k)
    d.momenta.push_back(Real::fraction(static_cast<int>((7 * k * k + 3 * k) % 11) - 5, 8));
  RodSample made{d, {}};
  made.rods = {pendulum,
               axes,
               quads_of(d.masses),
               quads_of(lengths),
               quads_of(d.friction),
               gravity.quad(),
               quads_of(d.positions),
               quads_of(d.momenta)};
  return made;
}

}  // namespace

RodSample sample_pendulum(bool with_friction) {
  BeadRodDescription d;
  d.origin = "a pendulum of nguyen-turski";
  d.dimension = 2;
  d.masses = fractions({{1, 1}, {3, 2}, {2, 1}, {5, 4}});
  if (with_friction) d.friction = fractions({{3, 10}, {1, 10}, {1, 5}, {2, 5}});
  const std::vector<std::vector<Real>> units{fractions({{3, 5}, {-4, 5}}), fractions({{12, 13}, {5, 13}}),
                                             fractions({{5, 13}, {-12, 13}}),
                                             fractions({{-8, 17}, {15, 17}})};
  return sample(d, true, fractions({{1, 1}, {3, 4}, {5, 4}, {1, 2}}), units, Real::fraction(981, 100));
}
RodSample sample_chain() {
  BeadRodDescription d;
  d.origin = "a chain of nguyen-turski";
  d.dimension = 3;
  d.masses = fractions({{1, 1}, {3, 2}, {2, 1}, {5, 4}, {3, 4}});
  d.friction = fractions({{3, 10}, {1, 10}, {1, 5}, {2, 5}, {1, 2}});
  const std::vector<std::vector<Real>> units{
      fractions({{2, 7}, {3, 7}, {6, 7}}), fractions({{6, 7}, {-2, 7}, {3, 7}}),
      fractions({{2, 3}, {1, 3}, {-2, 3}}), fractions({{1, 9}, {4, 9}, {8, 9}})};
  return sample(d, false, fractions({{1, 1}, {3, 4}, {5, 4}, {1, 2}}), units, Real(0));
}

printed::Rods moved(printed::Rods rods, const Quad& off) {
  for (std::size_t k = 0; k < rods.q.size(); ++k) rods.q[k] += off * sin(Quad(static_cast<int>(3 * k + 1)));
  return rods;
}
BeadRodPoint engine_at(const BeadRodDescription& description, const printed::Rods& rods) {
  Numbers z = rods.q;
  z.insert(z.end(), rods.p.begin(), rods.p.end());
  return {bead_rod_model(description), z};
}

}  // namespace pfaff::nguyen_turski
