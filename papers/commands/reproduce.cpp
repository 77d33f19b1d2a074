// The command reproduce: prints the values printed in a paper beside those computed here, and what of the
// papers is covered.
#include <algorithm>
#include <array>
#include <iostream>
#include <map>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/papers/commands/commands.hpp>
#include <pfaff/papers/coverage/coverage.hpp>

namespace pfaff {

namespace {

std::vector<std::string> chosen_papers(const ReproductionOptions& options) {
  return options.paper.empty() ? papers() : std::vector<std::string>{options.paper};
}

// Rows on lines of four columns, whose widths are the same in the whole output, and those that are too wide
// for one in blocks of lines between them. A line says nothing of the difference, which is seen.
class RowPrinter {
 public:
  explicit RowPrinter(std::size_t columns)
      : columns_(columns),
        value_((columns - status_ - 3 * gap_) * 2 / 7),
        id_(columns - status_ - 3 * gap_ - 2 * value_) {}

  [[nodiscard]] std::string head() const { return line("published", "printed", "ours", "status"); }
  [[nodiscard]] std::string row(const ReproducedRow& row) const {
    if (row.id.size() <= id_ && row.printed.size() <= value_ && row.ours.size() <= value_)
      return line(row.id, row.printed, row.ours, row.status);
    TableRows block{{"  printed", row.printed}, {"  ours", row.ours}};
    if (!row.evidence.printed.empty()) block.push_back({"  difference", difference(row)});
    block.push_back({"  status", row.status});
    return paragraph(row.id, columns_) + table(block, {}, columns_);
  }

 private:
  [[nodiscard]] std::string line(const std::string& id, const std::string& printed, const std::string& ours,
                                 const std::string& status) const {
    const std::string gap(gap_, ' ');
    return printable(padded(id, id_) + gap + padded(printed, value_) + gap + padded(ours, value_) + gap +
                     status) +
           '\n';
  }
  static std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.resize(width, ' ');
    return text;
  }
  // Rounding noise is no difference.
  static std::string difference(const ReproducedRow& row) {
    return row.difference <= at_round_off ? "0" : formatted("%.1e", row.difference);
  }

  static constexpr std::size_t gap_ = 2, status_ = 11;  // "qualitative"
  std::size_t columns_, value_, id_;
};

// What is said of misprints and of rows without numbers, each once, by the item that it speaks of.
TableRows notes_of(const std::vector<ReproducedRow>& rows) {
  TableRows notes;
  for (const ReproducedRow& r : rows) {
    if (r.erratum.empty()) continue;
    const std::vector<std::string> note{
        r.status, r.erratum.starts_with(r.equation) ? r.erratum : r.id + ": " + r.erratum};
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
  return notes;
}

void print_rows(const std::string& paper, const std::vector<ReproducedRow>& rows) {
  const std::size_t columns = std::min<std::size_t>(80, terminal_columns());
  const auto count = [&](const char* status) {
    return std::to_string(
        std::count_if(rows.begin(), rows.end(), [&](const ReproducedRow& r) { return r.status == status; }));
  };
  const RowPrinter printer(columns);
  std::cout << paper << '\n' << printer.head();
  for (const ReproducedRow& r : rows) std::cout << printer.row(r);
  std::cout << '\n'
            << table(notes_of(rows), {}, columns) << '\n'
            << paragraph(std::to_string(rows.size()) + " rows: " + count("reproduced") + " reproduced, " +
                             count("improved") + " improved, " + count("erratum") + " errata, " +
                             count("qualitative") + " qualitative" + (ok(rows) ? "" : ", the rest FAILED"),
                         columns);
}

// What can be reproduced, without doing it: of every paper the number of its items, or every item of one.
void print_list(const ReproductionOptions& options) {
  std::vector<std::vector<std::string>> lines;
  if (options.paper.empty()) {
    lines.push_back({"paper", "items", "with rows"});
    for (const std::string& paper : papers()) {
      const std::vector<PaperItem> items = items_of(paper);
      const auto rows = std::count_if(items.begin(), items.end(),
                                      [](const PaperItem& item) { return item.cover == Cover::rows; });
      lines.push_back({paper, std::to_string(items.size()), std::to_string(rows)});
    }
  } else {
    lines.push_back({options.paper, "kind", "dealt with by"});
    for (const PaperItem& item : items_of(options.paper))
      lines.push_back({item.name, to_string(item.kind),
                       to_string(item.cover) + (item.note.empty() ? "" : ": " + item.note)});
  }
  std::cout << table(lines);
}
nlohmann::json list_json(const ReproductionOptions& options) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::string& paper : chosen_papers(options)) {
    nlohmann::json items = nlohmann::json::array();
    for (const PaperItem& item : items_of(paper))
      items.push_back(
          {{"item", item.name}, {"kind", to_string(item.kind)}, {"cover", to_string(item.cover)}});
    list.push_back({{"paper", paper}, {"items", items}});
  }
  return {{"schema", 1}, {"papers", list}};
}

// A cell of at most `limit` characters.
std::string fitted(const std::string& text, std::size_t limit) {
  return text.size() > limit ? text.substr(0, limit - 2) + ".." : text;
}

void print_coverage(const Coverage& coverage) {
  std::vector<std::vector<std::string>> counts{{coverage.paper, "items", "rows", "reason", "pending"}};
  const auto add = [&](const std::string& name, const std::array<std::size_t, 3>& numbers) {
    counts.push_back({name, std::to_string(numbers[0] + numbers[1] + numbers[2]), std::to_string(numbers[0]),
                      std::to_string(numbers[1]), std::to_string(numbers[2])});
  };
  for (int k = 0; k <= static_cast<int>(ItemKind::statement); ++k) {
    const auto kind = static_cast<ItemKind>(k);
    const std::array<std::size_t, 3> numbers{coverage.count(kind, Cover::rows),
                                             coverage.count(kind, Cover::reason),
                                             coverage.count(kind, Cover::pending)};
    if (numbers[0] + numbers[1] + numbers[2] > 0) add("  " + to_string(kind), numbers);
  }
  add("  all", {coverage.count(Cover::rows), coverage.count(Cover::reason), coverage.count(Cover::pending)});
  std::cout << table(counts);
  std::vector<std::vector<std::string>> without;
  for (const CoveredItem& c : coverage.items)
    if (c.item.cover != Cover::rows)
      without.push_back({"  " + fitted(c.item.name, 24), to_string(c.item.cover), fitted(c.item.note, 42)});
  std::cout << table(without);
  for (const std::string& fault : coverage.faults) std::cout << paragraph("FAULT " + fault);
  std::cout << '\n';
}

// One JSON value: that of the paper, or of all papers together.
void print_json(const ReproductionOptions& options, const nlohmann::json& papers, bool good) {
  nlohmann::json all{{"schema", 1}};
  if (options.paper.empty()) {
    all["ok"] = good;
    all["papers"] = papers;
  } else {
    all.update(papers.front());
  }
  std::cout << json_text(all);
}

}  // namespace

int reproduce_command(const ReproductionOptions& options, const Common& common) {
  if (options.paper.empty() && !options.section.empty())
    throw InputError("--section " + options.section +
                     ": expected a paper before it, because sections are a paper's");
  if (options.coverage && !options.section.empty())
    throw InputError("--section and --coverage exclude each other: the coverage is that of a whole paper");
  if (options.list) {
    if (options.coverage || !options.section.empty())
      throw InputError("--list: expected neither --coverage nor --section beside it");
    if (common.json) {
      std::cout << json_text(list_json(options));
    } else {
      print_list(options);
    }
    return 0;
  }
  const Interruption interruption;
  bool good = true;
  nlohmann::json all = nlohmann::json::array();
  const std::vector<std::string> chosen = chosen_papers(options);
  std::map<std::string, std::vector<PaperItem>> items;  // of all papers before the first is computed
  for (const std::string& paper : chosen) items[paper] = items_of(paper);
  std::size_t done = 0;
  for (const std::string& paper : chosen) {
    if (options.coverage) {
      const Coverage coverage = coverage_of(paper, items[paper], reproduce(paper, ""));
      good = good && coverage.faults.empty();
      if (common.json) {
        all.push_back(to_json(coverage));
      } else if (!common.quiet || !coverage.faults.empty()) {
        print_coverage(coverage);
      }
      continue;
    }
    std::vector<ReproducedRow> rows;
    try {
      rows = reproduce(paper, options.section);
      put_in_order(rows, items[paper]);
    } catch (const BudgetSpent& spent) {
      end_interrupted(spent, std::to_string(done) + " of " + std::to_string(chosen.size()) +
                                 " papers were reproduced, and " + paper + " was not finished");
    }
    ++done;
    good = good && ok(rows);
    if (common.json) {
      all.push_back(to_json(paper, rows));
    } else if (!common.quiet || !ok(rows)) {
      print_rows(paper, rows);
    }
  }
  if (common.json) print_json(options, all, good);
  return good ? 0 : 1;
}

}  // namespace pfaff
