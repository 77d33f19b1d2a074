// A system whose structure K = (dy + dv/2) ^ dx is degenerate everywhere: along u and along v - y/2.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Degenerate {
  static constexpr int dimension = 4;
  static std::vector<Parameter> parameters() { return {}; }
  template <class T>
  void structure(const T& /*t*/, In<T> /*z*/, Out<T> K) const {
    K[1] = T(-1);
    K[4] = T(1);
    K[3] = T(-1) / 2;
    K[12] = T(1) / 2;
  }
  template <class T>
  void covector(const T& /*t*/, In<T> z, Out<T> D) const {
    D[0] = -z[0];
  }
};

const System<Degenerate> registered{{.name = "degenerate",
                                     .title = "a degenerate structure",
                                     .reference = "su-qin (6)",
                                     .coordinates = {{"x", ""}, {"y", ""}, {"u", ""}, {"v", ""}},
                                     .initial = {1, 1, 1, 1}}};
}  // namespace
