// Tables of the kind "composition": `weights` gamma_i of a composition S(gamma_s h) ... S(gamma_1 h) of a
// symmetric method S of order 2, and its `base`, the name of a registered method such as "verlet", with
// parameters where they are wanted, "verlet(compensated=no)".
#include <algorithm>

#include <pfaff/integrators/order_conditions/word_conditions.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace {
using namespace pfaff;

bool contains(const std::vector<Claim>& claims, Claim claim) {
  return std::find(claims.begin(), claims.end(), claim) != claims.end();
}

// The base's own composition, under the name and with the order of the table.
class ComposedInstance final : public MakerOf<ComposedInstance, MethodInstance> {
 public:
  ComposedInstance(const MethodPlugin& plugin, std::unique_ptr<MethodInstance> composed, bool palindrome)
      : plugin_(plugin), composed_(std::move(composed)), palindrome_(palindrome) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return plugin_.descriptor(); }
  [[nodiscard]] Assignments parameters() const override { return {}; }
  [[nodiscard]] FacetSet needs() const override { return composed_->needs(); }
  [[nodiscard]] int order(const Model& /*model*/) const override { return plugin_.descriptor().order; }
  [[nodiscard]] bool order_is_lower_bound() const override { return composed_->order_is_lower_bound(); }
  [[nodiscard]] bool order_is_exact() const override { return composed_->order_is_exact(); }
  /// What the base keeps in steps of either sign; symmetry only where the weights are symmetric. Claims on
  /// entropy are left out: a sub-step back in time lets it fall.
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const override {
    std::vector<Claim> kept = composed_->preserves(model);
    std::erase(kept, Claim::entropy);
    if (!palindrome_) {
      std::erase(kept, Claim::symmetric);
      std::erase(kept, Claim::reversible);
    }
    return kept;
  }
  [[nodiscard]] std::string objection(const Model& model) const override {
    return composed_->objection(model);
  }
  [[nodiscard]] bool adaptive() const override { return false; }
  [[nodiscard]] std::size_t coefficient_count() const override { return composed_->coefficient_count(); }
  [[nodiscard]] std::unique_ptr<MethodInstance> with_changed_coefficient(std::size_t index,
                                                                         Quad amount) const override {
    return std::make_unique<ComposedInstance>(plugin_, composed_->with_changed_coefficient(index, amount),
                                              palindrome_);
  }
  /// Null: the weights of further compositions are made for bases of order 2.
  [[nodiscard]] std::unique_ptr<MethodInstance> composed(std::vector<Quad> /*weights*/) const override {
    return nullptr;
  }
  template <class T>
  [[nodiscard]] StepperPointer<T> made(std::shared_ptr<const Model> model) const {
    return composed_->stepper(std::move(model), T());
  }

 private:
  const MethodPlugin& plugin_;
  std::unique_ptr<MethodInstance> composed_;
  bool palindrome_;
};

class CompositionTable final : public MethodTable {
 public:
  CompositionTable(MethodDescriptor descriptor, const TableDocument& document, OrderTheory theory,
                   PluginValue base)
      : MethodTable(std::move(descriptor), {}, typeid(CompositionTable), document, std::move(theory)),
        base_(std::move(base)),
        palindrome_(symmetric(weights())) {}

  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    assign_all(parameters(), nullptr, assignments, "integrator " + name());
    auto base = integrators().get(base_.name, "integrator").make(base_.settings);
    return std::make_unique<ComposedInstance>(*this, base->composed(weights()), palindrome_);
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
  bool palindrome_;
};

// The base, which has to be symmetric, of order 2, and to say how it is composed.
PluginValue read_base(TableDocument& document) {
  PluginValue base = parse_plugin_value(document.required_text("base"), document.path() + ": key 'base'");
  const MethodPlugin& plugin = integrators().get(base.name, "integrator");
  const auto instance = plugin.make(base.settings);
  if (!contains(plugin.descriptor().preserves, Claim::symmetric) || plugin.descriptor().order != 2 ||
      instance->adaptive() || instance->composed({Quad(1)}) == nullptr)
    document.refuse("base", base.name +
                                " cannot be composed; expected a symmetric method of order 2, such as "
                                "verlet, midpoint-darboux or rattle");
  return base;
}

}  // namespace

namespace pfaff {

std::unique_ptr<const MethodTable> read_composition_table(TableDocument& document, TableHead head) {
  PluginValue base = read_base(document);
  const std::vector<Quad> weights = document.numbers("weights");
  const int order = head.descriptor.order;
  if (order > largest_degree)
    document.refuse("order", "expected at most " + std::to_string(largest_degree) +
                                 ", the degree up to which words are listed");
  if (document.has("preserves"))
    document.refuse("preserves", "follows from the base; expected no such key in a composition");
  document.finish();
  require_order(document, head, composition_conditions(weights, std::min(order + 1, largest_degree)));
  OrderTheory theory{"words", order, weights, {}, head.precision};
  theory.conditions = [order](const std::vector<Quad>& others) {
    return composition_conditions(others, order);
  };
  theory.next_order = 3;
  return std::make_unique<CompositionTable>(head.descriptor, document, std::move(theory), std::move(base));
}

}  // namespace pfaff
