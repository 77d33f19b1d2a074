// TOML tables whose keys are checked, for experiments and run configurations.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// Parses a file. A number with a point or an exponent becomes a string of the text it is written as, because
/// a double would lose digits that quad can hold. InputError, with file and line, when the file is not TOML.
toml::table parse_toml(const std::filesystem::path& path);

/// A TOML table whose keys are checked. Each reading function notes the key it was asked for; finish() then
/// throws InputError for a key that nobody asked for and names the nearest known one. `where` begins every
/// message.
class Keys {
 public:
  Keys(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

  std::string text(std::string_view key, const std::string& fallback) {
    const toml::node* node = find(key);
    return node == nullptr ? fallback : scalar(*node, key);
  }
  /// The text of a key, made a value by read(text), whose InputError then names the place.
  template <class Read>
  auto read(std::string_view key, const std::string& fallback, Read&& read) {
    const std::string given = text(key, fallback);
    try {
      return read(given);
    } catch (const InputError& error) {
      refuse(key, error.what());
    }
  }
  /// Throws InputError about the value of a key, with its line.
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const {
    throw InputError(place(key) + ": key '" + std::string(key) + "': " + what);
  }
  /// The text of a key that holds a text; nothing where it is missing or holds anything else.
  std::optional<std::string> text_alone(std::string_view key) {
    const toml::node* node = find(key);
    const auto* text = node == nullptr ? nullptr : node->as_string();
    return text == nullptr ? std::nullopt : std::optional(text->get());
  }
  /// The texts of a key that holds a text or a list of texts; none where it holds anything else.
  std::vector<std::string> words(std::string_view key) {
    const toml::node* node = find(key);
    std::vector<std::string> texts;
    if (node == nullptr) return texts;
    if (const auto* text = node->as_string()) texts.push_back(text->get());
    if (const toml::array* list = node->as_array())
      for (const toml::node& item : *list)
        if (const auto* text = item.as_string()) texts.push_back(text->get());
    return texts;
  }
  /// True where the key is there and holds a table.
  [[nodiscard]] bool has_table(std::string_view key) const {
    const toml::node* node = table_.get(key);
    return node != nullptr && node->is_table();
  }
  /// The texts of a list, which must not be empty where the key is there.
  std::vector<std::string> some(std::string_view key, std::vector<std::string> fallback = {}) {
    std::vector<std::string> items = list(key, std::move(fallback));
    if (items.empty() && table_.get(key) != nullptr) refuse(key, "expected at least one");
    return items;
  }
  std::string required(std::string_view key) {
    if (table_.get(key) == nullptr) throw InputError(where_ + ": key '" + std::string(key) + "' is missing");
    return text(key, {});
  }
  std::vector<std::string> list(std::string_view key, std::vector<std::string> fallback = {}) {
    const toml::node* node = find(key);
    if (node == nullptr) return fallback;
    if (!node->is_array()) refuse(key, "expected a list");
    std::vector<std::string> items;
    for (const toml::node& item : *node->as_array()) items.push_back(scalar(item, key));
    return items;
  }
  /// A list that holds something where it is there; empty where it is not.
  std::vector<std::string> list_of_some(std::string_view key) {
    std::vector<std::string> items = list(key);
    if (items.empty() && table_.get(key) != nullptr)
      refuse(key, "expected a number at least, got an empty list");
    return items;
  }
  /// A list; a single item without brackets is a list of one.
  std::vector<std::string> one_or_more(std::string_view key) {
    const toml::node* node = table_.get(key);
    return node == nullptr || node->is_array() ? list(key) : std::vector<std::string>{text(key, {})};
  }
  Assignments assignments(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    if (!node->is_table()) refuse(key, "expected a table");
    Assignments result;
    for (const auto& [name, value] : *node->as_table())
      result.emplace_back(name.str(), scalar(value, name.str()));
    return result;
  }
  /// A table of which each value is a single one or a list of some.
  std::vector<std::pair<std::string, std::vector<std::string>>> assignment_lists(std::string_view key) {
    const toml::table* values = table(key);
    std::vector<std::pair<std::string, std::vector<std::string>>> result;
    if (values == nullptr) return result;
    for (const auto& [name, value] : *values) {
      if (const toml::array* list = value.as_array()) {
        std::vector<std::string>& items = result.emplace_back(name.str(), std::vector<std::string>()).second;
        for (const toml::node& item : *list) items.push_back(scalar(item, name.str()));
        if (items.empty())
          refuse(key, "'" + std::string(name.str()) + "': expected a value at least, got an empty list");
      } else {
        result.push_back({std::string(name.str()), {scalar(value, name.str())}});
      }
    }
    return result;
  }
  const toml::table* table(std::string_view key) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_table()) refuse(key, "expected a table");
    return node == nullptr ? nullptr : node->as_table();
  }
  /// The tables of an array [[key]]. InputError where there is none, unless `needed` is false.
  std::vector<const toml::table*> tables(std::string_view key, bool needed = true) {
    const toml::node* node = find(key);
    std::vector<const toml::table*> result;
    if (node == nullptr && !needed) return result;
    if (node == nullptr || !node->is_array_of_tables())
      throw InputError(where_ + ": expected at least one [[" + std::string(key) + "]]");
    for (const toml::node& item : *node->as_array()) result.push_back(item.as_table());
    return result;
  }
  void finish() const {
    for (const auto& [key, value] : table_) {
      const std::string name(key.str());
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end())
        throw InputError(place(name) + ": " + unknown_name("key", name, asked_));
    }
  }

 private:
  // Where a key stands, for messages: "FILE [[case]], line 7".
  [[nodiscard]] std::string place(std::string_view key) const {
    const auto entry = table_.find(key);
    return at(entry == table_.end() ? toml::source_region() : entry->first.source());
  }
  [[nodiscard]] std::string at(const toml::source_region& region) const {
    return where_ + (region.begin.line == 0 ? "" : ", line " + std::to_string(region.begin.line));
  }
  const toml::node* find(std::string_view key) {
    asked_.emplace_back(key);
    return table_.get(key);
  }
  std::string scalar(const toml::node& node, std::string_view key) const {
    if (const auto* s = node.as_string()) return s->get();
    if (const auto* i = node.as_integer()) return std::to_string(i->get());
    if (const auto* b = node.as_boolean()) return b->get() ? "yes" : "no";
    throw InputError(at(node.source()) + ": key '" + std::string(key) + "': expected a number or a string");
  }

  const toml::table& table_;
  std::string where_;
  std::vector<std::string> asked_;
};

}  // namespace pfaff
