// Systems with velocity constraints that the compiler must refuse. Each comment `refused:` is the beginning
// of a message it must give.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Particle {
  static constexpr int dimension = 4;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3]) / 2;
  }
};
// refused: velocity_constraints belongs together with velocity_constraint_count, which is missing
struct NotCounted : Particle {
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
  }
};
// refused: velocity_constraints: expected template <class T> void velocity_constraints(const T& t, In<T> q,
struct WithoutTime : Particle {
  static constexpr int velocity_constraint_count = 1;
  template <class T>
  void velocity_constraints(In<T> q, Out<T> rows) const {
    rows[0] = q[1];
  }
};
// refused: velocity_offsets is written beside velocity_constraints
struct OffsetsAlone : Particle {
  template <class T>
  void velocity_offsets(const T& t, In<T> /*q*/, Out<T> b) const {
    b[0] = t;
  }
};
// refused: velocity_constraints is written beside a canonical energy (kinetic and potential, or hamiltonian
struct WithoutEnergy {
  static constexpr int dimension = 4, velocity_constraint_count = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < 4; ++k) rate[k] = z[k];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
  }
};
// refused: velocity_constraints stand beside holonomic constraints, or alone
struct BesideThoseOfThePhaseSpace : Particle {
  static constexpr int constraint_count = 1, velocity_constraint_count = 1;
  template <class T>
  void constraints(const T& /*t*/, In<T> z, Out<T> phi) const {
    phi[0] = z[0];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
  }
};

const SystemDescriptor descriptor{.name = "refused", .title = "", .reference = ""};
const auto models = {make_model(descriptor, NotCounted{}), make_model(descriptor, WithoutTime{}),
                     make_model(descriptor, OffsetsAlone{}), make_model(descriptor, WithoutEnergy{}),
                     make_model(descriptor, BesideThoseOfThePhaseSpace{})};
}  // namespace
