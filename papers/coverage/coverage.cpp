#include <pfaff/papers/coverage/coverage.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

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
      faults.push_back(to_string(item.kind) + " " + name.series + std::to_string(missing) +
                       (item.name.ends_with(')') ? ")" : "") + " is not listed");
    before = std::max(before, name.number);
  }
}

}  // namespace

const std::vector<PaperItem>& items_of(const std::string& paper) {
  switch (paper_named(paper)) {
    case Paper::su_qin:
      return su_qin_items();
    case Paper::nguyen_turski:
      return nguyen_turski_items();
    case Paper::pitanga_rodrigues:
      return pitanga_rodrigues_items();
    case Paper::others:
      break;
  }
  return others_items();
}

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
  std::set<std::string> known;
  for (const PaperItem& item : items)
    if (!known.insert(item.name).second) coverage.faults.push_back(item.name + " is listed twice");
  for (const ReproducedRow& row : rows)
    for (const std::string& name : named_items(row.equation, items)) {
      found[name].push_back(row.id);
      if (!known.contains(name))
        coverage.faults.push_back("the row '" + row.id + "' names " + name + ", which is not listed");
    }
  for (const PaperItem& item : items) {
    const std::vector<std::string>& ids = found[item.name];
    coverage.items.push_back({item, ids});
    if (item.cover == Cover::rows && ids.empty())
      coverage.faults.push_back(item.name + " has no row; expected one, or a reason");
    if (item.cover != Cover::rows && !ids.empty())
      coverage.faults.push_back(item.name + " has rows and is listed as " + to_string(item.cover));
    if ((item.cover == Cover::rows) != item.note.empty())
      coverage.faults.push_back(item.name + (item.note.empty() ? ": the reason is missing"
                                                               : " has rows and a reason for having none"));
  }
  return coverage;
}
Coverage coverage_of(const std::string& paper) {
  return coverage_of(paper, items_of(paper), reproduce(paper, ""));
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

}  // namespace pfaff
