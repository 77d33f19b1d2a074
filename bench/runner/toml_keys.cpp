#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

namespace {
// The text of a value that stands on one line; columns count characters, not bytes, from 1. Underscores
// between digits are left out.
std::string written(const std::string& text, const toml::source_region& region) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < region.begin.line; ++line) at = text.find('\n', at) + 1;
  const auto begins_character = [&](std::size_t k) {
    return (static_cast<unsigned char>(text[k]) & 0xC0U) != 0x80U;
  };
  std::string found;
  for (toml::source_index column = 0; at < text.size(); ++at) {
    column += begins_character(at) ? 1 : 0;
    if (column >= region.end.column) break;
    if (column >= region.begin.column && text[at] != '_') found += text[at];
  }
  return found;
}

// Replaces floating-point numbers by the text they are written as.
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
