#include <pfaff/papers/coverage/coverage.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

std::string to_string(ItemKind kind) {
  constexpr std::array<const char*, 10> names{"equation", "definition", "proposition", "theorem",
                                              "example",  "remark",     "table",       "figure",
                                              "number",   "statement"};
  return names[static_cast<std::size_t>(kind)];
}
std::string to_string(Cover cover) {
  constexpr std::array<const char*, 3> names{"rows", "reason", "pending"};
  return names[static_cast<std::size_t>(cover)];
}

namespace {

std::vector<std::string> split_at(const std::string& text, const std::string& at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(at, begin);
    parts.push_back(text.substr(begin, end - begin));
    if (end == std::string::npos) return parts;
    begin = end + at.size();
  }
}

// A numbered name taken apart: "(4.7)" is 7 of the series "(4.", "Theorem 2" is 2 of "Theorem ".
struct Numbered {
  std::string series;
  int number = 0;
};
// The number is 0 where the name has none at its end.
Numbered numbered(const std::string& name) {
  std::string text = name;
  if (text.ends_with(')')) text.pop_back();
  const std::size_t last = text.find_last_not_of("0123456789");
  Numbered result{text.substr(0, last == std::string::npos ? 0 : last + 1), 0};
  std::from_chars(text.data() + result.series.size(), text.data() + text.size(), result.number);
  return result;
}

// Statements and stated numbers have no numbering of their own.
bool counted(ItemKind kind) { return kind != ItemKind::number && kind != ItemKind::statement; }

void find_gaps(const std::vector<PaperItem>& items, std::vector<std::string>& faults) {
  std::map<std::pair<ItemKind, std::string>, int> last;
  for (const PaperItem& item : items) {
    const Numbered name = numbered(item.name);
    if (!counted(item.kind) || name.number == 0) continue;
    int& before = last[{item.kind, name.series}];
    for (int missing = before + 1; missing < name.number; ++missing)
      faults.push_back(item.place + ": " + to_string(item.kind) + " " + name.series +
                       std::to_string(missing) + (item.name.ends_with(')') ? ")" : "") + " is not listed");
    before = std::max(before, name.number);
  }
}

}  // namespace

std::vector<std::string> named_items(const std::string& equation, const std::vector<PaperItem>& items) {
  const auto place = [&](const std::string& name) {
    return std::find_if(items.begin(), items.end(), [&](const PaperItem& item) { return item.name == name; });
  };
  std::vector<std::string> names;
  for (const std::string& text : split_at(equation, ", ")) {
    const std::size_t dash = text.find(")-(");
    const auto first = dash == std::string::npos ? items.end() : place(text.substr(0, dash + 1)),
               last = dash == std::string::npos ? items.end() : place(text.substr(dash + 2));
    if (first == items.end() || last == items.end() || last < first) {
      names.push_back(text);
      continue;
    }
    for (auto item = first; item <= last; ++item)
      if (item->kind == first->kind) names.push_back(item->name);
  }
  return names;
}

std::size_t Coverage::count(Cover cover) const {
  return static_cast<std::size_t>(
      std::count_if(items.begin(), items.end(), [&](const CoveredItem& c) { return c.item.cover == cover; }));
}
std::size_t Coverage::count(ItemKind kind, Cover cover) const {
  return static_cast<std::size_t>(std::count_if(items.begin(), items.end(), [&](const CoveredItem& c) {
    return c.item.cover == cover && c.item.kind == kind;
  }));
}

Coverage coverage_of(const std::string& paper, const std::vector<PaperItem>& items,
                     const std::vector<ReproducedRow>& rows) {
  Coverage coverage{paper, {}, {}};
  find_gaps(items, coverage.faults);
  std::map<std::string, std::vector<std::string>> found;
  std::vector<std::string> known;
  const auto is_known = [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) != known.end();
  };
  const auto fault = [&](const PaperItem& item, const std::string& what) {
    coverage.faults.push_back(item.place + ": " + item.name + " " + what);
  };
  for (const PaperItem& item : items) {
    if (is_known(item.name)) fault(item, "is listed twice");
    known.push_back(item.name);
  }
  for (const ReproducedRow& row : rows)
    for (const std::string& name : named_items(row.equation, items)) {
      found[name].push_back(row.id);
      if (!is_known(name))
        coverage.faults.push_back("the row '" + row.id +
                                  "': " + unknown_name("item of " + paper, name, known));
    }
  for (const PaperItem& item : items) {
    const std::vector<std::string>& ids = found[item.name];
    coverage.items.push_back({item, ids});
    if (item.cover == Cover::rows && ids.empty()) fault(item, "has no row; expected one, or a reason");
    if (item.cover != Cover::rows && !ids.empty())
      fault(item, "has rows and is listed as " + to_string(item.cover));
  }
  return coverage;
}

nlohmann::json to_json(const Coverage& coverage) {
  nlohmann::json items = nlohmann::json::array(), counts;
  for (const CoveredItem& c : coverage.items) {
    items.push_back({{"item", c.item.name},
                     {"kind", to_string(c.item.kind)},
                     {"cover", to_string(c.item.cover)},
                     {"rows", c.rows},
                     {"note", c.item.note.empty() ? nlohmann::json(nullptr) : nlohmann::json(c.item.note)}});
  }
  for (const Cover cover : {Cover::rows, Cover::reason, Cover::pending})
    counts[to_string(cover)] = coverage.count(cover);
  return {{"paper", coverage.paper},
          {"ok", coverage.faults.empty()},
          {"counts", counts},
          {"items", items},
          {"faults", coverage.faults}};
}

void put_in_order(std::vector<ReproducedRow>& rows, const std::vector<PaperItem>& items) {
  const auto place = [&](const ReproducedRow& row) {
    const std::string first = named_items(row.equation, items).front();
    return std::find_if(items.begin(), items.end(),
                        [&](const PaperItem& item) { return item.name == first; }) -
           items.begin();
  };
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const ReproducedRow& a, const ReproducedRow& b) { return place(a) < place(b); });
}

}  // namespace pfaff
