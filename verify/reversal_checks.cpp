// The claims of a reversal: rho is an involution, rho rho z = z, and turns the motion round, d rho X(z, t) =
// -X(rho z, -t), so that from the time 0 rho o flow_h = flow_-h o rho, also where the system is driven.
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

std::vector<Check> check_reversal(const std::string& name, const Model& motion, const Region& region) {
  std::vector<Check> checks;
  const int n = motion.dimension();
  const auto reversal = motion.tape(Formula::reversal), field = motion.tape(Formula::field);
  const auto twice = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto back = evaluate(*reversal, t, evaluate(*reversal, t, z));
    for (std::size_t k = 0; k < z.size(); ++k) out[k] = back[k] - z[k];
  });
  both(checks, name, "reversal is an involution", name, twice, with_branches_of(*twice, region));
  const auto turned = expression(n, n, [&](const Recorded& t, Arguments z, Results out) {
    const auto rate = evaluate(*field, t, z);
    const auto carried = directional_derivative(*reversal, t, Recorded(0), z, rate);
    const auto there = evaluate(*field, -t, evaluate(*reversal, t, z));
    for (std::size_t k = 0; k < z.size(); ++k) out[k] = carried[k] + there[k];
  });
  both(checks, name, "reversal turns the field", name, turned, with_branches_of(*turned, region));
  return checks;
}

namespace {

// A pendulum whose reversal is wrong in one of these ways.
enum class FalseReversal { stretched, none_at_all, friction };
struct FaultyPendulum {
  static constexpr int dimension = 2;
  FalseReversal fault;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -sin(z[0]);
    if (fault == FalseReversal::friction) rate[1] = rate[1] - z[1] * Real::fraction(1, 1000000);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reversed[0] = z[0];
    reversed[1] = fault == FalseReversal::none_at_all ? z[1] : T(-z[1]);
    if (fault == FalseReversal::stretched) reversed[1] = reversed[1] * Real::fraction(1000001, 1000000);
  }
};

}  // namespace

std::vector<Check> check_false_reversals() {
  std::vector<Check> controls;
  const auto control = [&](const char* what, FalseReversal fault, const std::string& claim) {
    const auto model = make_model(SystemDescriptor{.name = "faulty-pendulum",
                                                   .title = "",
                                                   .reference = "",
                                                   .initial = {Real(1), Real::fraction(1, 2)}},
                                  FaultyPendulum{fault});
    add_controls(controls, what, claim, check_reversal("faulty-pendulum", *model, model->initial()),
                 [&](const Check& check) { return check.claim == claim && check.precision == "quad"; });
  };
  control("momenta reversed and stretched by 1e-6", FalseReversal::stretched, "reversal is an involution");
  control("momenta reversed and stretched by 1e-6", FalseReversal::stretched, "reversal turns the field");
  control("the identity as a reversal", FalseReversal::none_at_all, "reversal turns the field");
  control("momenta reversed beside friction of 1e-6", FalseReversal::friction, "reversal turns the field");
  return controls;
}

}  // namespace pfaff
