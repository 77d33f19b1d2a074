// A plug-in of which two builds are made that differ in one number.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Spring {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] * SPRING_STIFFNESS / 2;
  }
};

const System<Spring> registered{{.name = "test-spring",
                                 .title = "a spring",
                                 .reference = "su-qin",
                                 .description = "A spring of unit mass. It is there to be tested.",
                                 .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                 .initial = {1, 0}}};
}  // namespace
