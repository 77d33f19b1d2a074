#include <pfaff/verify/skated_models.hpp>

#include <pfaff/core/system.hpp>

namespace pfaff {

namespace {

// H = (p^T D p + (u.p)^2)/2 + c.p + V with D constant, u and c functions of the positions. The two rows of A
// are independent near the initial state.
struct TwoBlades {
  static constexpr int dimension = 10, velocity_constraint_count = 2;
  static std::vector<Parameter> parameters() { return {}; }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const In<T> q = z.first(5), p = z.subspan(5);
    const T along = p[0] * sin(q[2]) - p[1] * cos(q[2]) + p[3] / 2 + p[4] * q[0];
    T sum = along * along / 2 + p[1] * q[3] / 3 - p[4] * cos(q[1]) / 4;
    for (std::size_t k = 0; k < 5; ++k) sum = sum + p[k] * p[k] / (2 + static_cast<int>(k));
    return sum + cos(q[0]) * q[4] + q[3] * q[3] * q[1] / 2 + q[2];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[4] = q[3] * q[0];
    rows[5] = T(1);
    rows[7] = q[1];
    rows[8] = 2 + sin(q[4]);
  }
};
struct TwoMovingBlades : TwoBlades {
  static constexpr int constraint_count = 1;
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    phi[0] = q[3] * q[3] + q[4] * q[4] - 1 - t * t / 8;
  }
  template <class T>
  void velocity_constraints(const T& t, In<T> q, Out<T> rows) const {
    TwoBlades::velocity_constraints(t, q, rows);
    rows[9] = t * q[2];
  }
  template <class T>
  void velocity_offsets(const T& t, In<T> q, Out<T> b) const {
    b[0] = t * cos(q[2]);
    b[1] = q[0] - t * t * q[1];
  }
};

SystemDescriptor blades(const char* name) {
  const auto part = [](std::int64_t n) { return Real::fraction(n, 10); };
  return {.name = name,
          .title = "",
          .reference = "",
          .initial = {part(3), part(-4), part(7), part(6), part(8), part(5), part(-2), part(4), part(3), 1}};
}

}  // namespace

std::shared_ptr<const Model> two_blades(bool moving) {
  return moving ? make_model(blades("two moving blades"), TwoMovingBlades{})
                : make_model(blades("two blades"), TwoBlades{});
}

std::vector<std::shared_ptr<const Model>> skated_models() { return {two_blades(false), two_blades(true)}; }

}  // namespace pfaff
