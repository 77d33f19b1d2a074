// The snakeboard (ostrowski-lewis-murray-burdick1994): a board at (x, y) with heading theta, a rider's wheel
// turned by psi, and two pairs of wheels, l ahead and behind, steered by phi and -phi, none of which slips
// sideways.
//
//   T = m (x'^2 + y'^2)/2 + m l^2 theta'^2/2 + J_0 psi'^2/2 + J_0 psi' theta' + J_1 phi'^2,   V = c phi^2/2
//   A = (-sin(theta + phi), cos(theta + phi), -l cos phi, 0, 0),
//       (-sin(theta - phi), cos(theta - phi),  l cos phi, 0, 0)
//
// psi' and theta' are coupled by the rider's inertia; p_psi = J_0 (psi' + theta') is conserved, and so is
// p_phi where no spring holds the steering (c = 0). Moving phi and psi in turn drives the board ahead.
//
// Limits: the mass matrix is positive for J_0 < m l^2, and at phi = +-pi/2 the constraints depend on each
// other. Without a spring phi grows with time and gets there; a spring keeps it away.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct Snakeboard {
  static constexpr int dimension = 10;
  static constexpr int velocity_constraint_count = 2;
  Real mass = 1, length = 0.5_r, rider = 0.1_r, wheels = 0.05_r, stiffness = 0;
  static std::vector<Parameter> parameters() {
    using S = Snakeboard;
    return {
        parameter(&S::mass, "mass", "kg", 1e-3, 1e3),
        parameter(&S::length, "length", "m", 1e-3, 1e3, "from the centre to a pair of wheels"),
        parameter(&S::rider, "rider-inertia", "kg m^2", 1e-6, 1e6,
                  "moment of inertia of the rider, below mass length^2"),
        parameter(&S::wheels, "wheel-inertia", "kg m^2", 1e-6, 1e6, "moment of inertia of a pair of wheels"),
        parameter(&S::stiffness, "stiffness", "J", 0, 1e6, "c of the spring that centres the steering")};
  }
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"stiffness", "0.3"}}}; }
  static std::vector<std::string> velocity_constraint_names() { return {"front-wheels", "back-wheels"}; }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    std::vector<Invariant> list{conserved_quadratic("energy", "J"), conserved("momentum-psi", "kg m^2/s")};
    if (stiffness.is(0)) list.push_back(conserved("momentum-phi", "kg m^2/s"));
    return list;
  }
  // The board at (0.1, -0.2), moving along X_1 = (2 l cos^2 phi cos theta, 2 l cos^2 phi sin theta, -sin 2
  // phi, 0, 0), which the constraints allow.
  template <class T>
  void initial(Out<T> z) const {
    const T theta(Real::fraction(3, 10)), phi(Real::fraction(1, 2)), rate(Real::fraction(4, 5));
    z[0] = T(Real::fraction(1, 10));
    z[1] = T(Real::fraction(-1, 5));
    z[2] = theta;
    z[3] = T(Real::fraction(2, 5));
    z[4] = phi;
    const T c = cos(phi), along = 2 * length * c * c * rate, turning = -(2 * sin(phi) * c * rate);
    const T wheel(Real::fraction(3, 5));
    z[5] = mass * along * cos(theta);
    z[6] = mass * along * sin(theta);
    z[7] = mass * (length * (length * turning)) + rider * wheel;
    z[8] = rider * (turning + wheel);
    z[9] = T(2 * wheels * Real::fraction(-3, 10));
  }
  // With the block [[m l^2, J_0], [J_0, J_0]] of theta and psi in the mass matrix inverted.
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const Real board = mass * length * length - rider;
    const T turning = p[2] - p[3];
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass) + turning * turning / (2 * board) +
           p[3] * p[3] / (2 * rider) + p[4] * p[4] / (4 * wheels);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return stiffness * (q[4] * q[4] / 2);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    const T front = q[2] + q[4], back = q[2] - q[4], lever = length * cos(q[4]);
    rows[0] = -sin(front);
    rows[1] = cos(front);
    rows[2] = -lever;
    rows[5] = -sin(back);
    rows[6] = cos(back);
    rows[7] = lever;
    rows[3] = rows[4] = rows[8] = rows[9] = T(0);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(5)) + potential(t, z.first(5));
    values[1] = z[8];
    if (stiffness.is(0)) values[2] = z[9];
  }
};

const System<Snakeboard> registered{
    {.name = "snakeboard",
     .title = "snakeboard: a rider's wheel psi turns a board on two steered pairs of wheels, +-phi",
     .reference = "ostrowski-lewis-murray-burdick1994",
     .description =
         "A board on two steered pairs of wheels, moved by a rider who turns. Take it to test methods "
         "with two constraints, a coupled mass matrix and, with a spring on the steering "
         "(stiffness), a potential. At phi = +-pi/2 the constraints depend on each other: without a "
         "spring the steering turns steadily and reaches that after some seconds, from the state of "
         "the descriptor after seven.",
     .coordinates = {{"x", "m"},
                     {"y", "m"},
                     {"theta", "rad"},
                     {"psi", "rad"},
                     {"phi", "rad"},
                     {"p_x", "kg m/s"},
                     {"p_y", "kg m/s"},
                     {"p_theta", "kg m^2/s"},
                     {"p_psi", "kg m^2/s"},
                     {"p_phi", "kg m^2/s"}}}};
}  // namespace
