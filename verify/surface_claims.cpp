// Claims about equations that hold at the end of a step: the constraints of both levels, and those of
// velocities.
#include <pfaff/core/system.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

namespace {
// The largest value at the end of the step among some results of a formula that should all be zero, relative
// to the rounding of the step and of the formula's own terms.
template <class T>
double largest_at_end(MeasuredStep<T>& step, Formula formula, std::size_t first) {
  if (!step.end()) return no_step;
  Replay<WithRounding<T>> values(step.model()->tape(formula));
  const auto out = with_rounding<T>(values, step.t() + step.h(), *step.end(), step.scales());
  double worst = 0;
  for (std::size_t k = first; k < out.size(); ++k) {
    const double size = relative_to_rounding(out[k]);
    worst = std::isnan(size) || std::isnan(worst) ? no_step : std::max(worst, size);
  }
  return worst;
}
}  // namespace

template <class T>
double constraints_residual(MeasuredStep<T>& step) {
  return largest_at_end(step, Formula::constraints, 0);
}

template <class T>
double velocity_constraints_residual(MeasuredStep<T>& step) {
  const Model& model = *step.model();  // the constraints of velocities come last
  return largest_at_end(step, Formula::constraints,
                        model.tape(Formula::constraints)->outputs.size() -
                            model.tape(Formula::velocity_offsets)->outputs.size());
}

namespace {

// A blade at (x, y) with the direction (cos a, sin a) on a slope, all masses one. It does not slide sideways:
// A v = 0 with A = (-sin a, cos a, 0). Nothing turns it, so that its spin p_a is conserved.
struct Blade {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
    values[1] = z[5];
  }
};

}  // namespace

// The blade's exact motion is p' = -V_q + A^T lambda with lambda = A V_q - A' v. Since A A^T = 1, this makes
// d/dt (A v) = 0, on the surface and off it. Here A V_q = -sin a, and A' v = -a' (v_x cos a + v_y sin a).
std::shared_ptr<const Model> sliding_blade() {
  const auto blade = make_model(
      SystemDescriptor{.name = "sliding-blade",
                       .title = "",
                       .reference = "",
                       .initial = {0, 0, Real::fraction(1, 2), 1, Real::fraction(1, 2), Real::fraction(3, 2)},
                       .invariants = {conserved("energy", "J"), conserved_quadratic("spin", "J s")}},
      Blade());
  ModelSource source = blade->source();
  source.formulation = "exact";
  source.given[index(Formula::field)] = std::make_shared<const Tape>(
      record(6, 6, [](const Recorded&, std::span<const Recorded> z, std::span<Recorded> rate) {
        const Recorded sine = sin(z[2]), cosine = cos(z[2]);
        const Recorded multiplier = z[5] * (cosine * z[3] + sine * z[4]) - sine;
        for (std::size_t k = 0; k < 3; ++k) rate[k] = z[3 + k];
        rate[3] = -1 - sine * multiplier;
        rate[4] = cosine * multiplier;
        rate[5] = Recorded(0);
      }));
  return std::make_shared<const Model>(std::move(source));
}

template double constraints_residual(MeasuredStep<double>&);
template double constraints_residual(MeasuredStep<Quad>&);
template double velocity_constraints_residual(MeasuredStep<double>&);
template double velocity_constraints_residual(MeasuredStep<Quad>&);

}  // namespace pfaff
