#include <pfaff/integrators/tables/table_document.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <sstream>

#include <toml++/toml.h>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/source_text.hpp>
#include <pfaff/core/text/scope.hpp>

namespace pfaff {

struct TableDocument::Content {
  std::string text;
  toml::table root;
  text::Scope scope;
  std::vector<std::pair<std::string, PlacedText>> constants;
  std::vector<std::string> asked;

  const toml::node* find(std::string_view key) {
    const std::size_t dot = key.find('.');
    if (dot == std::string_view::npos) {
      asked.emplace_back(key);
      return root.get(key);
    }
    const std::string_view outer = key.substr(0, dot);
    asked.emplace_back(outer);
    asked.emplace_back(key);
    const toml::node* node = root.get(outer);
    return node == nullptr || !node->is_table() ? nullptr : node->as_table()->get(key.substr(dot + 1));
  }
};

namespace {

using PlacedText = TableDocument::PlacedText;

std::string contents_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  if (!file || !(text << file.rdbuf()))
    throw InputError(path + ": cannot be read; expected a table of coefficients (TOML)");
  return text.str();
}

// What stands in the file for a number: the digits of a number, or what is between the quotes of a text.
PlacedText placed(const toml::node& node, const std::string& file) {
  const toml::source_region& at = node.source();
  if (const auto* s = node.as_string()) return {s->get(), at.begin.line, at.begin.column + 1U};
  return {source_text(file, at.begin.line, at.begin.column, at.end.column), at.begin.line, at.begin.column};
}

bool is_number(const toml::node& node) {
  return node.is_integer() || node.is_floating_point() || node.is_string();
}

}  // namespace

TableDocument::TableDocument(const std::string& path) : path_(path), content_(std::make_unique<Content>()) {
  Content& c = *content_;
  c.text = contents_of(path);
  try {
    c.root = toml::parse(c.text, path);
  } catch (const toml::parse_error& e) {
    throw InputError(path + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()) + "; expected a table of coefficients (TOML)");
  }
  c.asked.emplace_back("let");
  const toml::node* let = c.root.get("let");
  if (let == nullptr) return;
  if (!let->is_table()) refuse("let", "expected a table of constants, such as { r = \"2^(1/3)\" }");
  for (const auto& [name, value] : *let->as_table()) {
    const std::string called(name.str());
    const auto& reserved = text::reserved_names();
    if (std::find(reserved.begin(), reserved.end(), called) != reserved.end())
      refuse("let", "'" + called + "' has a meaning already; expected another name");
    if (!is_number(value)) refuse("let", "expected a number or an expression for '" + called + "'");
    const PlacedText definition = placed(value, c.text);
    c.constants.emplace_back(called, definition);
    c.scope.define(called, text::Expression({definition.text, path_, definition.line, definition.column}));
  }
}

TableDocument::~TableDocument() = default;

const std::string& TableDocument::contents() const { return content_->text; }

bool TableDocument::has(std::string_view key) const { return content_->find(key) != nullptr; }

std::string TableDocument::text(std::string_view key, const std::string& fallback) {
  const toml::node* node = content_->find(key);
  if (node == nullptr) return fallback;
  if (!node->is_string()) refuse(key, "expected a text");
  return node->as_string()->get();
}

std::string TableDocument::required_text(std::string_view key) {
  if (!has(key)) refuse(key, "is missing; expected a text");
  return text(key, {});
}

std::vector<std::string> TableDocument::texts(std::string_view key) {
  std::vector<std::string> list;
  for (PlacedText& item : placed_texts(key)) list.push_back(std::move(item.text));
  return list;
}

std::vector<PlacedText> TableDocument::placed_texts(std::string_view key) {
  const toml::node* node = content_->find(key);
  if (node == nullptr) return {};
  std::vector<PlacedText> list;
  if (node->is_array())
    for (const toml::node& item : *node->as_array())
      if (item.is_string()) list.push_back(placed(item, content_->text));
  if (!node->is_array() || list.size() != node->as_array()->size()) refuse(key, "expected a list of texts");
  return list;
}

const std::vector<std::pair<std::string, PlacedText>>& TableDocument::constants() const {
  return content_->constants;
}

int TableDocument::required_whole_number(std::string_view key) {
  const toml::node* node = content_->find(key);
  if (node == nullptr || !node->is_integer() || node->as_integer()->get() < 1 ||
      node->as_integer()->get() > std::numeric_limits<int>::max())
    refuse(key, std::string(node == nullptr ? "is missing; " : "") + "expected a whole number > 0");
  return static_cast<int>(node->as_integer()->get());
}

std::vector<Quad> TableDocument::numbers(std::string_view key) {
  const toml::node* node = content_->find(key);
  std::vector<Quad> list;
  if (node == nullptr) refuse(key, "is missing; expected a list of numbers");
  if (node->is_array())
    for (const toml::node& item : *node->as_array())
      if (is_number(item)) {
        const PlacedText at = placed(item, content_->text);
        list.push_back(
            content_->scope.constant(text::Expression({at.text, path_, at.line, at.column})).quad());
      }
  if (list.empty() || list.size() != node->as_array()->size()) refuse(key, "expected a list of numbers");
  return list;
}

std::vector<std::vector<Quad>> TableDocument::rows(std::string_view key) {
  const toml::node* node = content_->find(key);
  if (node == nullptr) refuse(key, "is missing; expected a list of rows of numbers");
  std::vector<std::vector<Quad>> list;
  if (node->is_array())
    for (const toml::node& row : *node->as_array()) {
      if (!row.is_array()) break;
      list.emplace_back();
      for (const toml::node& item : *row.as_array()) {
        if (!is_number(item)) refuse(key, "expected rows of numbers");
        const PlacedText at = placed(item, content_->text);
        list.back().push_back(
            content_->scope.constant(text::Expression({at.text, path_, at.line, at.column})).quad());
      }
    }
  if (list.empty() || list.size() != node->as_array()->size())
    refuse(key, "expected a list of rows of numbers");
  return list;
}

void TableDocument::finish() const {
  const auto asked = [&](const std::string& key) {
    return std::find(content_->asked.begin(), content_->asked.end(), key) != content_->asked.end();
  };
  for (const auto& [key, value] : content_->root) {
    const std::string name(key.str());
    if (!asked(name)) refuse(name, unknown_name("key", name, content_->asked));
    if (name == "let" || !value.is_table()) continue;
    for (const auto& [inner, unused] : *value.as_table()) {
      (void)unused;
      const std::string path = name + "." + std::string(inner.str());
      if (!asked(path)) refuse(name, unknown_name("key", path, content_->asked));
    }
  }
}

void TableDocument::refuse(std::string_view key, const std::string& message) const {
  const std::size_t dot = key.find('.');
  const toml::node* node = content_->root.get(key.substr(0, dot));
  const std::string line = node == nullptr ? "" : ":" + std::to_string(node->source().begin.line);
  std::string text = path_ + line + ": key '" + std::string(key) + "': " + message;
  // Texts of the file may hold line breaks, which a message of one line does not.
  std::replace_if(
      text.begin(), text.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, ' ');
  throw InputError(text);
}

}  // namespace pfaff
