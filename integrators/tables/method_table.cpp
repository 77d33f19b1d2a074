#include <pfaff/integrators/tables/method_table.hpp>

#include <algorithm>
#include <map>

namespace pfaff {

namespace {

// The readers by the names of their kinds.
std::map<std::string, detail::TableReader>& readers() {
  static std::map<std::string, detail::TableReader> known;
  return known;
}

TableHead read_head(TableDocument& document, const std::string& kind) {
  TableHead head;
  MethodDescriptor& d = head.descriptor;
  d.name = document.required_text("name");
  if (!is_kebab_case(d.name))
    document.refuse("name", "expected kebab-case, such as 'damped-pendulum', got '" + d.name + "'");
  d.order = document.required_whole_number("order");
  const bool map = kind == "map";
  d.title = document.text("title", kind + (map ? "" : " table") + " of order " + std::to_string(d.order));
  d.reference = document.text("reference", "");
  d.description = document.text(
      "description", map ? "A map written as text, read from a file. Its order and what it keeps are what "
                           "the file says; pfaff verify measures both."
                         : "A table of coefficients of the kind " + kind +
                               ", read from a file. Its order conditions were checked when it was read.");
  const std::string precision = document.text("precision", "quad");
  if (precision != "quad" && precision != "double")
    document.refuse("precision", unknown_name("precision", precision, {"quad", "double"}));
  d.double_coefficients = precision == "double";
  if (d.double_coefficients) head.precision = precision_of_double_coefficients;
  return head;
}

// The method of a file, registered. It lives as long as the program, like every registered method.
std::unique_ptr<const MethodTable> registered(const std::string& path) {
  auto table = read_method_table(path);
  if (const MethodPlugin* taken = integrators().find(table->name())) {
    const auto* of_file = dynamic_cast<const MethodTable*>(taken);
    if (of_file != nullptr && of_file->path() == table->path())
      throw InputError(table->path() + ": changed since it was read as '" + table->name() +
                       "'; expected a file that stays as it is");
    throw InputError(table->path() + ": key 'name': '" + table->name() + "' is registered in " +
                     (of_file != nullptr ? of_file->path() : taken->file()) + "; expected another name");
  }
  if (!table->theory().kind.empty())
    KnownOrderTheory(table->name(),
                     [t = table.get()](const Assignments& /*parameters*/) { return t->theory(); });
  integrators().add(table.get());
  return table;
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

void require_effective_order(const TableDocument& document, const TableHead& head, const std::string& key,
                             const std::vector<OrderCondition>& conditions) {
  const int order = head.descriptor.order;
  if (const OrderCondition* first = first_violated(conditions, order, head.precision))
    document.refuse(key, "is not of effective order " + std::to_string(order) + ": " + first->name +
                             ", a condition of order " + std::to_string(first->order) + ", " +
                             residual_in_words(*first, head.precision));
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

void detail::register_table_kind(std::vector<std::string> names, TableReader read) {
  for (std::string& name : names) readers().emplace(std::move(name), read);
}

std::unique_ptr<const MethodTable> read_method_table(const std::string& path) {
  TableDocument document(text::absolute_path(path));
  const std::string kind = document.required_text("kind");
  std::vector<std::string> names;
  load_shipped_plugins();
  for (const auto& [name, read] : readers()) {
    if (kind == name) return read(document, read_head(document, kind));
    names.push_back(name);
  }
  document.refuse("kind", unknown_name("kind", kind, names) + what_is_left_out());
}

bool names_method_table(const std::string& path) {
  if (!text::is_text_file(path)) return false;
  try {
    const std::vector<text::Member> keys = text::read_document(path).root.members;
    return std::any_of(keys.begin(), keys.end(), [](const text::Member& m) { return m.key == "kind"; });
  } catch (const InputError&) {
    return false;  // whoever reads it as a model says what is wrong
  }
}

const MethodPlugin& integrator_named(const std::string& name) {
  if (!text::is_text_file(name)) return integrators().get(name, "integrator");
  static text::PluginFiles<MethodTable> files;
  return files.get(name, registered);
}

}  // namespace pfaff
