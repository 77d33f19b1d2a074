// Compositions of symmetric methods of order 2 as one plug-in: a scheme, which is a family of weights, over a
// base, and the short names of those that are met most. Families: yoshida1990 (few stages, large errors),
// suzuki1990 (many stages, smaller ones), kahan-li1997 (the best known of orders 6 and 8).
#include <pfaff/core/method_alias.hpp>
#include <pfaff/integrators/composition/bases.hpp>
#include <pfaff/integrators/composition/composed_instance.hpp>
#include <pfaff/integrators/composition/composition_weights.hpp>
#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace {
using namespace pfaff;

struct Scheme {
  std::string name;
  std::vector<std::string> orders;                 // the lowest first
  std::size_t verified = 0, verified_in_full = 0;  // how many of them have their claims verified
  std::vector<Quad> (*weights)(int order) = nullptr;
};

const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> list{{"yoshida", {"4", "6", "8", "10", "12"}, 3, 4, yoshida_weights},
                                        {"suzuki", {"4", "6", "8", "10", "12"}, 2, 3, suzuki_weights},
                                        {"kahan-li", {"6", "8"}, 2, 2, kahan_li_weights}};
  return list;
}

std::vector<std::string> scheme_names() {
  std::vector<std::string> names;
  for (const Scheme& scheme : schemes()) names.push_back(scheme.name);
  return names;
}

// The base with its parameters set.
std::unique_ptr<MethodInstance> made_base(const PluginValue& base) {
  const MethodPlugin& plugin = integrators().get(base.name, "integrator");
  auto method = plugin.make(base.settings);
  const std::string reason = unfit_as_base(plugin, *method);
  if (!reason.empty()) throw InputError("composition cannot have the base " + base.name + ": " + reason);
  return method;
}

struct Composing {
  std::string scheme = "yoshida", order;  // an empty order stands for the scheme's lowest
  PluginValue base{"midpoint-darboux"};

  static std::vector<Parameter> parameters() {
    return {parameter(&Composing::scheme, "scheme", scheme_names(), "family of weights"),
            parameter(&Composing::order, "order", {"4", "6", "8", "10", "12"},
                      "order of the composition, without one the scheme's lowest; kahan-li has 6 and 8"),
            parameter(&Composing::base, "base",
                      {.kind = "integrator",
                       .names = base_names,
                       .parameters =
                           [](const std::string& name) {
                             return integrators().get(name, "integrator").parameters();
                           },
                       .resolve = [](const PluginValue& value) { return made_base(value)->parameters(); }},
                      "the symmetric method of order 2 that takes the sub-steps")};
  }
};

const Scheme& scheme_of(const Composing& settings) {
  return *std::find_if(schemes().begin(), schemes().end(),
                       [&](const Scheme& s) { return s.name == settings.scheme; });
}

// The settings with an order that the scheme has.
Composing settings_of(const MethodPlugin& plugin, const Assignments& assignments) {
  Composing settings;
  const std::string owner = "integrator " + plugin.name();
  assign_all(plugin.parameters(), &settings, assignments, owner);
  const Scheme& scheme = scheme_of(settings);
  if (settings.order.empty()) settings.order = scheme.orders.front();
  if (std::find(scheme.orders.begin(), scheme.orders.end(), settings.order) == scheme.orders.end()) {
    std::string orders;
    for (const std::string& order : scheme.orders) orders += (orders.empty() ? "" : "|") + order;
    throw InputError("parameter 'order' of " + owner + ": expected " + orders +
                     " with scheme=" + scheme.name + ", got '" + settings.order + "'");
  }
  return settings;
}

class CompositionPlugin final : public MethodPlugin {
 public:
  explicit CompositionPlugin(MethodDescriptor descriptor,
                             const std::source_location& where = std::source_location::current())
      : MethodPlugin(std::move(descriptor), Composing::parameters(), typeid(CompositionPlugin), where) {
    integrators().add(this);
  }

  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    Composing settings = settings_of(*this, assignments);
    const auto base = made_base(settings.base);
    settings.base.settings = base->parameters();
    const int order = std::stoi(settings.order);
    return std::make_unique<ComposedInstance>(
        ComposedStatement{.plugin = this,
                          .parameters = resolved(parameters(), &settings),
                          .called = name() + " of " + settings.base.name,
                          .order = order},
        base->composed(scheme_of(settings).weights(order), 0));
  }

  // Weights are the same over every base: over the base that a composition has by itself all are verified,
  // and, unless in full, over the others each scheme at its lowest order.
  [[nodiscard]] std::vector<Assignments> instances(bool full) const override {
    std::vector<Assignments> list;
    for (const std::string& base : base_names())
      for (const Scheme& scheme : schemes()) {
        const std::size_t orders = full ? scheme.verified_in_full : scheme.verified;
        for (std::size_t k = 0; k < (full || base == Composing().base.name ? orders : 1); ++k)
          list.push_back({{"scheme", scheme.name}, {"order", scheme.orders[k]}, {"base", base}});
      }
    return list;
  }
};

const CompositionPlugin composition{
    {.name = "composition",
     .title = "symmetric compositions of a symmetric method of order 2",
     .family = "splitting",
     .reference =
         "yoshida1990; suzuki1990; kahan-li1997; hairer-lubich-wanner2006 (II.4.4), (II.4.5), (V.3.11), "
         "(V.3.13)",
     .description =
         "Sub-steps of a symmetric base of order 2, some of them back in time, with weights that raise the "
         "order to 4, 6, 8 or more. Take it where the base keeps what matters and its order is too low: "
         "everything that the base keeps in steps of either sign is kept. The scheme kahan-li has the "
         "smallest errors for its work at orders 6 and 8, suzuki smaller ones than yoshida at order 4. "
         "Friction acts the wrong way in sub-steps back in time, so that stiff decay sets the step."}};

// Lie words are listed up to degree 12, the largest order of the schemes.
const KnownOrderTheory conditions{"composition", [](const Assignments& parameters) {
                                    const Composing settings = settings_of(composition, parameters);
                                    const int order = std::stoi(settings.order);
                                    return OrderTheory{"words", order, scheme_of(settings).weights(order),
                                                       [order](const std::vector<Quad>& weights) {
                                                         return composition_conditions(weights, order);
                                                       }};
                                  }};

const Assignments compensated{{"compensated", "base.compensated"}};

Assignments over(const char* base, const char* scheme) { return {{"scheme", scheme}, {"base", base}}; }

const MethodAlias yoshida{composition, "yoshida", over("midpoint-darboux", "yoshida"), compensated};
const MethodAlias suzuki{composition, "suzuki", over("midpoint-darboux", "suzuki"), compensated};
const MethodAlias kahan_li{composition, "kahan-li", over("midpoint-darboux", "kahan-li"), compensated};
const MethodAlias yoshida_verlet{composition, "yoshida-verlet", over("verlet", "yoshida"), compensated};
const MethodAlias suzuki_verlet{composition, "suzuki-verlet", over("verlet", "suzuki"), compensated};
const MethodAlias kahan_li_verlet{composition, "kahan-li-verlet", over("verlet", "kahan-li"), compensated};
const MethodAlias yoshida_rattle{composition, "yoshida-rattle", over("rattle", "yoshida"), compensated};
const MethodAlias suzuki_rattle{composition, "suzuki-rattle", over("rattle", "suzuki"), compensated};
const MethodAlias kahan_li_rattle{composition, "kahan-li-rattle", over("rattle", "kahan-li"), compensated};
const MethodAlias suzuki_conformal{composition, "suzuki-conformal", over("conformal-splitting", "suzuki"),
                                   compensated};
const MethodAlias kahan_li_conformal{composition, "kahan-li-conformal",
                                     over("conformal-splitting", "kahan-li"), compensated};
}  // namespace
