#include <pfaff/integrators/tables/method_table.hpp>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include <pfaff/core/text/document.hpp>

namespace pfaff {

namespace {

struct Kind {
  const char* name;
  std::unique_ptr<const MethodTable> (*read)(TableDocument&, TableHead);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list{{"runge-kutta", read_runge_kutta_table},
                                      {"splitting", read_splitting_table},
                                      {"rkn-splitting", read_splitting_table},
                                      {"processed", read_splitting_table},
                                      {"composition", read_composition_table},
                                      {"multistep", read_multistep_table},
                                      {"second-order-multistep", read_second_order_multistep_table}};
  return list;
}

TableHead read_head(TableDocument& document, const std::string& kind) {
  TableHead head;
  MethodDescriptor& d = head.descriptor;
  d.name = document.required_text("name");
  if (!is_kebab_case(d.name))
    document.refuse("name", "expected kebab-case, such as 'damped-pendulum', got '" + d.name + "'");
  d.order = document.required_whole_number("order");
  d.title = document.text("title", kind + " table of order " + std::to_string(d.order));
  d.reference = document.text("reference", "");
  d.description = document.text("description", "A table of coefficients of the kind " + kind +
                                                   ", read from a file. Its order conditions were checked "
                                                   "when it was read.");
  const std::string precision = document.text("precision", "quad");
  if (precision != "quad" && precision != "double")
    document.refuse("precision", unknown_name("precision", precision, {"quad", "double"}));
  d.double_coefficients = precision == "double";
  if (d.double_coefficients) head.precision = precision_of_double_coefficients;
  return head;
}

// What was read from files, by their absolute paths. A table lives as long as the program, like every
// registered method.
std::vector<std::unique_ptr<const MethodTable>>& tables() {
  static std::vector<std::unique_ptr<const MethodTable>> list;
  return list;
}

}  // namespace

std::string residual_in_words(const OrderCondition& condition, const Quad& precision) {
  return "is off by " + to_scientific(condition.residual, 3) + "; expected at most " +
         to_scientific(precision * condition.scale, 2);
}

void require_order(const TableDocument& document, const TableHead& head,
                   const std::vector<OrderCondition>& conditions) {
  const int order = head.descriptor.order;
  if (const OrderCondition* first = first_violated(conditions, order, head.precision)) {
    // Residuals as small as this are what digits that are missing leave.
    const bool digits = !head.descriptor.double_coefficients && relative_residual(*first) < Quad(1e-12);
    document.refuse("order", std::to_string(order) + ", but " + first->name + ", a condition of order " +
                                 std::to_string(first->order) + ", " +
                                 residual_in_words(*first, head.precision) +
                                 (digits ? " (numbers of 36 digits, or precision = \"double\")" : ""));
  }
  if (const int shown = order_shown(conditions, head.precision); shown > order)
    document.refuse("order", std::to_string(order) + ", but all conditions of order " +
                                 std::to_string(shown) + " hold; expected that order");
}

std::vector<Claim> kept_claims(TableDocument& document, std::vector<Claim> kept,
                               const std::function<std::string(Claim)>& why) {
  if (!document.has("preserves")) return kept.empty() ? std::vector<Claim>{Claim::none} : kept;
  std::vector<std::string> known{"none"};
  for (const ClaimRow& row : claim_table) known.emplace_back(row.name);
  std::vector<Claim> claimed;
  for (const std::string& name : document.texts("preserves")) {
    const auto place = std::find(known.begin(), known.end(), name);
    if (place == known.end()) document.refuse("preserves", unknown_name("claim", name, known));
    const auto claim = static_cast<Claim>(place - known.begin());
    if (claim != Claim::none && std::find(kept.begin(), kept.end(), claim) == kept.end())
      document.refuse("preserves", "'" + name + "' does not follow from the numbers: " + why(claim));
    claimed.push_back(claim);
  }
  return claimed;
}

std::unique_ptr<const MethodTable> read_method_table(const std::string& path) {
  TableDocument document(std::filesystem::absolute(path).lexically_normal().string());
  const std::string kind = document.required_text("kind");
  std::vector<std::string> names;
  for (const Kind& k : kinds()) {
    if (kind == k.name) return k.read(document, read_head(document, kind));
    names.emplace_back(k.name);
  }
  document.refuse("kind", unknown_name("kind", kind, names));
}

bool names_method_table(const std::string& path) {
  if (!path.ends_with(".toml")) return false;
  try {
    const std::vector<text::Member> keys = text::read_document(path).root.members;
    return std::any_of(keys.begin(), keys.end(), [](const text::Member& m) { return m.key == "kind"; });
  } catch (const InputError&) {
    return false;  // whoever reads it as a model says what is wrong
  }
}

const MethodPlugin& integrator_named(const std::string& text) {
  if (!text.ends_with(".toml")) return integrators().get(text, "integrator");
  const std::string path = std::filesystem::absolute(text).lexically_normal().string();
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  for (const auto& table : tables()) {
    if (table->path() != path) continue;
    if (TableDocument(path).contents() != table->contents())
      throw InputError(path + ": changed since it was read as '" + table->name() +
                       "'; expected a file that stays as it is");
    return *table;
  }
  auto table = read_method_table(path);
  if (const MethodPlugin* taken = integrators().find(table->name()))
    throw InputError(path + ": key 'name': '" + table->name() + "' is registered in " + taken->file() +
                     "; expected another name");
  if (!table->theory().kind.empty())
    KnownOrderTheory(table->name(),
                     [t = table.get()](const Assignments& /*parameters*/) { return t->theory(); });
  integrators().add(table.get());
  tables().push_back(std::move(table));
  return *tables().back();
}

}  // namespace pfaff
