// Gauss collocation methods of any number of stages, and the implicit midpoint rule (one stage).
//
//   Z_i = h sum_j a_ij X(z + Z_j, t + c_j h),   z' = z + h sum_i b_i X(z + Z_i, t + c_i h)
//
// Order 2 s, symmetric, symplectic for constant K, keeps quadratic invariants (hairer-lubich-wanner2006
// II.1.3, IV.2.1, VI.4.2). Not K-symplectic for z- or t-dependent K in the variables z. The implicit midpoint
// rule is the "Euler centre" scheme of su-qin (107).
//
// Where the energy is T(p) + V(q, t) with T quadratic, the same steps are made in Nystroem's form, with half
// the unknowns and half the iterations (nystrom_form.hpp). Otherwise the rates h b_j X are iterated as they
// are (first_order_form.hpp). Either way they are known to round-off and belong to the stages that they make,
// coefficients keep symplecticity to the last bit, and updates are compensated: what rounding does to
// conserved quantities then has no trend.
//
// On the registered path there are copies of a form for some numbers of stages and sizes that the compiler
// knows. They make the same steps, bit for bit, as the form for any.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/runge_kutta/first_order_form.hpp>
#include <pfaff/integrators/runge_kutta/formula_in_lanes.hpp>
#include <pfaff/integrators/runge_kutta/nystrom_form.hpp>

namespace pfaff {

namespace detail {

/// The form for the number of stages and the size of a problem. For registered problems there are copies of
/// the code for the numbers of stages that are used most and, in the form of second order and at high order,
/// for two degrees of freedom.
template <template <class, int, int> class Form, int Stages, class P, class... Arguments>
std::unique_ptr<CollocationForm<P>> sized_form(const CollocationCoefficients<Value<Scalar<P>>>& c, const P& p,
                                               const Arguments&... arguments) {
  using Made = std::unique_ptr<CollocationForm<P>>;
  const auto made = [&]<int S, int N>() -> Made {
    return std::make_unique<Form<P, S, N>>(c, p, arguments...);
  };
  if constexpr (Stages == dynamic && P::extent == dynamic && asked_in_lanes<P, Pack<8>>()) {
    if constexpr (sizeof...(Arguments) != 0)
      if (p.size() == 4) {
        if (c.stages == 6) return made.template operator()<6, 4>();
        if (c.stages == 8) return made.template operator()<8, 4>();
        if (c.stages == 12) return made.template operator()<12, 4>();
      }
    switch (c.stages) {
      case 2:
        return made.template operator()<2, dynamic>();
      case 3:
        return made.template operator()<3, dynamic>();
      case 4:
        return made.template operator()<4, dynamic>();
      case 6:
        return made.template operator()<6, dynamic>();
      case 8:
        return made.template operator()<8, dynamic>();
      case 12:
        return made.template operator()<12, dynamic>();
      default:
        break;
    }
  }
  return made.template operator()<Stages, P::extent>();
}

/// The form of second order where it can be used and gains something, which it does not with one stage.
template <int Stages, class P>
std::unique_ptr<CollocationForm<P>> chosen_form(const GaussCoefficients& tableau, const P& p) {
  const CollocationCoefficients<Value<Scalar<P>>> c(tableau);
  if constexpr (HasSeparable<P> && Stages != 1)
    if (const auto velocity = separable_velocity(p); velocity != nullptr && linear(*velocity))
      return sized_form<NystromForm, Stages>(c, p, *velocity);
  return sized_form<FirstOrderForm, Stages>(c, p);
}

/// The same for what registered methods step on, with any number of stages. It is compiled once, in
/// collocation_form.cpp, and not wherever a method starts with steps of collocation or is built on it.
template <class T>
std::unique_ptr<CollocationForm<Problem<T>>> registered_form(const GaussCoefficients& tableau,
                                                             const Problem<T>& p);

template <int Stages, class P>
std::unique_ptr<CollocationForm<P>> collocation_form(const GaussCoefficients& tableau, const P& p) {
  if constexpr (Stages == dynamic && std::is_same_v<P, Problem<Scalar<P>>>) {
    return registered_form<Scalar<P>>(tableau, p);
  } else {
    return chosen_form<Stages>(tableau, p);
  }
}

}  // namespace detail

/// Gauss collocation. Where the number of stages and the size of the problem are known to the compiler, the
/// size of the workspace is, too.
template <int Stages = dynamic>
struct Collocation {
  GaussCoefficients tableau;
  bool compensated = true;

  Collocation() {
    if constexpr (Stages != dynamic) tableau = gauss_coefficients(Stages);
  }

  /// The weights b: changing one breaks consistency, and b_i a_ij + b_j a_ji = b_i b_j with it.
  std::span<Quad> coefficients() { return tableau.weights; }

  template <class P>
  struct Work {
    std::unique_ptr<CollocationForm<P>> form;

    Work(const Collocation& method, const P& p) : form(detail::collocation_form<Stages>(method.tableau, p)) {}

    void restart() { form->restart(); }
    void hand_over(Work& next) { form->hand_over(*next.form); }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return w.form->step(p, t, h, z, compensated);
  }
};

/// Gauss collocation of a number of stages known at run time.
struct Gauss : Collocation<> {
  static constexpr bool fixed_sizes = false;  // forms choose what the compiler is to know
  int stages = 2;
  static std::vector<Parameter> parameters() {
    return {parameter(&Gauss::stages, "stages", "", 1, 32, "number of stages s; the order is 2 s"),
            parameter<Gauss>(static_cast<bool Gauss::*>(&Gauss::compensated), "compensated",
                             "compensated summation")};
  }
  /// Up to six stages: beyond, quad has too few digits between the first error and round-off to see a slope.
  static std::vector<Assignments> instances(bool /*full*/) {
    std::vector<Assignments> list;
    for (int s = 1; s <= 6; ++s) list.push_back({{"stages", std::to_string(s)}});
    return list;
  }
  void validate() { tableau = gauss_coefficients(stages); }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * stages; }
};

/// Gauss collocation with one stage.
struct ImplicitMidpoint : Collocation<1> {
  static std::vector<Parameter> parameters() {
    return {parameter<ImplicitMidpoint>(static_cast<bool ImplicitMidpoint::*>(&ImplicitMidpoint::compensated),
                                        "compensated", "compensated summation")};
  }
};

}  // namespace pfaff
