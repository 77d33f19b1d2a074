// What TOML and JSON files have in common: numbers as they are written, texts, lists and tables.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

struct DocumentMember;

/// A value of a document.
struct DocumentNode {
  enum class Kind { number, text, list, table, other };
  Kind kind = Kind::other;
  std::string text;                     // of numbers and texts
  std::vector<DocumentNode> items;      // of lists
  std::vector<DocumentMember> members;  // of tables
};
/// A key of a table, and its value.
struct DocumentMember {
  std::string key;
  DocumentNode value;
};

/// Reads a file; JSON where the name ends in .json, else TOML. InputError "PATH:LINE: ..." where it is
/// neither.
DocumentNode read_document(const std::string& path);

}  // namespace pfaff
