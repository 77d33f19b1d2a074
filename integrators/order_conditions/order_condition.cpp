#include <pfaff/integrators/order_conditions/order_condition.hpp>

#include <algorithm>
#include <map>

namespace pfaff {

namespace {
bool violated(const OrderCondition& condition, const Quad& precision) {
  return !(relative_residual(condition) <= precision);
}

std::map<std::string, detail::OrderTheoryRegistration::Make>& theories() {
  static std::map<std::string, detail::OrderTheoryRegistration::Make> known;
  return known;
}
}  // namespace

const OrderCondition* first_violated(const std::vector<OrderCondition>& conditions, int order,
                                     const Quad& precision) {
  const OrderCondition* first = nullptr;
  for (const OrderCondition& condition : conditions) {
    if (condition.order > order || !violated(condition, precision)) continue;
    if (first == nullptr || condition.order < first->order ||
        (condition.order == first->order && relative_residual(condition) > relative_residual(*first)))
      first = &condition;
  }
  return first;
}

int order_shown(const std::vector<OrderCondition>& conditions, const Quad& precision) {
  int largest = 0;
  for (const OrderCondition& condition : conditions) largest = std::max(largest, condition.order);
  const OrderCondition* first = first_violated(conditions, largest, precision);
  return first == nullptr ? largest : first->order - 1;
}

detail::OrderTheoryRegistration::OrderTheoryRegistration(std::string method, Make make) {
  theories().emplace(std::move(method), std::move(make));
}

std::optional<OrderTheory> order_theory(const std::string& method, const Assignments& parameters) {
  const auto found = theories().find(method);
  if (found == theories().end()) return std::nullopt;
  return found->second(parameters);
}

}  // namespace pfaff
