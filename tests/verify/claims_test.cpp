// Verification of methods and formulations with false claims: each false claim is found, and the same plug-in
// passes with true ones.
#include <gtest/gtest.h>

#include <algorithm>

#include <pfaff/core/integrator.hpp>
#include <pfaff/verify/formulation_checks.hpp>
#include <pfaff/verify/random_constraints.hpp>

namespace {
using namespace pfaff;

struct Euler {
  template <class P>
  struct Work {
    State<P> slope;
    Work(const Euler& /*method*/, const P& p) : slope(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.slope[k];
    return Status::converged;
  }
};

Check order_check(const MethodPlugin& method) {
  for (Check& check : check_method(method, {}, systems().get("pendulum", "system")))
    if (check.claim == "order") return check;
  return {};
}

TEST(FalseClaims, AMethodWithoutAPositiveOrderFails) {
  static const Method<Euler> without{
      {.name = "euler-without-order", .title = "", .reference = "", .preserves = {Claim::none}}};
  const Check check = order_check(without);
  EXPECT_EQ(check.result, CheckResult::fail);
  EXPECT_NE(check.reason.find("not positive"), std::string::npos) << check.reason;
  static const Method<Euler> with{
      {.name = "euler-with-order", .title = "", .reference = "", .order = 1, .preserves = {Claim::none}}};
  EXPECT_EQ(order_check(with).result, CheckResult::pass);
}

// Heun's method, of order 2, to be registered with other orders.
struct Heun {
  template <class P>
  struct Work {
    State<P> slope, end, end_slope;
    Work(const Heun& /*method*/, const P& p)
        : slope(p.make_state()), end(p.make_state()), end_slope(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.slope);
    for (std::size_t k = 0; k < z.size(); ++k) w.end[k] = z[k] + h * w.slope[k];
    p.field(t + h, w.end, w.end_slope);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * (w.slope[k] + w.end_slope[k]) / Scalar<P>(2);
    return Status::converged;
  }
};

// An order is a lower bound: symmetries of a system add to it, and whoever claims less than is true claims
// nothing false.
TEST(FalseClaims, AnOrderMayBeExceededAndNotMissed) {
  static const Method<Heun> less{
      {.name = "heun-at-least-1", .title = "", .reference = "", .order = 1, .preserves = {Claim::none}}};
  EXPECT_EQ(order_check(less).result, CheckResult::pass);
  EXPECT_NEAR(order_check(less).measured, 2, 0.1);
  static const Method<Heun> more{
      {.name = "heun-of-order-3", .title = "", .reference = "", .order = 3, .preserves = {Claim::none}}};
  EXPECT_EQ(order_check(more).result, CheckResult::fail);
}

// Lagrange's multipliers, with reactions of another size.
struct Multipliers {
  Real size = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&Multipliers::size, "size", "", -10, 10, "of the reactions")};
  }
  template <class T>
  struct Work {
    Work(const Multipliers& /*formulation*/, HolonomicConstraints<T>& constraints)
        : multipliers(constraints.count()) {}
    std::vector<T> multipliers;
  };
  template <class T>
  Status field(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
               Out<T> p_rate, Work<T>& w) const {
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.hidden_rates(), w.multipliers);
    constraints.apply_transpose(w.multipliers, p_rate);
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = constraints.velocities()[k];
      p_rate[k] = constraints.forces()[k] - T(size) * p_rate[k];
    }
    return status;
  }
};

// The claims that are not as they should be, by name: false ones, or controls that were not rejected.
std::vector<std::string> bad_claims_of(const FormulationPlugin& plugin, const Assignments& parameters,
                                       const std::shared_ptr<const Model>& model, bool controls) {
  std::vector<std::string> names;
  for (const Check& check : check_formulation(plugin, parameters, model))
    if (check.control == controls && !good(check) &&
        std::find(names.begin(), names.end(), check.claim) == names.end())
      names.push_back(check.claim);
  std::sort(names.begin(), names.end());
  return names;
}

TEST(FalseClaims, FormulationsAreHeldAgainstTheirDefinition) {
  using Names = std::vector<std::string>;
  using FC = FormulationClaim;
  static const Formulation<Multipliers> honest{{.name = "multipliers",
                                                .title = "",
                                                .reference = "",
                                                .reactions = Reactions::ideal,
                                                .keeps = {FC::tangent, FC::hidden_constraints}}};
  static const Formulation<Multipliers> boastful{
      {.name = "boastful-multipliers",
       .title = "",
       .reference = "",
       .reactions = Reactions::hamiltonian,
       .keeps = {FC::tangent, FC::hidden_constraints, FC::constraints, FC::energy}}};
  std::vector<std::shared_ptr<const Model>> models{random_rods()};
  for (const char* name : {"spherical-pendulum", "shaken-pendulum", "polar-double-pendulum", "four-bar"})
    models.push_back(systems().get(name, "system").make({}));
  for (const auto& model : random_constraints())
    if (model->facets().has(Facet::holonomic)) models.push_back(model);
  for (const auto& model : models) {
    SCOPED_TRACE(model->name());
    EXPECT_EQ(bad_claims_of(honest, {}, model, false), Names{});
    EXPECT_EQ(bad_claims_of(honest, {}, model, true), Names{});
    // A wrong sign, and a size that is wrong by a millionth.
    for (const char* size : {"-1", "1.000001"})
      EXPECT_EQ(bad_claims_of(honest, {{"size", size}}, model, false),
                (Names{"field is its definition", "keeps hidden-constraints", "tangent"}))
          << size;
    // On the surface all reactions are one: what is claimed off it is found to be false.
    Names expected{"field is its definition", "keeps constraints"};
    if (model->tape(Formula::constraints)->autonomous() && !model->forced())
      expected.emplace_back("keeps energy");
    EXPECT_EQ(bad_claims_of(boastful, {}, model, false), expected);
  }
}

}  // namespace
