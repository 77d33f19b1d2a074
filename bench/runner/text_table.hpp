// Text that a person reads in a terminal: made printable, in tables and paragraphs that fit its columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pfaff {

/// Text that a terminal shows and does not obey: control characters, which could move the cursor, change
/// colours or the window's title, and bytes that are no UTF-8 become U+FFFD, tabulators blanks. Line ends are
/// kept.
std::string printable(std::string_view text);

/// The columns that lines may take: the environment's COLUMNS, else those of the terminal on standard output,
/// else 100, since a file has none. Never fewer than 40.
std::size_t terminal_columns();

/// Rows of cells.
using TableRows = std::vector<std::vector<std::string>>;

/// The rows as a table with the first row as header, of which no line is longer than `columns`. Columns are
/// as wide as their texts where that fits. Otherwise the texts of the widest are wrapped between words; then
/// the columns with the heads in `dispensable` are left out one after another, which a line below the table
/// says; then words are broken behind hyphens; and where all that does not suffice, every row becomes a block
/// of lines, one for each column. Cells are made printable.
std::string table(const TableRows& rows, const std::vector<std::string>& dispensable = {},
                  std::size_t columns = terminal_columns());

/// Rows of a name and a text, without a header. Texts are wrapped between words; words that are too long for
/// a line, such as the names of files, stay whole.
std::string facts(const TableRows& rows, std::size_t columns = terminal_columns());

/// Text as printable lines of at most 80 columns, fewer in a narrower terminal, broken between words.
std::string paragraph(const std::string& text, std::size_t columns = terminal_columns());

}  // namespace pfaff
