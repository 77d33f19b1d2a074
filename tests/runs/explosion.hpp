// A motion that leaves every bound: x' = x^2 from x = 1 is 1/(1 - t).
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::testing {

struct Explosion {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0] * z[0];
  }
};

inline std::shared_ptr<const Model> explosion() {
  return make_model(
      {.name = "explosion", .title = "", .reference = "", .coordinates = {{"x", ""}}, .initial = {1}},
      Explosion{});
}

}  // namespace pfaff::testing
