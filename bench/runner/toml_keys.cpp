#include <pfaff/bench/runner/toml_keys.hpp>

#include <pfaff/core/registry/source_text.hpp>

namespace pfaff {

namespace {
// The text of a value as the file writes it; values stand on one line.
std::string written(const std::string& text, const toml::source_region& region) {
  return source_text(text, region.begin.line, region.begin.column, region.end.column);
}

// Replaces floating-point numbers by strings with the text they are written as.
void keep_digits(toml::array& array, const std::string& text);
void keep_digits(toml::table& table, const std::string& text) {
  for (auto&& [key, node] : table) {
    if (auto* inner = node.as_table()) {
      keep_digits(*inner, text);
    } else if (auto* list = node.as_array()) {
      keep_digits(*list, text);
    } else if (node.is_floating_point()) {
      table.insert_or_assign(key, written(text, node.source()));
    }
  }
}
void keep_digits(toml::array& array, const std::string& text) {
  for (auto place = array.begin(); place != array.end(); ++place) {
    if (auto* inner = place->as_table()) {
      keep_digits(*inner, text);
    } else if (auto* list = place->as_array()) {
      keep_digits(*list, text);
    } else if (place->is_floating_point()) {
      array.replace(place, written(text, place->source()));
    }
  }
}
}  // namespace

toml::table parse_toml(const std::filesystem::path& path) {
  try {
    const std::string text = read_file(path);
    toml::table root = toml::parse(text, path.string());
    keep_digits(root, text);
    return root;
  } catch (const toml::parse_error& e) {
    throw InputError(path.string() + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
}

}  // namespace pfaff
