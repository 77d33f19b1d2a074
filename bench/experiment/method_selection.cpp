#include <pfaff/bench/experiment/method_selection.hpp>

#include <algorithm>
#include <array>
#include <charconv>

#include <pfaff/runs/motion.hpp>

namespace pfaff {

namespace {
constexpr int highest_order = 1000;

// "4", ">= 4" and the like as a relation and a number.
std::pair<std::string, int> order_condition(const std::string& text) {
  const std::size_t digits = std::min(text.find_first_of("0123456789"), text.size());
  std::string relation = text.substr(0, digits);
  while (relation.ends_with(' ')) relation.pop_back();
  if (relation.empty()) relation = "=";
  int order = 0;
  const auto [end, error] = std::from_chars(text.data() + digits, text.data() + text.size(), order);
  constexpr std::array relations{"=", ">=", "<=", ">", "<"};
  if (std::find(relations.begin(), relations.end(), relation) == relations.end() || error != std::errc() ||
      end != text.data() + text.size() || order > highest_order)
    throw InputError("expected an order such as 4, \">= 4\" or \"< 3\", got '" + text + "'");
  return {relation, order};
}

bool fulfils(int order, const std::pair<std::string, int>& condition) {
  const auto& [relation, bound] = condition;
  if (relation == ">=") return order >= bound;
  if (relation == "<=") return order <= bound;
  if (relation == ">") return order > bound;
  if (relation == "<") return order < bound;
  return order == bound;
}

// The row of a table whose name is `name`; InputError with the nearest name where there is none.
template <class Table>
const auto& row_named(const Table& table, const std::string& kind, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& row : table) {
    if (row.name == name) return row;
    names.emplace_back(row.name);
  }
  throw InputError(unknown_name(kind, name, names));
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}
}  // namespace

MethodSelection read_selection(Keys& keys, const std::string& where) {
  MethodSelection selection;
  if (!keys.has_table("methods")) {
    if (keys.words("methods") != std::vector<std::string>{"all"})
      keys.refuse(
          "methods",
          "expected at least one [[method]], or methods = \"all\", or a table such as methods = { keeps = "
          "\"symplectic\", order = \">= 4\" }");
    return selection;
  }
  Keys table(*keys.table("methods"), where + " methods");
  const auto read = [&](const std::string& key, const auto& take) {
    for (const std::string& text : table.one_or_more(key)) try {
        take(text);
      } catch (const InputError& error) {
        table.refuse(key, error.what());
      }
  };
  read("keeps", [&](const std::string& name) {
    selection.keeps.push_back(row_named(claim_table, "claim", name).claim);
  });
  read("needs", [&](const std::string& name) {
    const auto& row = row_named(facet_table, "facet", name);
    selection.needs.push_back(static_cast<Facet>(&row - facet_table.data()));
  });
  read("order", [&](const std::string& text) { selection.orders.push_back(order_condition(text)); });
  selection.set = table.assignment_lists("set");
  std::vector<std::string> known;
  for (const MethodPlugin* plugin : integrators().all())
    for (const Parameter& parameter : plugin->parameters()) known.push_back(parameter.name);
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const auto& [name, values] : selection.set)
    if (std::find(known.begin(), known.end(), name) == known.end())
      table.refuse("set", unknown_name("parameter of a method", name, known));
  table.finish();
  return selection;
}

std::vector<ExperimentMethod> selected_methods(const MethodSelection& selection) {
  require_shipped_plugins();
  std::vector<ExperimentMethod> methods;
  for (const MethodPlugin* plugin : integrators().all()) {
    AssignmentLists lists = selection.set;
    std::erase_if(lists, [&](const auto& list) {
      return std::none_of(plugin->parameters().begin(), plugin->parameters().end(),
                          [&](const Parameter& parameter) { return parameter.name == list.first; });
    });
    for (const GridPoint& point : points_of(lists)) {
      ExperimentMethod& method = methods.emplace_back();
      method.integrator = plugin->name();
      method.label = called(plugin->name(), point.values);
      method.set = point.values;
      method.selected = true;
    }
  }
  return methods;
}

std::string reason_to_leave_out(const MethodSelection& selection, const ExperimentMethod& method,
                                const ExperimentCase& of, const std::shared_ptr<const Model>& system) {
  std::shared_ptr<const MethodInstance> instance = method.object;
  if (instance == nullptr) try {
      instance = integrators().get(method.integrator, "integrator").make(method.set);
    } catch (const InputError& error) {
      return error.what();
    }
  const std::shared_ptr<const Model> model = motion_for(*instance, system);
  if (std::string reason = instance->refuses(*model); !reason.empty()) return reason;
  if (of.precision == Precision::quad && instance->descriptor().double_coefficients)
    return "has coefficients in double only";
  std::vector<std::string> missing;
  for (const Facet facet : selection.needs)
    if (!instance->needs().has(facet)) missing.emplace_back(to_string(facet));
  if (!missing.empty()) return "does not need " + joined(missing);
  const std::vector<Claim> claims = claims_in_scope(instance->preserves(*model), *model);
  for (const Claim claim : selection.keeps)
    if (std::find(claims.begin(), claims.end(), claim) == claims.end())
      missing.emplace_back(to_string(claim));
  if (!missing.empty()) return "does not claim to keep " + joined(missing);
  const int order = instance->order(*model);
  for (const auto& condition : selection.orders)
    if (!fulfils(order, condition)) return "is of order " + std::to_string(order);
  return "";
}

}  // namespace pfaff
