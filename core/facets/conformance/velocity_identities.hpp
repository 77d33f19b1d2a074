// What an evaluator of velocity constraints owes (core/facets/velocity_constraints.hpp): identities between
// its operations and the formulas of its model, and how far they are from holding. Every operation is tried.
// The matcher of constraint_matchers.hpp puts them into a test.
#pragma once

#include <pfaff/core/facets/conformance/dense_velocity_constraints.hpp>
#include <pfaff/core/facets/conformance/measured_identities.hpp>
#include <pfaff/core/facets/velocity_constraints.hpp>

namespace pfaff {

namespace detail {

/// Measures the identities of one evaluator at one point after another, and keeps the largest error of each.
template <class T>
class VelocityConformance : public MeasuredIdentities<T> {
 public:
  VelocityConformance(VelocityConstraints<T>& constraints, const Model& model)
      : c_(constraints), dense_(model) {}

  /// False where sizes do not fit and nothing else can be tried.
  bool sizes() {
    const bool count = c_.count() == dense_.count(), degrees = c_.degrees() == dense_.degrees(),
               pattern = c_.pattern().rows() == dense_.count();
    note("count", count ? 0 : INFINITY);
    note("degrees", degrees ? 0 : INFINITY);
    note("pattern", pattern ? 0 : INFINITY);
    return count && degrees && pattern;
  }

  /// All identities; linear maps are placed by linearise at `first` and by place at `second`.
  void at(const T& t, const std::vector<T>& first, const std::vector<T>& second) {
    const std::size_t n = c_.degrees();
    place(t, first);
    In<T> q = In<T>(first).first(n), p = In<T>(first).subspan(n);
    std::vector<T> k(c_.count()), d(n);
    c_.values(t, q, p, k), same("values", k, dense_.residuals, size_of_psi());
    c_.velocity(t, q, p, d), same("velocity", d, dense_.velocities);
    c_.force(t, q, p, d), same("force", d, dense_.forces);
    note("linearise", c_.linearise(t, q, p) == Status::converged ? 0 : INFINITY);
    linear_maps("");
    place(t, second);
    q = In<T>(second).first(n), p = In<T>(second).subspan(n);
    note("place", c_.place(t, q, p) == Status::converged ? 0 : INFINITY);
    linear_maps(" once placed");
    same("residuals", c_.residuals(), dense_.residuals, size_of_psi());
    same("rates", c_.rates(), dense_.rates,
         magnitude(dense_.turning) + size_of(dense_.rows, dense_.drift) +
             size_of(dense_.by_momentum, dense_.forces));
    same("velocities", c_.velocities(), dense_.velocities);
    same("forces", c_.forces(), dense_.forces);
    fast_rates(t, q, p);
  }

 private:
  using Base = MeasuredIdentities<T>;
  using Base::magnitude;
  using Base::map;
  using Base::note;
  using Base::random;
  using Base::same;
  using Base::size_of;
  using Base::solved;

  void place(const T& t, const std::vector<T>& z) {
    dense_.place(Quad(t), {std::vector<Quad>(z.begin(), z.end())});
  }
  [[nodiscard]] double size_of_psi() const {
    return size_of(dense_.rows, dense_.velocities) + magnitude(dense_.offsets);
  }

  void linear_maps(const std::string& when) {
    Base::within(c_.pattern(), dense_.s);
    map("apply" + when, dense_.rows, [&](In<T> u, Out<T> r) { c_.apply(u, r); });
    map("apply_transpose" + when, dense_.rows.transposed(),
        [&](In<T> x, Out<T> f) { c_.apply_transpose(x, f); });
    map("by_momentum" + when, dense_.by_momentum, [&](In<T> u, Out<T> r) { c_.by_momentum(u, r); });
    map("by_momentum_transpose" + when, dense_.by_momentum.transposed(),
        [&](In<T> x, Out<T> v) { c_.by_momentum_transpose(x, v); });
    const std::vector<T> r = random(c_.count());
    std::vector<T> x(c_.count());
    c_.solve(r, x), solved("solve" + when, dense_.s, x, r);
    x = r;
    c_.solve(x, x), solved("solve in place" + when, dense_.s, x, r);
  }

  void fast_rates(const T& t, In<T> q, In<T> p) {
    ConstrainedRates<T>* const rates = c_.ideal_rates();
    if (rates == nullptr) return note("ideal_rates", 0);
    std::vector<T> z(2 * q.size());
    const Out<T> out(z);
    const Status status = (*rates)(t, q, p, out.first(q.size()), out.subspan(q.size()));
    if (status != Status::converged) return note("ideal_rates", INFINITY);
    same("ideal_rates", z, dense_.nonholonomic_motion(), 0, dense_.condition());
  }

  VelocityConstraints<T>& c_;
  DenseVelocityConstraints dense_;
};

}  // namespace detail

/// Every identity, at its worst over the samples. `constraints` are those of `model`, whose formulas they are
/// held against; scalars double and Quad.
template <class T>
std::vector<ConstraintIdentity> constraint_identities(VelocityConstraints<T>& constraints, const Model& model,
                                                      const ConstraintSamples& samples = {}) {
  return detail::worst_over<T>(detail::VelocityConformance<T>(constraints, model), model, samples);
}

}  // namespace pfaff
