// The lattice of Fermi, Pasta, Ulam and Tsingou: n particles of unit mass in a row between two walls, joined
// by n + 1 springs that are not quite linear,
//
//   H = sum_i p_i^2/2 + sum_i (d_i^2/2 + alpha d_i^3/3 + beta d_i^4/4),   d_i = q_i - q_{i-1}, q_0 = q_{n+1}
//   = 0
//
// It starts at rest in the lowest mode of the linear lattice, q_i = sin(pi i/(n + 1)). With s = sin(pi/(2 (n
// + 1))) its energy is then (n + 1)(s^2 + 3/2 beta s^4), whatever alpha is: the cubes of the lengthenings
// cancel.
//
// The harmonic energy of mode k is that of the oscillator (Q_k, P_k) of the linear lattice,
//   E_k = (P_k^2 + w_k^2 Q_k^2)/2,   w_k = 2 sin(pi k/(2 (n + 1))),   Q_k = sqrt(2/(n + 1)) sum_i q_i sin(pi
//   i k/(n + 1)),
// and P_k of p likewise. It is conserved where alpha = beta = 0; what the springs make of it is what the
// lattice is taken for, so that the lowest modes are watched and expected to do nothing in particular.
#include <algorithm>
#include <string>

#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct FermiPastaUlamTsingou {
  static constexpr bool batched = true;
  static constexpr int most_modes = 4;  // whose harmonic energies are watched; each costs two passes
  int count = 32;
  Real alpha = 0.25_r, beta = 0;
  static std::vector<Parameter> parameters() {
    using S = FermiPastaUlamTsingou;
    return {parameter(&S::count, "n", "", 1, 10000, "number of particles"),
            parameter(&S::alpha, "alpha", "", -10, 10, "quadratic part of the springs' forces"),
            parameter(&S::beta, "beta", "", 0, 10, "cubic part of the springs' forces")};
  }
  static std::vector<Assignments> instances(bool full) {
    const Assignments both{{"n", "5"}, {"beta", "0.1"}};
    if (full) return {{{"n", "8"}}, {{"n", "1"}}, both};
    return {both};
  }
  [[nodiscard]] int dimension() const { return 2 * count; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count); }
  [[nodiscard]] int modes() const { return std::min(count, most_modes); }
  [[nodiscard]] std::vector<Coordinate> coordinates() const {
    std::vector<Coordinate> names;
    for (const char* name : {"q", "p"})
      for (int i = 1; i <= count; ++i) names.push_back({name + std::to_string(i), ""});
    return names;
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    std::vector<Invariant> list{conserved("energy", "")};
    for (int k = 1; k <= modes(); ++k)
      list.push_back({"harmonic-energy-" + std::to_string(k), "", Behaviour::free});
    return list;
  }
  template <class T>
  void initial(Out<T> z) const {
    const Real pi = 3.14159265358979323846264338327950288_r;
    for (std::size_t i = 0; i < size(); ++i) {
      z[i] = T(sin(pi * Real::fraction(static_cast<std::int64_t>(i) + 1, count + 1)));
      z[size() + i] = T(0);
    }
  }

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (const T& one : p) sum = sum + one * one;
    return sum / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T cubic = T(alpha) / 3, quartic = T(beta) / 4, half(Real::fraction(1, 2));
    T sum(0);
    for (std::size_t i = 0; i <= size(); ++i) {
      const T d = lengthening<T>(q, i);
      sum = sum + d * d * (half + d * (cubic + d * quartic));
    }
    return sum;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const T a(alpha), b(beta);
    const auto tension = [&](const T& d) { return d * (1 + d * (a + d * b)); };
    T left = tension(lengthening<T>(q, 0));
    for (std::size_t i = 0; i < size(); ++i) {
      const T right = tension(lengthening<T>(q, i + 1));
      f[i] = right - left;
      left = right;
    }
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    for (std::size_t i = 0; i < size(); ++i) v[i] = p[i];
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const In<T> q = z.first(size()), p = z.subspan(size());
    values[0] = kinetic(t, p) + potential(t, q);
    const T pi(3.14159265358979323846264338327950288_r);
    for (int k = 1; k <= modes(); ++k) {
      const T angle = pi * k / (count + 1), half = sin(angle / 2), place = sine_sum<T>(q, angle),
              speed = sine_sum<T>(p, angle);
      values[static_cast<std::size_t>(k)] = (speed * speed + 4 * half * half * place * place) / (count + 1);
    }
  }

 private:
  // Of the spring between particles i and i + 1, of which 0 and n + 1 are the walls.
  template <class T>
  T lengthening(In<T> q, std::size_t i) const {
    if (i == 0) return q[0];
    return i < size() ? T(q[i] - q[i - 1]) : T(-q[i - 1]);
  }
  // sum_i x_i sin(i angle), by Clenshaw's recurrence, which takes two trigonometric functions for all of it.
  template <class T>
  static T sine_sum(In<T> x, const T& angle) {
    const T twice = 2 * cos(angle);
    T sum(0), before(0);
    for (std::size_t i = x.size(); i > 0; --i) {
      const T next = x[i - 1] + twice * sum - before;
      before = sum;
      sum = next;
    }
    return sum * sin(angle);
  }
};

const System<FermiPastaUlamTsingou> registered{
    {.name = "fermi-pasta-ulam-tsingou",
     .title =
         "lattice of Fermi, Pasta, Ulam and Tsingou, q_i'' = d_{i+1} - d_i + alpha (d_{i+1}^2 - d_i^2) + "
         "beta (d_{i+1}^3 - d_i^3)",
     .reference = "fermi-pasta-ulam1955",
     .description =
         "A row of particles between walls, joined by springs that are slightly nonlinear, started "
         "in its lowest mode. Take it for motion of many degrees of freedom that is neither "
         "integrable nor visibly chaotic: energy goes from the lowest mode to a few others and "
         "nearly all of it comes back. An evaluation costs a number of operations linear in n. With "
         "alpha alone, large amplitudes tear the lattice apart.",
     .time_unit = ""}};
}  // namespace
