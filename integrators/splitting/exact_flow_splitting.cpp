// Splittings of systems whose field is a sum of parts that are solved exactly: a step is a sequence of flows
// of the parts, for lengths in units of the step.
//
// Of two parts, A and the perturbation B, the lengths are those of a scheme (near_integrable_schemes.hpp). Of
// more parts there is the scheme strang: half steps of all parts but the perturbation in their order, a step
// of the perturbation, and the half steps in the opposite order. Each flow keeps the structure of the system,
// and so does a step; for planets strang is the map of wisdom-holman1991. The corrected schemes are
// processed: over many steps in a row they cost what strang does.
#include <algorithm>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/method_alias.hpp>
#include <pfaff/integrators/splitting/near_integrable_schemes.hpp>

namespace {
using namespace pfaff;

struct ExactFlowSplitting {
  static constexpr bool fixed_sizes = false;
  std::string scheme = "strang";
  bool compensated = true;
  std::vector<std::size_t> parts;  // of the scheme: 0 for A, 1 for B
  std::vector<Quad> lengths;
  std::size_t processor = 0;  // the number of flows before the kernel, and of those after it

  static std::vector<Parameter> parameters() {
    return {parameter(&ExactFlowSplitting::scheme, "scheme", near_integrable_names(),
                      "which flows, for which lengths"),
            parameter(&ExactFlowSplitting::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    for (const std::string& name :
         full ? near_integrable_names()
              : std::vector<std::string>{"strang", "aba-4-2", "aba-8-4", "aba-10-6-4", "corrected-3"})
      list.push_back({{"scheme", name}});
    return list;
  }
  void validate() {
    const NearIntegrableScheme& chosen = near_integrable_scheme(scheme);
    for (const PartialFlow& flow : chosen.flows) {
      parts.push_back(flow.part);
      lengths.push_back(flow.length);
    }
    processor = chosen.processor;
  }
  [[nodiscard]] bool processed() const { return processor > 0; }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] int order(const Model& /*model*/) const {
    return near_integrable_scheme(scheme).orders.back();
  }
  [[nodiscard]] std::vector<Claim> preserves(const Model& /*model*/) const {
    std::vector<Claim> kept{Claim::symplectic, Claim::k_symplectic, Claim::poisson};
    if (near_integrable_scheme(scheme).symmetric)
      kept.insert(kept.end(), {Claim::symmetric, Claim::reversible});
    return kept;
  }
  [[nodiscard]] std::string refuses(const Model& model) const {
    const std::size_t count = model.part_names().size();
    return scheme == "strang" || count == 2
               ? ""
               : "with scheme=" + scheme + " needs a system of two parts; " + model.name() + " has " +
                     std::to_string(count) + ", for which there is scheme=strang";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> length;
    State<P> carry, change, before, carry_before;
    Work(const ExactFlowSplitting& method, const P& p)
        : carry(p.make_state()),
          change(p.make_state()),
          before(p.make_state()),
          carry_before(p.make_state()) {
      for (const Quad& x : method.lengths) length.push_back(T(Real(x)));
    }
  };

  template <HasExactFlows P>
  Status step(const P& p, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, h, 0, parts.size(), z, w);
  }
  template <HasExactFlows P>
  Status preprocess(const P& p, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, h, 0, processor, z, w);
  }
  template <HasExactFlows P>
  Status kernel(const P& p, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, h, processor, parts.size() - processor, z, w);
  }
  template <HasExactFlows P>
  Status postprocess(const P& p, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, h, parts.size() - processor, parts.size(), z, w);
  }

 private:
  // The flows begin, ..., end - 1 of a step. Where one does not converge, z is as it was.
  template <class P>
  Status flows(const P& p, const Scalar<P>& h, std::size_t begin, std::size_t end, State<P>& z,
               Work<P>& w) const {
    std::copy(z.begin(), z.end(), w.before.begin());
    std::copy(w.carry.begin(), w.carry.end(), w.carry_before.begin());
    Status status = Status::converged;
    for (std::size_t k = begin; k < end && status == Status::converged; ++k)
      status = flow_at(p, k, w.length[k] * h, z, w);
    if (status != Status::converged) {
      std::copy(w.before.begin(), w.before.end(), z.begin());
      std::copy(w.carry_before.begin(), w.carry_before.end(), w.carry.begin());
    }
    return status;
  }
  // The flow k of a step: that of the perturbation, or those of all other parts, in the opposite order in the
  // second half of a step.
  template <class P>
  Status flow_at(const P& p, std::size_t k, const Scalar<P>& length, State<P>& z, Work<P>& w) const {
    const std::size_t count = p.parts(), small = p.perturbation();
    if (parts[k] == 1) return flow(p, small, length, z, w);
    Status status = Status::converged;
    for (std::size_t j = 0; j < count && status == Status::converged; ++j) {
      const std::size_t part = 2 * k < parts.size() ? j : count - 1 - j;
      if (part != small) status = flow(p, part, length, z, w);
    }
    return status;
  }
  template <class P>
  Status flow(const P& p, std::size_t part, const Scalar<P>& length, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const Status status =
        p.part_flow(part, length, In<T>(z.data(), z.size()), Out<T>(w.change.data(), w.change.size()));
    if (status != Status::converged) return status;
    for (std::size_t i = 0; i < z.size(); ++i) add_to(z[i], w.carry[i], w.change[i], compensated);
    return status;
  }
};

const Method<ExactFlowSplitting> splitting{
    {.name = "exact-flow-splitting",
     .title = "splittings into parts that are solved exactly: Wisdom-Holman, (8, 2), (8, 4), (10, 6, 4), "
              "correctors",
     .family = "splitting",
     .reference = "wisdom-holman1991; wisdom-holman-touma1996; mclachlan1995small; laskar-robutel2001; "
                  "blanes-casas-farres-laskar-makazaga-murua2013",
     .description =
         "Exact flows of the parts of a system in turn: explicit and symplectic. Take it where one part is "
         "small, as the pulls of planets on each other are: errors are proportional to the small part, so "
         "that steps may be a tenth of a period. The scheme strang is the map of Wisdom and Holman; "
         "aba-8-4 and aba-10-6-4 are the ones for high accuracy. The order is that at a fixed size of the "
         "small part. Close encounters, in which the small part is not small, are outside its reach."}};

const MethodAlias wisdom_holman{splitting, "wisdom-holman", {{"scheme", "strang"}}};

// The conditions of generalised order, as far as words are listed.
const KnownOrderTheory exact_flow_conditions{
    "exact-flow-splitting", [](const Assignments& parameters) {
      std::string name = ExactFlowSplitting().scheme;
      for (const auto& [key, value] : parameters)
        if (key == "scheme") name = value;
      const NearIntegrableScheme scheme = near_integrable_scheme(name);
      OrderTheory theory{"words of A and B", scheme.orders.front(), {}, {}};
      std::vector<std::size_t> parts;
      for (const PartialFlow& flow : scheme.flows) {
        parts.push_back(flow.part);
        theory.coefficients.push_back(flow.length);
        theory.sums.push_back(static_cast<int>(flow.part));
      }
      theory.conditions = [parts, orders = scheme.orders](const std::vector<Quad>& lengths) {
        std::vector<PartialFlow> flows;
        for (std::size_t k = 0; k < parts.size(); ++k) flows.push_back({parts[k], lengths[k]});
        return near_integrable_conditions(flows, orders);
      };
      return theory;
    }};
}  // namespace
