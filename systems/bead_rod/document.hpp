// What TOML and JSON files have in common: numbers as they are written, texts, lists and tables.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pfaff {

/// A value of a document.
struct DocumentNode {
  enum class Kind { number, text, list, table, other };
  Kind kind = Kind::other;
  std::string text;                                           // of numbers and texts
  std::vector<DocumentNode> items;                            // of lists
  std::vector<std::pair<std::string, DocumentNode>> members;  // of tables
};

/// Reads a file; JSON where the name ends in .json, else TOML. InputError "PATH:LINE: ..." where it is
/// neither.
DocumentNode read_document(const std::string& path);

}  // namespace pfaff
