// The items of papers as their files list them.
#include <pfaff/bench/runner/toml_keys.hpp>
#include <pfaff/papers/coverage/coverage.hpp>

namespace pfaff {

std::vector<PaperItem> read_items(const std::filesystem::path& path) {
  const toml::table root = parse_toml(path);
  const std::string file = path.filename().string();
  Keys keys(root, file);
  std::vector<PaperItem> items;
  for (const toml::table* table : keys.tables("items")) {
    Keys entry(*table, file);
    PaperItem item;
    item.place = file + ", line " + std::to_string(table->source().begin.line);
    for (const Cover cover : {Cover::reason, Cover::pending}) {
      const std::string key = to_string(cover);
      if (!table->contains(key)) continue;
      if (item.cover != Cover::rows) entry.refuse(key, "expected a reason or what is pending, not both");
      item.cover = cover;
      item.note = entry.required(key);
      if (item.note.empty()) entry.refuse(key, "expected why there are no rows, got an empty text");
    }
    std::vector<std::string> names;
    for (int k = 0; k <= static_cast<int>(ItemKind::statement); ++k) {
      const auto kind = static_cast<ItemKind>(k);
      const std::vector<std::string> of_kind = entry.one_or_more(to_string(kind));
      if (of_kind.empty()) continue;
      if (!names.empty())
        entry.refuse(to_string(kind), "expected one kind, got " + to_string(item.kind) + " too");
      names = of_kind;
      item.kind = kind;
    }
    entry.finish();
    if (names.empty()) throw InputError(item.place + ": expected names of a kind, such as equation = '(1)'");
    for (std::string& name : names) {
      item.name = std::move(name);
      items.push_back(item);
    }
  }
  keys.finish();
  return items;
}

std::vector<PaperItem> items_of(const std::string& paper) {
  (void)paper_named(paper);  // refuses an unknown one
  return read_items(shipped_path("papers/coverage") / (paper + ".toml"));
}

}  // namespace pfaff
