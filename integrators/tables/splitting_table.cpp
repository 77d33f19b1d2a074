// Tables of the kinds "splitting", "rkn-splitting" and "processed", for H = T(p, t) + V(q, t).
//
// - splitting: the lists `drift` and `kick` of lengths in units of the step, of which `first` (drift or kick)
//   says which acts first; they act in turn.
// - rkn-splitting: the same for energies T(p) quadratic in p, for which fewer order conditions are needed.
//   Some of these are left out because T has no third derivative, which is not true of a T that depends on
//   time: the kicks advance its time (splitting.hpp).
// - processed: the tables `kernel` and `pre`, each with lists `drift` and `kick` and with `first`; a step is
//   pre, kernel and the inverse of pre, and n steps in a row are pre, n kernels and the inverse of pre.
//   `parts = "quadratic-kinetic"` asks for the conditions of rkn-splitting.
//
// Drifts advance the time of V and kicks that of T. Splittings are symplectic whatever their numbers are, and
// symmetric where they read the same from both ends.
#include <algorithm>
#include <array>

#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace {
using namespace pfaff;

constexpr std::size_t drift = 0, kick = 1;

/// Drifts and kicks in any order.
struct SplittingTable {
  static constexpr bool fixed_sizes = false;
  std::vector<std::size_t> parts;  // drift or kick
  std::vector<Quad> lengths;
  std::size_t processor = 0;  // the number of flows before the kernel, and of those after it
  bool quadratic_kinetic = false;
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&SplittingTable::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (!quadratic_kinetic) return "";
    if (!quadratic_in_momenta(model))
      return "is of its order for kinetic energies that are quadratic in the momenta only";
    return steady_kinetic_energy(model) ? ""
                                        : "is of its order for kinetic energies that do not depend on time "
                                          "only";
  }

  [[nodiscard]] bool processed() const { return processor > 0; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> length;
    T drifted, kicked;  // by the processor: how far the times of V and of T are ahead, in units of the step
    State<P> carry, slope;
    Work(const SplittingTable& method, const P& p) : carry(p.make_state()), slope(p.make_state()) {
      for (const Quad& x : method.lengths) length.push_back(T(Real(x)));
      std::array<Quad, 2> sums{};
      for (std::size_t k = 0; k < method.processor; ++k) sums[method.parts[k]] += method.lengths[k];
      drifted = T(Real(sums[drift]));
      kicked = T(Real(sums[kick]));
    }
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, t, t, h, 0, parts.size(), z, w);
  }
  template <HasSeparable P>
  Status preprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, t, t, h, 0, processor, z, w);
  }
  template <HasSeparable P>
  Status kernel(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, t + w.drifted * h, t + w.kicked * h, h, processor, parts.size() - processor, z, w);
  }
  template <HasSeparable P>
  Status postprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    return flows(p, t + w.drifted * h, t + w.kicked * h, h, parts.size() - processor, parts.size(), z, w);
  }

 private:
  // The flows begin, ..., end - 1 of a step, from the times that those before them have reached.
  template <class P>
  Status flows(const P& p, Scalar<P> drifted, Scalar<P> kicked, const Scalar<P>& h, std::size_t begin,
               std::size_t end, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t half = z.size() / 2;
    const Out<T> q(z.data(), half), momentum(z.data() + half, half), slope(w.slope.data(), half);
    for (std::size_t k = begin; k < end; ++k) {
      const T length = w.length[k] * h;
      const std::size_t offset = parts[k] == drift ? 0 : half;
      if (parts[k] == drift) {
        p.velocity(kicked, momentum, slope);
        drifted = drifted + length;
      } else {
        p.force(drifted, q, slope);
        kicked = kicked + length;
      }
      for (std::size_t i = 0; i < half; ++i)
        add_to(z[offset + i], w.carry[offset + i], length * slope[i], compensated);
    }
    return Status::converged;
  }
};

// The flows of the lists under `prefix`.
std::vector<PartialFlow> read_flows(TableDocument& document, const std::string& prefix) {
  const std::string first = document.text(prefix + "first", "drift");
  if (first != "drift" && first != "kick")
    document.refuse(prefix + "first", unknown_name("part", first, {"drift", "kick"}));
  const std::vector<Quad> drifts = document.numbers(prefix + "drift"),
                          kicks = document.numbers(prefix + "kick");
  const std::size_t leading = first == "drift" ? drift : kick;
  const auto& [longer, shorter] = leading == drift ? std::tie(drifts, kicks) : std::tie(kicks, drifts);
  if (longer.size() != shorter.size() && longer.size() != shorter.size() + 1)
    document.refuse(prefix + (leading == drift ? "kick" : "drift"),
                    "expected " + std::to_string(longer.size()) +
                        " numbers or one less, as many as there are " + first + "s, which act first; got " +
                        std::to_string(shorter.size()));
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k < longer.size(); ++k) {
    flows.push_back({leading, longer[k]});
    if (k < shorter.size()) flows.push_back({1 - leading, shorter[k]});
  }
  return flows;
}

bool palindrome(const std::vector<PartialFlow>& flows, const Quad& precision) {
  for (std::size_t k = 0; k < flows.size(); ++k) {
    const PartialFlow &a = flows[k], &b = flows[flows.size() - 1 - k];
    if (a.part != b.part || !(abs(a.length - b.length) <= precision * std::max(Quad(1), abs(a.length))))
      return false;
  }
  return true;
}

// The flows of a step and what is known of the parts.
struct Step {
  std::vector<PartialFlow> flows;
  std::size_t processor = 0;  // the number of flows before the kernel, and of those after it
  Parts parts = Parts::general;
};

Step read_step(TableDocument& document) {
  Step step;
  const std::string kind = document.required_text("kind");
  if (kind != "processed") {
    step.flows = read_flows(document, "");
    if (kind == "rkn-splitting") step.parts = Parts::quadratic_kinetic;
    return step;
  }
  const std::string parts = document.text("parts", "general");
  if (parts == "quadratic-kinetic") {
    step.parts = Parts::quadratic_kinetic;
  } else if (parts != "general") {
    document.refuse("parts", unknown_name("kind of parts", parts, {"general", "quadratic-kinetic"}));
  }
  const std::vector<PartialFlow> pre = read_flows(document, "pre.");
  step.processor = pre.size();
  step.flows = processed_step(pre, read_flows(document, "kernel."));
  return step;
}

std::unique_ptr<const MethodTable> read_splitting_table(TableDocument& document, TableHead head) {
  const Step step = read_step(document);
  head.descriptor.family = "splitting";
  const int order = head.descriptor.order;
  if (order > largest_degree)
    document.refuse("order", "expected at most " + std::to_string(largest_degree) +
                                 ", the degree up to which words are listed");
  std::vector<Claim> kept{Claim::symplectic};
  if (palindrome(step.flows, head.precision)) kept.insert(kept.end(), {Claim::symmetric, Claim::reversible});
  head.descriptor.preserves = kept_claims(document, kept, [](Claim claim) {
    return claim == Claim::symmetric || claim == Claim::reversible
               ? "the flows of a step do not read the same from both ends"
               : "splittings are not tested for it";
  });
  document.finish();
  const auto conditions = splitting_conditions(step.flows, std::min(order + 1, largest_degree), step.parts);
  if (document.has("kernel") && first_violated(conditions, order, head.precision) != nullptr)
    require_effective_order(document, head, "kernel",
                            effective_conditions(read_flows(document, "kernel."), order, step.parts));
  require_order(document, head, conditions);

  SplittingTable method;
  for (const PartialFlow& flow : step.flows) {
    method.parts.push_back(flow.part);
    method.lengths.push_back(flow.length);
  }
  method.processor = step.processor;
  method.quadratic_kinetic = step.parts == Parts::quadratic_kinetic;
  OrderTheory theory{"words", order, method.lengths, {}, head.precision};
  for (const std::size_t part : method.parts) theory.sums.push_back(static_cast<int>(part));
  theory.conditions = [parts = method.parts, order, known = step.parts](const std::vector<Quad>& lengths) {
    std::vector<PartialFlow> flows;
    for (std::size_t k = 0; k < parts.size(); ++k) flows.push_back({parts[k], lengths[k]});
    return splitting_conditions(flows, order, known);
  };
  return std::make_unique<TableOf<SplittingTable>>(head.descriptor, document, std::move(theory),
                                                   std::move(method));
}

const TableKind<SplittingTable> splitting_kind{{"splitting", "rkn-splitting", "processed"},
                                               read_splitting_table};
}  // namespace
