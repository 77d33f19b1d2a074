// What of a paper is rebuilt: every numbered equation, definition, proposition, theorem, example, table and
// figure and every stated number has rows in the reproduction, or a reason why it cannot have one, or is
// pending.
//
// The items of a paper are data, a file for each paper in this folder that is read with the rows:
//
//   items = [
//     { equation = ["(1)", "(2)"] },
//     { definition = "Definition 1", reason = "of (3)" },
//     { equation = "(3)", pending = "needs a second system" },
//   ]
//
// A kind (ItemKind) is the key of names, in the order of the paper. Whether an item has rows is not said
// there but found: rows name their items (ReproducedRow::equation).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/papers/reproduce.hpp>

namespace pfaff {

enum class ItemKind {
  equation,
  definition,
  proposition,
  theorem,
  example,
  remark,
  table,
  figure,
  number,
  statement
};
std::string to_string(ItemKind kind);

/// How an item of a paper is dealt with.
enum class Cover {
  rows,    // it has rows
  reason,  // it cannot have one, for a reason that is given
  pending  // it will have rows, and has none yet
};
std::string to_string(Cover cover);

/// One item, as the paper calls it, in the order of the paper.
struct PaperItem {
  std::string name;
  ItemKind kind = ItemKind::equation;
  Cover cover = Cover::rows;
  std::string note = {};   // the reason, or what is pending; empty where there are rows
  std::string place = {};  // where it is listed: "su-qin.toml, line 12"
};

/// The items that a file lists. InputError, with file and line, where it is not as above.
std::vector<PaperItem> read_items(const std::filesystem::path& path);
/// Puts rows in the order of the paper, by the first item that each names. Sections write theirs by subject.
void put_in_order(std::vector<ReproducedRow>& rows, const std::vector<PaperItem>& items);
/// The items of a paper; InputError for an unknown name too.
std::vector<PaperItem> items_of(const std::string& paper);

/// An item with the rows that name it, by their ids.
struct CoveredItem {
  PaperItem item;
  std::vector<std::string> rows;
};

struct Coverage {
  std::string paper;
  std::vector<CoveredItem> items;
  /// What is wrong, one line each, with its place: a gap in the numbers of equations or the like, an item
  /// without rows and without a reason, a reason for an item that has rows, an item listed twice, a row that
  /// names no item.
  std::vector<std::string> faults;

  /// How many items of a kind, or of every kind, are dealt with in one way.
  [[nodiscard]] std::size_t count(Cover cover) const;
  [[nodiscard]] std::size_t count(ItemKind kind, Cover cover) const;
};

/// The items that a row names: "(4.7)", "(1), (7), (16)" or a range "(3.8)-(3.10)" in the order of `items`.
/// A name that is no item is returned as it is.
std::vector<std::string> named_items(const std::string& equation, const std::vector<PaperItem>& items);

/// The coverage of `items` by `rows`.
Coverage coverage_of(const std::string& paper, const std::vector<PaperItem>& items,
                     const std::vector<ReproducedRow>& rows);

/// {paper, ok, counts {rows, reason, pending}, items [{item, kind, cover, rows, note}], faults}.
nlohmann::json to_json(const Coverage& coverage);

}  // namespace pfaff
