// Formulas that the compiler must refuse, because of what they do with values. Each comment `refused alone:`
// is the beginning of a message it must give, and there must be no other.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// What is sound of them.
struct Mass {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
};
// refused alone: a formula compares no values, which are not known when it is recorded: expected select(x -
// y, a, b)
struct WallByLess : Mass {
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] < 0 ? -q[0] : q[0];
  }
};
// refused alone: a formula compares no values, which are not known when it is recorded: expected select(x -
// y, a, b)
struct WallByEquality : Mass {
  Real wall = 1;
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] == wall ? q[0] : q[0] * q[0];
  }
};
// refused alone: the constants of a formula are Reals and ints, exact in every precision: expected a member
// of the
struct HalfInDouble : Mass {
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return 0.5 * q[0] * q[0];
  }
};
// refused alone: parameter: expected a member of the type Real, such as Real nu = 0.3_r, and not a double
struct StiffnessInDouble : Mass {
  double stiffness = 0.3;
  static std::vector<Parameter> parameters() {
    return {parameter(&StiffnessInDouble::stiffness, "stiffness", "1/s^2", 0, 10, "of the spring")};
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};

template <class S>
const System<S> registered{{.name = "refused", .title = "", .reference = ""}};
const SystemPlugin* const all[] = {&registered<WallByLess>, &registered<WallByEquality>,
                                   &registered<HalfInDouble>, &registered<StiffnessInDouble>};
}  // namespace
