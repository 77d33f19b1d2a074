// A system whose name, or whose parameter, cannot be written on a command line: NAME and PARAMETER say which.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Misnamed {
  static constexpr int dimension = 2;
  Real rate_ = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&Misnamed::rate_, PARAMETER, "1/s", 0, 1, "a rate")};
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = rate_ * z[1];
    rate[1] = -z[0];
  }
};

const System<Misnamed> registered{{.name = NAME,
                                   .title = "an oscillator",
                                   .reference = "su-qin (6)",
                                   .coordinates = {{"q", "m"}, {"p", "kg m/s"}},
                                   .initial = {1, 0}}};
}  // namespace
