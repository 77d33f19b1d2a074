// What an evaluator of holonomic constraints owes (core/facets/holonomic.hpp): identities between its
// operations and the formulas of its model, and how far they are from holding. They are for authors of
// evaluators, inside the tree or outside; the matcher of constraint_matchers.hpp puts them into a test. Those
// of velocity constraints stand in velocity_identities.hpp.
//
// Every operation is tried, the batched ones and those that only some scalars have included, because an error
// in an operation that is not tried here could stay unnoticed.
#pragma once

#include <pfaff/core/facets/conformance/dense_constraints.hpp>
#include <pfaff/core/facets/conformance/measured_identities.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

namespace detail {

/// Measures the identities of one evaluator at one point after another, and keeps the largest error of each.
template <class T>
class ConstraintConformance : public MeasuredIdentities<T> {
 public:
  ConstraintConformance(HolonomicConstraints<T>& constraints, const Model& model)
      : c_(constraints), dense_(model) {}

  /// False where sizes do not fit and nothing else can be tried.
  bool sizes() {
    note("count", c_.count() == dense_.count() ? 0 : INFINITY);
    note("degrees", c_.degrees() == dense_.degrees() ? 0 : INFINITY);
    note("pattern", c_.pattern().rows() == dense_.count() ? 0 : INFINITY);
    return c_.count() == dense_.count() && c_.degrees() == dense_.degrees() &&
           c_.pattern().rows() == dense_.count();
  }

  /// All identities; linear maps are placed by linearise at `first` and by place at `second`.
  void at(const T& t, const std::vector<T>& first, const std::vector<T>& second) {
    const std::size_t n = c_.degrees();
    place(t, first);
    In<T> q = In<T>(first).first(n), p = In<T>(first).subspan(n);
    std::vector<T> k(c_.count()), d(n);
    c_.values(t, q, k), same("values", k, dense_.residuals, size_of(dense_.by_position, q));
    c_.hidden_values(t, q, p, k), same("hidden_values", k, dense_.hidden, size_of(dense_.by_momentum, p));
    c_.velocity(t, q, p, d), same("velocity", d, dense_.velocities);
    c_.force(t, q, p, d), same("force", d, dense_.forces);
    note("linearise", c_.linearise(t, q, p) == Status::converged ? 0 : INFINITY);
    linear_maps("");
    place(t, second);
    q = In<T>(second).first(n), p = In<T>(second).subspan(n);
    note("place", c_.place(t, q, p) == Status::converged ? 0 : INFINITY);
    linear_maps(" once placed");
    same("residuals", c_.residuals(), dense_.residuals, size_of(dense_.by_position, q));
    same("hidden", c_.hidden(), dense_.hidden, size_of(dense_.by_momentum, p));
    same("hidden_rates", c_.hidden_rates(), dense_.hidden_rates,
         size_of(dense_.hidden_by_position, dense_.velocities) + size_of(dense_.by_momentum, dense_.forces));
    same("velocities", c_.velocities(), dense_.velocities);
    same("forces", c_.forces(), dense_.forces);
    map("hidden_by_position", dense_.hidden_by_position,
        [&](In<T> u, Out<T> r) { c_.hidden_by_position(u, r); });
    map("hidden_by_position_transpose", dense_.hidden_by_position.transposed(),
        [&](In<T> x, Out<T> f) { c_.hidden_by_position_transpose(x, f); });
    friction();
    fast_rates(Reactions::ideal, "rates, ideal", t, q, p);
    fast_rates(Reactions::two_level, "rates, two-level", t, q, p);
    fast_rates(Reactions::hamiltonian, "rates, hamiltonian", t, q, p);
    response(t, q, p);
  }

 private:
  using Base = MeasuredIdentities<T>;
  using Base::magnitude;
  using Base::map;
  using Base::note;
  using Base::quad;
  using Base::random;
  using Base::same;
  using Base::size_of;
  using Base::solved;

  void place(const T& t, const std::vector<T>& z) {
    dense_.place(Quad(t), {std::vector<Quad>(z.begin(), z.end())});
  }

  void linear_maps(const std::string& when) {
    Base::within(c_.pattern(), dense_.s);
    map("apply" + when, dense_.by_position, [&](In<T> u, Out<T> r) { c_.apply(u, r); });
    map("apply_transpose" + when, dense_.by_position.transposed(),
        [&](In<T> x, Out<T> f) { c_.apply_transpose(x, f); });
    map("hidden_by_momentum" + when, dense_.by_momentum,
        [&](In<T> u, Out<T> r) { c_.hidden_by_momentum(u, r); });
    map("hidden_by_momentum_transpose" + when, dense_.by_momentum.transposed(),
        [&](In<T> x, Out<T> v) { c_.hidden_by_momentum_transpose(x, v); });
    const std::vector<T> r1 = random(c_.count()), r2 = random(c_.count());
    std::vector<T> x1(c_.count()), x2(c_.count());
    c_.solve(r1, x1), solved("solve" + when, dense_.s, x1, r1);
    x1 = r1;
    c_.solve(x1, x1), solved("solve in place" + when, dense_.s, x1, r1);
    c_.solve(r1, x1, r2, x2);
    solved("solve of two" + when, dense_.s, x1, r1), solved("solve of two" + when, dense_.s, x2, r2);
  }

  void friction() {
    const std::span<const T> lambda = c_.friction();
    std::vector<T> given(lambda.begin(), lambda.end());
    if (given.empty()) given.resize(c_.degrees());  // an empty list means no friction
    same("friction", given, dense_.friction);
    // S^D may be singular: the right-hand side is in its range.
    Matrix<Quad> weighted = dense_.by_momentum;
    for (std::size_t i = 0; i < c_.count(); ++i)
      for (std::size_t a = 0; a < c_.degrees(); ++a) weighted(i, a) = weighted(i, a) * dense_.friction[a];
    const Matrix<Quad> s = weighted * dense_.by_momentum.transposed();
    note("factor_friction", c_.factor_friction() == Status::converged ? 0 : INFINITY);
    std::vector<T> r, x(c_.count());
    for (const Quad& value : s* quad(random(c_.count()))) r.push_back(static_cast<T>(value));
    c_.solve_friction(r, x);
    solved("solve_friction", s, x, r);
  }

  void fast_rates(Reactions reactions, const char* operation, const T& t, In<T> q, In<T> p) {
    ConstrainedRates<T>* const rates = c_.rates(reactions);
    if (rates == nullptr) return note(operation, 0);
    same_rates(operation, *rates, reactions, t, q, p);
  }
  bool same_rates(const char* operation, ConstrainedRates<T>& rates, Reactions reactions, const T& t, In<T> q,
                  In<T> p) {
    std::vector<T> z(2 * q.size());
    const Out<T> out(z);
    const bool converged = rates(t, q, p, out.first(q.size()), out.subspan(q.size())) == Status::converged;
    if (converged) same(operation, z, dense_.rates(reactions), 0, dense_.condition());
    if (!converged) note(operation, INFINITY);
    return converged;
  }

  // The rates that tell how the motion responds to forces, which need not be those of fast_rates.
  void response(const T& t, In<T> q, In<T> p) {
    IdealRates<T>* const rates = c_.ideal_rates();
    if (rates == nullptr) return note("respond", 0);
    if (!same_rates("ideal_rates", *rates, Reactions::ideal, t, q, p)) return note("respond", INFINITY);
    const std::vector<T> f = random(c_.degrees());
    std::vector<T> rest(f.size());
    rates->respond(f, rest);
    same("respond", rest, dense_.response(quad(f)), 0, dense_.condition());
  }

  HolonomicConstraints<T>& c_;
  DenseConstraints dense_;
};

}  // namespace detail

/// Every identity, at its worst over the samples. `constraints` are those of `model`, whose formulas they are
/// held against; scalars double and Quad.
template <class T>
std::vector<ConstraintIdentity> constraint_identities(HolonomicConstraints<T>& constraints,
                                                      const Model& model,
                                                      const ConstraintSamples& samples = {}) {
  return detail::worst_over<T>(detail::ConstraintConformance<T>(constraints, model), model, samples);
}

}  // namespace pfaff
