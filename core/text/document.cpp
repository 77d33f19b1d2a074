#include <pfaff/core/text/document.hpp>

#include <algorithm>

#include <toml++/toml.h>

#include <pfaff/core/process/input_file.hpp>

namespace pfaff::text {

namespace {
using Kind = Item::Kind;

// The lines of a file. Columns count characters, from 1.
class Lines {
 public:
  explicit Lines(const std::string& contents) : contents_(contents) {
    begins_.push_back(0);
    for (std::size_t k = 0; k < contents.size(); ++k)
      if (contents[k] == '\n') begins_.push_back(k + 1);
  }
  // Where a place is in the contents, in bytes.
  [[nodiscard]] std::size_t offset(std::size_t line, std::size_t column) const {
    std::size_t at = line <= begins_.size() && line > 0 ? begins_[line - 1] : contents_.size();
    for (std::size_t k = 1; k < column && at < contents_.size(); ++k) {
      ++at;
      while (at < contents_.size() && (static_cast<unsigned char>(contents_[at]) & 0xC0U) == 0x80U) ++at;
    }
    return std::min(at, contents_.size());
  }
  // The contents from a place on.
  [[nodiscard]] std::string_view from(std::size_t line, std::size_t column) const {
    return std::string_view(contents_).substr(offset(line, column));
  }
  // The same, to the end of the line.
  [[nodiscard]] std::string rest(std::size_t line, std::size_t column) const {
    const std::string_view text = from(line, column);
    return std::string(text.substr(0, text.find_first_of("\r\n")));
  }

 private:
  const std::string& contents_;
  std::vector<std::size_t> begins_;
};

// Makes values of toml++'s nodes. The place of a text is that of its first character, behind the quotation
// marks; of texts with escapes, the columns behind these are those of the text that they make.
class Reader {
 public:
  Reader(std::string path, const std::string& contents, const Lines& lines)
      : path_(std::move(path)), contents_(contents), lines_(lines) {}

  [[nodiscard]] Item value(const toml::node& node, int depth = 0) const {
    const toml::source_region& region = node.source();
    Item result;
    result.source = {{}, path_, region.begin.line, region.begin.column};
    constexpr int deepest = 64;
    if (depth > deepest) refuse(result, "lists and tables are too deep inside one another");
    if (depth > 0) result.source.text = lines_.rest(region.begin.line, region.begin.column);
    if (const auto* table = node.as_table()) {
      result.kind = Kind::table;
      for (const auto& [key, item] : *table)
        result.members.push_back({std::string(key.str()), key_place(key), value(item, depth + 1)});
      std::stable_sort(result.members.begin(), result.members.end(), [](const Member& a, const Member& b) {
        return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
      });
    } else if (const auto* list = node.as_array()) {
      result.kind = Kind::list;
      for (const toml::node& item : *list) result.items.push_back(value(item, depth + 1));
    } else if (const auto* text = node.as_string()) {
      result.kind = Kind::text;
      result.source.text = text->get();
      skip_quotation_marks(result.source);
    } else if (const auto* integer = node.as_integer()) {
      result.kind = Kind::number;
      result.whole = true;
      result.source.text = std::to_string(integer->get());
    } else if (node.is_floating_point()) {
      result.kind = Kind::number;
      result.source.text = digits(region);
    } else if (const auto* truth = node.as_boolean()) {
      result.kind = Kind::truth;
      result.source.text = truth->get() ? "true" : "false";
    }
    return result;
  }

 private:
  // What is written for a number; underscores only separate its digits.
  [[nodiscard]] std::string digits(const toml::source_region& region) const {
    const std::size_t begin = lines_.offset(region.begin.line, region.begin.column);
    std::string text = contents_.substr(begin, lines_.offset(region.end.line, region.end.column) - begin);
    std::erase(text, '_');
    return text;
  }
  [[nodiscard]] Source key_place(const toml::key& key) const {
    return {std::string(key.str()), path_, key.source().begin.line, key.source().begin.column};
  }
  void skip_quotation_marks(Source& source) const {
    const std::string_view written = lines_.from(source.line, source.column);
    const bool several = written.starts_with("\"\"\"") || written.starts_with("'''");
    source.column += several ? 3 : 1;
    // A line break behind the opening marks is no part of the text.
    if (several && (written.substr(3).starts_with("\n") || written.substr(3).starts_with("\r\n"))) {
      ++source.line;
      source.column = 1;
    }
  }

  std::string path_;
  const std::string& contents_;
  const Lines& lines_;
};
}  // namespace

Document read_document(const std::string& path) {
  Document document{path, read_file(path), {}};
  const Lines lines(document.contents);
  try {
    const toml::table root = toml::parse(document.contents, path);
    document.root = Reader(path, document.contents, lines).value(root);
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    const std::size_t begin = lines.offset(at.line, 1);
    std::string description(error.description());
    if (description.find("could not determine value type") != std::string::npos)
      description += "; expected a number, or an expression in quotation marks";
    refuse({lines.rest(at.line, 1), path, at.line, 1}, lines.offset(at.line, at.column) - begin, description);
  }
  return document;
}

void refuse(const Item& value, const std::string& message) { refuse(value.source, 0, message); }

Expression expression_of(const Item& value, const std::string& what) {
  if (value.kind != Kind::text && value.kind != Kind::number)
    refuse(value, what + ": expected an expression, in quotation marks, or a number");
  return Expression(value.source);
}

std::vector<Expression> expressions_of(const Item& value, const std::string& what) {
  if (value.kind != Kind::list) refuse(value, what + ": expected a list of expressions");
  std::vector<Expression> list;
  for (const Item& item : value.items) list.push_back(expression_of(item, what));
  return list;
}

const std::string& text_of(const Item& value, const std::string& what) {
  if (value.kind != Kind::text) refuse(value, what + ": expected a text in quotation marks");
  return value.source.text;
}

bool truth_of(const Item& value, const std::string& what) {
  if (value.kind != Kind::truth) refuse(value, what + ": expected true or false");
  return value.source.text == "true";
}

Table::Table(const Item& value, std::string what) : value_(value), what_(std::move(what)) {
  if (value.kind != Kind::table) refuse(value, what_ + ": expected a table");
}

const Item* Table::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  const auto found = std::find_if(value_.members.begin(), value_.members.end(),
                                  [&](const Member& member) { return member.key == key; });
  return found == value_.members.end() ? nullptr : &found->value;
}

const Item& Table::required(std::string_view key) {
  if (const Item* value = find(key)) return *value;
  refuse(value_, what_ + ": the key '" + std::string(key) + "' is missing");
}

std::string Table::text(std::string_view key, const std::string& fallback) {
  const Item* value = find(key);
  return value == nullptr ? fallback : text_of(*value, std::string(key));
}

void Table::finish() const {
  for (const Member& member : value_.members)
    if (std::find(asked_.begin(), asked_.end(), member.key) == asked_.end())
      refuse(member.place, 0, unknown_name("key", member.key, asked_) + " (of " + what_ + ")");
}

}  // namespace pfaff::text
