// TOML tables whose keys are checked, for experiments and run configurations.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// Parses a file. Numbers with a point or an exponent become the strings they are written as: a double would
/// lose digits that quad has. InputError with file and line when it is not TOML.
toml::table parse_toml(const std::filesystem::path& path);

/// A table whose keys are checked: what is not asked for by finish() is an error that names the nearest key.
class Keys {
 public:
  Keys(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

  std::string text(std::string_view key, const std::string& fallback) {
    const toml::node* node = find(key);
    return node == nullptr ? fallback : scalar(*node, key);
  }
  std::string required(std::string_view key) {
    if (table_.get(key) == nullptr) throw InputError(where_ + ": key '" + std::string(key) + "' is missing");
    return text(key, {});
  }
  std::vector<std::string> list(std::string_view key, std::vector<std::string> fallback = {}) {
    const toml::node* node = find(key);
    if (node == nullptr) return fallback;
    if (!node->is_array()) throw InputError(where_ + ": key '" + std::string(key) + "': expected a list");
    std::vector<std::string> items;
    for (const toml::node& item : *node->as_array()) items.push_back(scalar(item, key));
    return items;
  }
  /// A list, or one item of it alone.
  std::vector<std::string> one_or_more(std::string_view key) {
    const toml::node* node = table_.get(key);
    return node == nullptr || node->is_array() ? list(key) : std::vector<std::string>{text(key, {})};
  }
  Assignments assignments(std::string_view key) {
    const toml::node* node = find(key);
    if (node == nullptr) return {};
    if (!node->is_table()) throw InputError(where_ + ": key '" + std::string(key) + "': expected a table");
    Assignments result;
    for (const auto& [name, value] : *node->as_table())
      result.emplace_back(name.str(), scalar(value, name.str()));
    return result;
  }
  const toml::table* table(std::string_view key) {
    const toml::node* node = find(key);
    if (node != nullptr && !node->is_table())
      throw InputError(where_ + ": key '" + std::string(key) + "': expected a table");
    return node == nullptr ? nullptr : node->as_table();
  }
  /// At least one [[key]], unless none is needed.
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
        throw InputError(where_ + ": " + unknown_name("key", name, asked_));
    }
  }

 private:
  const toml::node* find(std::string_view key) {
    asked_.emplace_back(key);
    return table_.get(key);
  }
  std::string scalar(const toml::node& node, std::string_view key) const {
    if (const auto* s = node.as_string()) return s->get();
    if (const auto* i = node.as_integer()) return std::to_string(i->get());
    if (const auto* b = node.as_boolean()) return b->get() ? "yes" : "no";
    throw InputError(where_ + ": key '" + std::string(key) + "': expected a number or a string");
  }

  const toml::table& table_;
  std::string where_;
  std::vector<std::string> asked_;
};

}  // namespace pfaff
