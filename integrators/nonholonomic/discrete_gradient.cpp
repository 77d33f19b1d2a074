// Discrete gradient methods for velocity constraints as a plug-in: in coordinates of the kernel of A where
// the system has them, and with multipliers in the phase space elsewhere.
#include <array>
#include <optional>
#include <span>
#include <string>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/nonholonomic/kernel_gradient.hpp>
#include <pfaff/integrators/nonholonomic/multiplier_gradient.hpp>

namespace {
using namespace pfaff;

struct BothForms {
  std::string form = "automatic";
  bool compensated = true;
  std::array<Quad, 1> lengths{Quad(1)};  // of the change of the state, in units of the step

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&BothForms::form, "form", {"automatic", "kernel", "multipliers"},
                      "coordinates of the kernel of A, or multipliers in the phase space; automatic: the "
                      "kernel where the system has such coordinates"),
            parameter(&BothForms::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool /*full*/) {
    return {{{"form", "automatic"}}, {{"form", "multipliers"}}};
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    const std::string reason = form == "kernel" ? no_kernel_coordinates(model) : std::string();
    return reason.empty() ? reason : reason + ": take form=multipliers";
  }

  template <class P>
  struct Work {
    std::optional<KernelDiscreteGradient::Work<P>> kernel;
    std::optional<MultiplierDiscreteGradient::Work<P>> multipliers;
    Work(const BothForms& method, const P& p) {
      if (method.form != "multipliers" && no_kernel_coordinates(*p.model()).empty()) {
        kernel.emplace(KernelDiscreteGradient{.length = method.lengths[0]}, p);
      } else {
        multipliers.emplace(MultiplierDiscreteGradient{.length = method.lengths[0]}, p);
      }
    }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if (w.kernel) return KernelDiscreteGradient{.compensated = compensated}.step(p, t, h, z, *w.kernel);
    return MultiplierDiscreteGradient{.compensated = compensated}.step(p, t, h, z, *w.multipliers);
  }
};

// It is not offered to compositions. On gyroscopic-contact-oscillator single sub-steps of theirs and their
// reverses miss the start by up to 4e-13 in double, where those of dla miss it by 2e-15, and by 4e-31 in
// quad: it is the round-off of a step, which is larger than that of other methods.
const Method<BothForms> registered{
    {.name = "nonholonomic-discrete-gradient",
     .title = "discrete gradient methods for velocity constraints, which keep the energy",
     .reference = "celledoni-farre-hoiseth-martin2019; gonzalez1996",
     .description =
         "Discrete gradient methods for velocity constraints, symmetric and of order 2, that keep any energy "
         "H(q, p) and the constraints to round-off. Take one where the energy must not be lost in steps that "
         "are large, or along chaotic motion. Steps are implicit in all states and cost two or three times "
         "those of `dla`; where constraints do work (b is not 0), energies are not kept by the motion "
         "either.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::energy, Claim::velocity_constraints}}};
}  // namespace
