#include <pfaff/systems/text/kepler_parts.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::text {

namespace {
// What a formula may differ by and still be the one that is expected, by the size of what is added up: a
// million roundings in quad, since the distances of close bodies lose some digits.
constexpr double rounding_in_quad = 1e-28;

// The slope of a function of one result, as a function.
class Slope {
 public:
  explicit Slope(const Tape& tape)
      : values_(static_cast<std::size_t>(tape.inputs)),
        replay_(std::make_shared<const Tape>(jacobian_tape(tape))) {}
  const std::vector<Quad>& operator()(const std::vector<Quad>& x) {
    replay_(Quad(0), x.data(), values_.data());
    return values_;
  }

 private:
  std::vector<Quad> values_;
  Replay<Quad> replay_;
};

std::vector<Quad> random_place(std::size_t size, const Quad& scale, int seed) {
  RandomNumbers random(seed);
  std::vector<Quad> place;
  for (std::size_t k = 0; k < size; ++k) place.push_back(scale * random.next().quad());
  return place;
}

// The mass of each coordinate, of a kinetic energy sum p^2/(2 m).
std::vector<Real> masses_of_coordinates(const Tape& kinetic) {
  const auto size = static_cast<std::size_t>(kinetic.inputs);
  // Slopes at p = 1 are the inverse masses, which stay fractions where they are.
  const std::vector<Recorded> ones(size, Recorded(1)), weight{Recorded(1)};
  std::vector<Real> masses;
  bool fits = true;
  for (const Recorded& slope : gradient(kinetic, Recorded(0), ones, weight)) {
    const Real inverse = slope.constant();
    fits = fits && isfinite(inverse.quad()) && inverse > Real(0);
    masses.push_back(fits ? Real(1) / inverse : Real(1));
  }
  Slope slope(kinetic);
  const std::vector<Quad> p = random_place(size, Quad(1), 1);
  const std::vector<Quad>& velocity = slope(p);
  for (std::size_t k = 0; k < size; ++k)
    fits = fits && abs(velocity[k] * masses[k].quad() - p[k]) <= Quad(rounding_in_quad);
  if (!fits)
    throw InputError(
        "kinetic: expected sum p^2/(2*m) of all momenta, with masses m > 0 (what has no mass is a probe of "
        "restricted-n-body)");
  return masses;
}

// The masses of bodies of which each has the same one in every direction; empty where they have not.
std::vector<Real> masses_of_bodies(const std::vector<Real>& of_coordinates, std::size_t directions) {
  if (of_coordinates.size() % directions != 0) return {};
  const std::size_t n = of_coordinates.size() / directions;
  for (std::size_t k = n; k < of_coordinates.size(); ++k) {
    const Quad mass = of_coordinates[k - n].quad();
    if (abs(of_coordinates[k].quad() - mass) > Quad(rounding_in_quad) * mass) return {};
  }
  if (n < 2) return {};
  return {of_coordinates.begin(), of_coordinates.begin() + static_cast<std::ptrdiff_t>(n)};
}

// The constant of gravitation from the pull on the first body by the second one, at a distance of one, with
// the others out of reach.
Real constant_of(Slope& slope, const std::vector<Real>& masses, std::size_t directions) {
  const std::size_t n = masses.size();
  const Quad far(0x1p400);
  std::vector<Quad> q(n * directions);
  q[1] = Quad(1);
  for (std::size_t i = 2; i < n; ++i) q[i] = far * Quad(static_cast<int>(i));
  return Real(-slope(q)[0] / (masses[0].quad() * masses[1].quad()));
}

// The body on which the force differs most from that of Newton's attraction, and by how much of the pulls on
// it.
struct Deviation {
  std::size_t body = 0;
  Quad size{0};
};
Deviation deviation_from_attraction(const std::vector<Quad>& slope, const PlanetaryBodies& bodies,
                                    const std::vector<Quad>& q) {
  const std::size_t n = bodies.masses.size(), d = bodies.directions;
  Deviation worst;
  for (std::size_t i = 0; i < n; ++i) {
    std::array<Quad, 3> off{};
    Quad pulls(0);
    for (std::size_t x = 0; x < d; ++x) off[x] = slope[x * n + i];
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      Quad square(0);
      for (std::size_t x = 0; x < d; ++x)
        square += (q[x * n + j] - q[x * n + i]) * (q[x * n + j] - q[x * n + i]);
      const Quad pull = bodies.constant.quad() * bodies.masses[i].quad() * bodies.masses[j].quad() / square;
      for (std::size_t x = 0; x < d; ++x) off[x] += pull * (q[x * n + j] - q[x * n + i]) / sqrt(square);
      pulls += pull;
    }
    for (std::size_t x = 0; x < d; ++x)
      if (const Quad size = off[x] == Quad(0) ? Quad(0) : abs(off[x]) / pulls; !(size <= worst.size))
        worst = {i, size};
  }
  return worst;
}

// Why these bodies do not have this potential; empty where they have. `scale` is the size of positions.
std::string refusal_of(Slope& slope, const PlanetaryBodies& bodies, const Quad& scale) {
  const std::string expected =
      "potential: expected -G*sum(m_i*m_j/|q_i - q_j|) of points with the masses of the "
      "kinetic energy, ";
  const Quad constant = bodies.constant.quad();
  if (!(constant >= Quad(0)) || !isfinite(constant))
    return expected +
           "with G >= 0; the pull of the first two bodies on each other says G = " + to_string(constant, 6);
  for (const int seed : {2, 3}) {
    const std::vector<Quad> q = random_place(bodies.masses.size() * bodies.directions, scale, seed);
    const Deviation worst = deviation_from_attraction(slope(q), bodies, q);
    if (!(worst.size <= Quad(rounding_in_quad)))
      return expected + "x of every body before y; with the G of the first two bodies, " +
             to_string(constant, 6) + ", the force on body " + std::to_string(worst.body + 1) +
             " is off by " + to_string(worst.size, 2) + " of the pulls on it";
  }
  return {};
}
}  // namespace

PlanetaryBodies attracting_bodies(const Tape& kinetic, const Tape& potential,
                                  const std::vector<Real>& initial) {
  for (const auto& [tape, name] : {std::pair(&kinetic, "kinetic"), {&potential, "potential"}})
    if (!tape->autonomous())
      throw InputError(std::string(name) + " reads the time; expected energies without it");
  const auto half = static_cast<std::size_t>(kinetic.inputs);
  const std::vector<Real> masses = masses_of_coordinates(kinetic);
  Quad scale(0);
  for (std::size_t k = 0; k < std::min(half, initial.size()); ++k)
    scale = std::max(scale, abs(initial[k].quad()));
  if (!(scale > Quad(0))) scale = Quad(1);
  Slope slope(potential);
  std::string refused =
      "kinetic: expected at least two bodies, each with one mass in both or all three directions, and "
      "coordinates by direction: x of every body, then y, and in space z";
  for (const std::size_t directions : {2, 3}) {
    PlanetaryBodies bodies{masses_of_bodies(masses, directions), {}, directions};
    if (bodies.masses.empty()) continue;
    bodies.constant = constant_of(slope, bodies.masses, directions);
    refused = refusal_of(slope, bodies, scale);
    if (refused.empty()) return bodies;
  }
  throw InputError(refused);
}

}  // namespace pfaff::text
