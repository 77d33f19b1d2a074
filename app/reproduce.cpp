// pfaff reproduce: a paper's printed values beside ours.
#include <array>
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/reproduce/reproduce.hpp>

namespace pfaff::app {

namespace {
int run(const std::string& paper, const std::string& section, bool json) {
  bool good = true;
  for (const std::string& name : paper.empty() ? papers() : std::vector<std::string>{paper}) {
    const auto rows = reproduce(name, section);
    good = good && ok(rows);
    if (json) {
      std::cout << to_json(name, rows).dump(1) << '\n';
      continue;
    }
    std::vector<std::vector<std::string>> lines{{"published", "printed", "ours", "difference", "status"}};
    const auto shortened = [](const std::string& text) {
      return text.size() > 20 ? text.substr(0, 18) + ".." : text;
    };
    int reproduced = 0, errata = 0, qualitative = 0;
    for (const ReproducedRow& r : rows) {
      std::array<char, 32> difference{};
      std::snprintf(difference.data(), difference.size(), "%.1e", r.difference);
      std::string id = r.id;
      if (id.size() > 34) id = id.substr(0, 32) + "..";
      lines.push_back({id, shortened(r.printed), shortened(r.ours), difference.data(), r.status});
      reproduced += r.status == "reproduced";
      errata += r.status == "erratum";
      qualitative += r.status == "qualitative";
    }
    std::cout << name << '\n' << table(lines);
    std::vector<std::vector<std::string>> notes;
    for (const ReproducedRow& r : rows)
      if (!r.erratum.empty()) notes.push_back({r.status, r.id + ": " + r.erratum});
    std::cout << table(notes) << '\n'
              << rows.size() << " rows: " << reproduced << " reproduced, " << errata << " errata, "
              << qualitative << " qualitative" << (ok(rows) ? "" : ", the rest FAILED") << '\n';
  }
  return good ? 0 : 1;
}
}  // namespace

void add_reproduce(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "reproduce",
                             "Published values beside ours: reproduced, erratum or qualitative");
  auto paper = std::make_shared<std::string>();
  auto section = std::make_shared<std::string>();
  std::string known;
  for (const std::string& name : papers()) known += (known.empty() ? "" : ", ") + name;
  sub->add_option("paper", *paper, known + "; all of them without")->type_name("PAPER");
  sub->add_option("--section", *section, "One section only")->type_name("SECTION");
  sub->callback(
      [=, &common, &action] { action = [=, &common] { return run(*paper, *section, common.json); }; });
}

}  // namespace pfaff::app
