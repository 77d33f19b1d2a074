#include <pfaff/integrators/tables/table_document.hpp>

#include <algorithm>
#include <charconv>

namespace pfaff {

namespace {
bool is_number(const text::Item& item) {
  return item.kind == text::Item::Kind::number || item.kind == text::Item::Kind::text;
}
}  // namespace

TableDocument::TableDocument(const std::string& path)
    : document_(text::read_document(path)), root_(document_.root, "a table of coefficients") {
  if (const text::Item* let = root_.find("let")) definitions_ = text::read_definitions(*let, names_);
  text::define(constants_, {}, {}, definitions_);
}

const text::Item* TableDocument::find(std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return root_.find(key);
  const std::string_view outer = key.substr(0, dot);
  const text::Item* table = root_.find(outer);
  if (table == nullptr) return nullptr;
  const std::string name(outer);
  return inner_.try_emplace(name, *table, "the table '" + name + "'").first->second.find(key.substr(dot + 1));
}

std::string TableDocument::text(std::string_view key, const std::string& fallback) {
  const text::Item* item = find(key);
  if (item == nullptr) return fallback;
  if (item->kind != text::Item::Kind::text) refuse(key, "expected a text");
  return item->source.text;
}

std::string TableDocument::required_text(std::string_view key) {
  if (!has(key)) refuse(key, "is missing; expected a text");
  return text(key, {});
}

std::vector<std::string> TableDocument::texts(std::string_view key) {
  const text::Item* list = find(key);
  if (list == nullptr) return {};
  if (list->kind != text::Item::Kind::list) refuse(key, "expected a list of texts");
  std::vector<std::string> texts;
  for (const text::Item& item : list->items) {
    if (item.kind != text::Item::Kind::text) refuse(key, "expected a list of texts");
    texts.push_back(item.source.text);
  }
  return texts;
}

int TableDocument::required_whole_number(std::string_view key) {
  const text::Item* item = find(key);
  int number = 0;
  if (item != nullptr && item->kind == text::Item::Kind::number && item->whole)
    (void)std::from_chars(item->source.text.data(), item->source.text.data() + item->source.text.size(),
                          number);  // which leaves 0 where the number is too large
  if (number < 1)
    refuse(key, std::string(item == nullptr ? "is missing; " : "") + "expected a whole number > 0");
  return number;
}

void TableDocument::append_numbers(const text::Item& item, std::vector<Quad>& numbers) {
  std::vector<Recorded> values;
  constants_.append(text::expression_of(item, "a number"), values);
  for (const Recorded& x : values) numbers.push_back(x.constant().quad());
}

std::vector<Quad> TableDocument::numbers(std::string_view key) {
  const text::Item* list = find(key);
  if (list == nullptr) refuse(key, "is missing; expected a list of numbers");
  std::vector<Quad> numbers;
  for (const text::Item& item : list->items) {
    if (!is_number(item)) refuse(key, "expected a list of numbers");
    append_numbers(item, numbers);
  }
  if (numbers.empty()) refuse(key, "expected a list of numbers");
  return numbers;
}

std::vector<std::vector<Quad>> TableDocument::rows(std::string_view key) {
  const text::Item* list = find(key);
  if (list == nullptr) refuse(key, "is missing; expected a list of rows of numbers");
  std::vector<std::vector<Quad>> rows;
  for (const text::Item& row : list->items) {
    if (row.kind != text::Item::Kind::list || !std::all_of(row.items.begin(), row.items.end(), is_number))
      refuse(key, "expected a list of rows of numbers");
    rows.emplace_back();
    for (const text::Item& item : row.items) append_numbers(item, rows.back());
  }
  if (rows.empty()) refuse(key, "expected a list of rows of numbers");
  return rows;
}

void TableDocument::finish() const {
  root_.finish();
  for (const auto& [name, table] : inner_) table.finish();
}

void TableDocument::refuse(std::string_view key, const std::string& message) const {
  const text::Item* place = &document_.root;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string_view outer = rest.substr(0, rest.find('.'));
    const auto found = std::find_if(place->members.begin(), place->members.end(),
                                    [&](const text::Member& member) { return member.key == outer; });
    if (found == place->members.end()) break;
    place = &found->value;
    rest.remove_prefix(std::min(rest.size(), outer.size() + 1));
  }
  text::refuse(*place, "key '" + std::string(key) + "': " + message);
}

}  // namespace pfaff
