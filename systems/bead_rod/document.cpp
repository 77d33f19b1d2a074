#include <pfaff/systems/bead_rod/document.hpp>

#include <algorithm>
#include <filesystem>

#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/process/input_file.hpp>
#include <pfaff/core/registry/source_text.hpp>
#include <pfaff/core/text/source.hpp>

namespace pfaff {

namespace {
using Kind = DocumentNode::Kind;

DocumentNode scalar(Kind kind, std::string text) {
  DocumentNode node;
  node.kind = kind;
  node.text = std::move(text);
  return node;
}
DocumentNode container(Kind kind) { return scalar(kind, {}); }

DocumentNode from_toml(const toml::node& node, const std::string& text) {
  if (const auto* table = node.as_table()) {
    DocumentNode result = container(Kind::table);
    for (const auto& [key, value] : *table)
      result.members.push_back({std::string(key.str()), from_toml(value, text)});
    return result;
  }
  if (const auto* list = node.as_array()) {
    DocumentNode result = container(Kind::list);
    for (const toml::node& item : *list) result.items.push_back(from_toml(item, text));
    return result;
  }
  if (const auto* s = node.as_string()) return scalar(Kind::text, s->get());
  if (const auto* i = node.as_integer()) return scalar(Kind::number, std::to_string(i->get()));
  if (node.is_floating_point()) {
    const toml::source_region& at = node.source();
    return scalar(Kind::number, source_text(text, at.begin.line, at.begin.column, at.end.column));
  }
  return container(Kind::other);
}

// Builds the document while nlohmann's parser reads, which is when numbers still have their digits.
class JsonReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonReader(const std::string& path, const std::string& text) : path_(path), text_(text) {}
  [[nodiscard]] DocumentNode take() { return std::move(root_); }

  bool null() override { return add(container(Kind::other)); }
  bool boolean(bool /*value*/) override { return add(container(Kind::other)); }
  bool number_integer(number_integer_t value) override {
    return add(scalar(Kind::number, std::to_string(value)));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add(scalar(Kind::number, std::to_string(value)));
  }
  bool number_float(number_float_t /*value*/, const string_t& text) override {
    return add(scalar(Kind::number, text));
  }
  bool string(string_t& value) override { return add(scalar(Kind::text, value)); }
  bool binary(binary_t& /*value*/) override { return add(container(Kind::other)); }
  bool start_object(std::size_t /*size*/) override { return open(Kind::table); }
  bool key(string_t& value) override {
    auto& members = open_.back()->members;
    if (std::any_of(members.begin(), members.end(), [&](const auto& m) { return m.key == value; }))
      throw InputError(path_ + ": key '" + value + "' is there twice");
    members.push_back({value, {}});
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override { return open(Kind::list); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& /*error*/) override {
    text::refuse_json({text_, path_}, position, token, "expected JSON");
  }

 private:
  DocumentNode& place() {
    if (open_.empty()) return root_;
    DocumentNode& parent = *open_.back();
    if (parent.kind == Kind::table) return parent.members.back().value;
    return parent.items.emplace_back();
  }
  bool add(DocumentNode node) {
    place() = std::move(node);
    return true;
  }
  // An open node stays where it is: only the last item or member of a node is ever open.
  // Values are destroyed by a function that calls itself for each level, so there is a limit to these.
  bool open(Kind kind) {
    constexpr std::size_t deepest = 64;
    if (open_.size() == deepest)
      throw InputError(path_ + ": expected at most " + std::to_string(deepest) +
                       " lists and tables inside one another");
    DocumentNode& node = place();
    node = container(kind);
    open_.push_back(&node);
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& path_;
  const std::string& text_;
  DocumentNode root_;
  std::vector<DocumentNode*> open_;
};
}  // namespace

DocumentNode read_document(const std::string& path) {
  const std::string text = read_file(path);
  if (std::filesystem::path(path).extension() == ".json") {
    JsonReader reader(path, text);
    nlohmann::json::sax_parse(text, &reader);
    return reader.take();
  }
  try {
    const toml::table root = toml::parse(text, path);
    return from_toml(root, text);
  } catch (const toml::parse_error& e) {
    throw InputError(path + ":" + std::to_string(e.source().begin.line) + ": " +
                     std::string(e.description()));
  }
}

}  // namespace pfaff
