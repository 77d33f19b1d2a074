// Tables of the kind "composition": `weights` gamma_i of a composition S(gamma_s h) ... S(gamma_1 h) of a
// symmetric method S of order 2, and its `base`, the name of a registered method such as "verlet", with
// parameters where they are wanted, "verlet(compensated=no)". Where there is a list `pre` of more weights, a
// step is pre, the weights and the inverse of pre, and n steps in a row take pre and its inverse once.
#include <algorithm>

#include <pfaff/integrators/composition/bases.hpp>
#include <pfaff/integrators/composition/composed_instance.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace {
using namespace pfaff;

class CompositionTable final : public MethodTable {
 public:
  CompositionTable(MethodDescriptor descriptor, const TableDocument& document, OrderTheory theory,
                   PluginValue base, std::size_t processor)
      : MethodTable(std::move(descriptor), {}, typeid(CompositionTable), document, std::move(theory)),
        base_(std::move(base)),
        processor_(processor),
        palindrome_(symmetric(weights())) {}

  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    assign_all(parameters(), nullptr, assignments, "integrator " + name());
    auto base = integrators().get(base_.name, "integrator").make(base_.settings);
    return std::make_unique<ComposedInstance>(ComposedStatement{.plugin = this,
                                                                .parameters = {},
                                                                .called = name(),
                                                                .order = descriptor().order,
                                                                .palindrome = palindrome_},
                                              base->composed(weights(), processor_));
  }
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const override { return {{}}; }
  [[nodiscard]] std::vector<std::pair<const Plugin*, Assignments>> rests_on() const override {
    return {{&integrators().get(base_.name, "integrator"), base_.settings}};
  }

 private:
  [[nodiscard]] const std::vector<Quad>& weights() const { return theory().coefficients; }
  static bool symmetric(const std::vector<Quad>& weights) {
    return std::equal(weights.begin(), weights.end(), weights.rbegin());
  }

  PluginValue base_;
  std::size_t processor_;
  bool palindrome_;
};

// The base, with its parameters looked at.
PluginValue read_base(TableDocument& document) {
  PluginValue base = parse_plugin_value(document.required_text("base"), document.path() + ": key 'base'");
  const MethodPlugin& plugin = integrators().get(base.name, "integrator");
  const std::string reason = unfit_as_base(plugin, *plugin.make(base.settings));
  if (!reason.empty()) document.refuse("base", base.name + " cannot be composed: " + reason);
  return base;
}

std::unique_ptr<const MethodTable> read_composition_table(TableDocument& document, TableHead head) {
  PluginValue base = read_base(document);
  const std::vector<Quad> kernel = document.numbers("weights"),
                          pre = document.has("pre") ? document.numbers("pre") : std::vector<Quad>();
  head.descriptor.family = "splitting";
  const int order = head.descriptor.order;
  if (order > largest_degree)
    document.refuse("order", "expected at most " + std::to_string(largest_degree) +
                                 ", the degree up to which words are listed");
  if (document.has("preserves"))
    document.refuse("preserves", "follows from the base; expected no such key in a composition");
  document.finish();
  const std::vector<Quad> weights = processed_weights(pre, kernel);
  const auto conditions = composition_conditions(weights, std::min(order + 1, largest_degree));
  if (!pre.empty() && first_violated(conditions, order, head.precision) != nullptr)
    require_effective_order(document, head, "weights", effective_composition_conditions(kernel, order));
  require_order(document, head, conditions);
  OrderTheory theory{"words", order, weights, {}, head.precision};
  theory.conditions = [order](const std::vector<Quad>& others) {
    return composition_conditions(others, order);
  };
  theory.next_order = 3;
  return std::make_unique<CompositionTable>(head.descriptor, document, std::move(theory), std::move(base),
                                            pre.size());
}

const TableKind<> composition_kind{{"composition"}, read_composition_table};
}  // namespace
