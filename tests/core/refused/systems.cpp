// Systems that the compiler must refuse. Each comment `refused:` is the beginning of a message it must give.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// refused: kinetic: expected template <class T> T kinetic(const T& t, In<T> p) const
struct KineticWithoutTime {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};
// refused: field: expected template <class T> void field(const T& t, In<T> z, Out<T> rate) const
struct FieldNotConst {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
};
// refused: hamiltonian: expected template <class T> T hamiltonian(const T& t, In<T> z) const
struct HamiltonianOfDoubles {
  static constexpr int dimension = 2;
  [[nodiscard]] double hamiltonian(double /*t*/, In<double> z) const { return z[0] * z[1]; }
};
// refused: invariants: expected template <class T> void invariants(const T& t, In<T> z, Out<T> values) const
struct InvariantsReturned {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  T invariants(In<T> z) const {
    return z[0];
  }
};
// refused: kinetic belongs together with potential, which is missing: H = T(p, t) + V(q, t)
struct NoPotential {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
};
// refused: birkhoffian belongs together with one_form, which is missing: the action form F.dz - B dt
struct NoOneForm {
  static constexpr int dimension = 2;
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return z[0] * z[0] / 2;
  }
};
// refused: structure belongs together with covector, which is missing
// refused: structure: expected template <class T> void structure(const T& t, In<T> z, Out<T> k) const
struct StructureAlone {
  static constexpr int dimension = 2;
  template <class T>
  void structure(const T& /*t*/, Out<T> k) const {
    k[1] = T(-1);
    k[2] = T(1);
  }
};
// refused: covector: expected template <class T> void covector(const T& t, In<T> z, Out<T> d) const
// refused: structure and covector are written instead of birkhoffian and one_form
struct BothForms {
  static constexpr int dimension = 2;
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return z[0] * z[0] / 2;
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    form[0] = z[1];
  }
  template <class T>
  void structure(const T& /*t*/, In<T> /*z*/, Out<T> k) const {
    k[1] = T(-1);
    k[2] = T(1);
  }
  template <class T>
  T covector(const T& /*t*/, In<T> z) const {
    return z[0];
  }
};
// refused: force is written beside kinetic and potential (what is something else needs another name)
struct ForceAlone {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = -q[0];
  }
};
// refused: alpha: expected template <class T> void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z,
struct AlphaOfOneTime {
  static constexpr int dimension = 2;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void alpha(const T& /*t*/, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    w_hat[0] = new_z[0] - old_z[0];
    w[0] = new_z[0];
  }
};
// refused: alpha is written beside birkhoffian and one_form, structure and covector, or a canonical energy
struct AlphaWithoutStructure {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
  template <class T>
  void alpha(const T& /*t*/, const T& /*t0*/, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    w_hat[0] = new_z[0] - old_z[0];
    w[0] = new_z[0];
  }
};
// refused: this system has no vector field; expected one of field, kinetic and potential, hamiltonian,
struct NoField {
  static constexpr int dimension = 2;
};

const SystemDescriptor descriptor{.name = "refused", .title = "", .reference = ""};
const auto models = {
    make_model(descriptor, KineticWithoutTime{}),   make_model(descriptor, FieldNotConst{}),
    make_model(descriptor, HamiltonianOfDoubles{}), make_model(descriptor, InvariantsReturned{}),
    make_model(descriptor, NoPotential{}),          make_model(descriptor, NoOneForm{}),
    make_model(descriptor, StructureAlone{}),       make_model(descriptor, BothForms{}),
    make_model(descriptor, ForceAlone{}),           make_model(descriptor, NoField{}),
    make_model(descriptor, AlphaOfOneTime{}),       make_model(descriptor, AlphaWithoutStructure{})};
}  // namespace
