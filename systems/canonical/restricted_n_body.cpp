// The restricted problem of n bodies: bodies that attract each other (n_body.hpp), and probes without mass,
// which they attract and which attract nothing,
//
//   q_i' = p_i/m_i,  p_i' = -dV/dq_i,   x' = u,  u' = G sum_j m_j (q_j - x)/(|q_j - x|^2 + epsilon^2)^{3/2},
//
// with the softening length epsilon. A probe has no momentum m v and is given by its velocity u. For given
// motions of the bodies its own is that of the Hamiltonian |u|^2/2 - G sum_j m_j/|q_j(t) - x|, which depends
// on time; the bodies have the energy of n_body.hpp. The two together are no Hamiltonian system: the bodies'
// own energy does not make the probes move, and a sum of both would make probes pull the bodies. So this
// system offers its field and, without softening, parts with exact flows, of which each maps the bodies by a
// symplectic map and the probes by one that is symplectic for given motions of the bodies.
//
// The state is that of the bodies, (q, p), and behind it that of the probes, (x, u), each by direction.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/n_body.hpp>
#include <pfaff/systems/canonical/planetary_probes.hpp>

namespace {
using namespace pfaff;

struct RestrictedNBody {
  static constexpr bool batched = true;
  pfaff::NBody massive;
  int probes = 1;

  static std::vector<Parameter> parameters() {
    using S = RestrictedNBody;
    std::vector<Parameter> list = pfaff::NBody::parameters();
    for (Parameter& p : list) {
      p.write = [write = p.write](void* object, const std::string& text) {
        write(&static_cast<S*>(object)->massive, text);
      };
      p.read = [read = p.read](const void* object) { return read(&static_cast<const S*>(object)->massive); };
    }
    list.push_back(parameter(&S::probes, "probes", "", 1, 10000, "number of probes without mass"));
    return list;
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list = pfaff::NBody::instances(full);
    list.back().emplace_back("probes", "3");
    return list;
  }

  [[nodiscard]] std::size_t bodies() const { return static_cast<std::size_t>(massive.bodies()); }
  [[nodiscard]] std::size_t directions() const { return static_cast<std::size_t>(massive.dimensions()); }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(probes); }
  [[nodiscard]] int dimension() const { return massive.dimension() + 2 * probes * massive.dimensions(); }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> list = massive.coordinates();
    for (const char* prefix : {"", "v"})
      for (std::size_t x = 0; x < directions(); ++x)
        for (int i = 1; i <= probes; ++i)
          list.push_back({prefix + std::string(1, "xyz"[x]) + "_probe" + std::to_string(i), ""});
    return list;
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const { return massive.invariant_list(); }
  // Probes go round all of the bodies, outside of where these start: with radii half a unit apart and angles
  // of two radians.
  template <class T>
  void initial(Out<T> z) const {
    const std::size_t n = bodies(), d = directions(), k = count(), whole = 2 * n * d;
    massive.template initial<T>(z.first(whole));
    Real radius = massive.central.is(1) ? Real(2) : Real(1) + Real::fraction(massive.count, 2);
    for (std::size_t i = 0; i < k; ++i, radius = radius + Real::fraction(1, 2)) {
      const Real angle = Real(static_cast<int>(2 * i)), speed = sqrt(massive.attraction / radius);
      const std::array<Real, 3> place{radius * cos(angle), radius * sin(angle), Real(0)},
          velocity{-(speed * sin(angle)), speed * cos(angle), speed * Real::fraction(1, 50)};
      for (std::size_t x = 0; x < d; ++x) {
        z[whole + x * k + i] = T(place[x]);
        z[whole + (d + x) * k + i] = T(velocity[x]);
      }
    }
  }

  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    const std::size_t n = bodies(), d = directions(), half = n * d, k = count();
    massive.velocity(t, z.subspan(half, half), rate.first(half));
    massive.force(t, z.first(half), rate.subspan(half, half));
    const In<T> probe = z.subspan(2 * half);
    const Out<T> change = rate.subspan(2 * half);
    const T softening = T(massive.length);
    for (std::size_t i = 0; i < k; ++i) {
      std::array<T, 3> pull{};
      for (std::size_t j = 0; j < n; ++j) {
        std::array<T, 3> way{};
        T square = softening * softening;
        for (std::size_t x = 0; x < d; ++x) {
          way[x] = z[x * n + j] - probe[x * k + i];
          square = square + way[x] * way[x];
        }
        const T scale = T(massive.attraction) * massive.mass<T>(j) / (square * sqrt(square));
        for (std::size_t x = 0; x < d; ++x) pull[x] = pull[x] + scale * way[x];
      }
      for (std::size_t x = 0; x < d; ++x) {
        change[x * k + i] = probe[(d + x) * k + i];
        change[(d + x) * k + i] = pull[x];
      }
    }
  }
  static constexpr std::size_t small_part = planetary::interaction;
  [[nodiscard]] int part_count() const { return massive.part_count(); }
  [[nodiscard]] std::vector<std::string> part_names() const { return massive.part_names(); }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const std::size_t n = bodies(), d = directions(), whole = 2 * n * d;
    const In<T> of_bodies = z.first(whole), probe = z.subspan(whole);
    const Status status = massive.part_flow(part, h, of_bodies, change.first(whole));
    if (status != Status::converged) return status;
    const auto mass = [this](std::size_t body) { return massive.mass<T>(body); };
    const T constant(massive.attraction);
    return part == planetary::kepler
               ? planetary::kepler_part_of_probes<T>(mass, constant, n, d, h, of_bodies, count(), probe,
                                                     change.subspan(whole))
               : planetary::interaction_part_of_probes<T>(mass, constant, n, d, h, of_bodies, count(), probe,
                                                          change.subspan(whole));
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    const std::size_t whole = 2 * bodies() * directions();
    reverse_momenta<T>(z.first(whole), reversed.first(whole));
    reverse_momenta<T>(z.subspan(whole), reversed.subspan(whole));
  }
  /// Those of the bodies. Probes have none.
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    massive.invariants(t, z.first(2 * bodies() * directions()), values);
  }
};

const System<RestrictedNBody> registered{
    {.name = "restricted-n-body",
     .title = "probes without mass among n bodies that attract each other, u' = G sum m_j (q_j - x)/r_j^3",
     .reference = "rein-tamayo2015",
     .description =
         "The bodies of n-body, and probes that they attract and that attract nothing, such as asteroids, "
         "rings or spacecraft. Take it where a mass is so small that it is zero. A probe is given by its "
         "velocity; the whole has no Hamiltonian, so that methods for energies do not fit: take "
         "exact-flow-splitting, whose steps move bodies and probes symplectically, or a method for any "
         "field. "
         "Invariants are those of the bodies.",
     .time_unit = ""}};
}  // namespace
