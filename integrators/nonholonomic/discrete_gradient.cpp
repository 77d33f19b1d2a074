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
  std::string form = "automatic", gradient = "gonzalez";
  int nodes = 4;  // of mean values
  bool compensated = true;
  std::array<Quad, 1> lengths{Quad(1)};  // of the change of the state, in units of the step

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&BothForms::form, "form", {"automatic", "kernel", "multipliers"},
                      "coordinates of the kernel of A, or multipliers in the phase space; automatic: the "
                      "kernel where the system has such coordinates"),
            parameter(&BothForms::gradient, "gradient", {"gonzalez", "mean-value"},
                      "discrete gradient of the energy, exact for any energy or a mean value along the step"),
            parameter(&BothForms::nodes, "nodes", "", 1, 20, "of Gauss's rule, with gradient=mean-value"),
            parameter(&BothForms::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> all{{{"form", "automatic"}},
                                 {{"form", "multipliers"}},
                                 {{"form", "multipliers"}, {"gradient", "mean-value"}}};
    if (full) all.push_back({{"gradient", "mean-value"}});
    return all;
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    const std::string reason = form == "kernel" ? no_kernel_coordinates(model) : std::string();
    return reason.empty() ? reason : reason + ": take form=multipliers";
  }

  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> kept{Claim::symmetric, Claim::reversible, Claim::velocity_constraints};
    // The multipliers' mean values at the middle of a step are those of constraints that do not move.
    const bool moving = !in_kernel(model) && !model.tape(Formula::velocity_constraints)->autonomous();
    if (means() == 0 || (means_are_exact(model) && !moving)) kept.push_back(Claim::energy);
    return kept;
  }

  template <class P>
  struct Work {
    std::optional<KernelDiscreteGradient::Work<P>> kernel;
    std::optional<MultiplierDiscreteGradient::Work<P>> multipliers;
    Work(const BothForms& method, const P& p) {
      if (method.in_kernel(*p.model())) {
        kernel.emplace(KernelDiscreteGradient{.length = method.lengths[0], .nodes = method.means()}, p);
      } else {
        multipliers.emplace(MultiplierDiscreteGradient{.length = method.lengths[0], .nodes = method.means()},
                            p);
      }
    }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if (w.kernel) return KernelDiscreteGradient{.compensated = compensated}.step(p, t, h, z, *w.kernel);
    return MultiplierDiscreteGradient{.compensated = compensated}.step(p, t, h, z, *w.multipliers);
  }

 private:
  [[nodiscard]] int means() const { return gradient == "mean-value" ? nodes : 0; }
  [[nodiscard]] bool in_kernel(const Model& model) const {
    return form != "multipliers" && no_kernel_coordinates(model).empty();
  }
  // Are the mean values exact of all that the form takes them of?
  [[nodiscard]] bool means_are_exact(const Model& model) const {
    if (!in_kernel(model))
      return mean_value_is_exact(*model.tape(Formula::hamiltonian), nodes) &&
             mean_value_is_exact(*model.tape(Formula::constraints), nodes);
    return mean_value_is_exact(*kernel_coordinates(model)->energy, nodes);
  }
};

// It is not offered to compositions. On gyroscopic-contact-oscillator single sub-steps of theirs and their
// reverses miss the start by up to 4e-13 in double, where those of dla miss it by 2e-15, and by 4e-31 in
// quad: it is the round-off of a step, which is larger than that of other methods.
const Method<BothForms> registered{
    {.name = "nonholonomic-discrete-gradient",
     .title = "discrete gradient methods for velocity constraints, which keep the energy",
     .family = "nonholonomic",
     .reference = "celledoni-farre-hoiseth-martin2019; gonzalez1996; quispel-mclaren2008",
     .description =
         "Discrete gradient methods for velocity constraints, symmetric and of order 2, that keep any energy "
         "H(q, p) and the constraints to round-off. Take one where the energy must not be lost in steps that "
         "are large, or along chaotic motion. Steps are implicit in all states and cost about twice those of "
         "`dla`; where constraints do work (b is not 0), energies are not kept by the motion either. With "
         "gradient=mean-value, energies are kept to round-off where they are polynomials in the coordinates "
         "of "
         "the form, and to the error of the quadrature elsewhere.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::energy, Claim::velocity_constraints}}};
}  // namespace
