#include <pfaff/papers/reproduce.hpp>

#include <algorithm>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

namespace {
std::vector<ReproducedRow> rows_of(Paper paper) {
  switch (paper) {
    case Paper::su_qin:
      return reproduce_su_qin();
    case Paper::nguyen_turski:
      return reproduce_nguyen_turski();
    case Paper::pitanga_rodrigues:
      return reproduce_pitanga_rodrigues();
    case Paper::others:
      break;
  }
  return reproduce_others();
}
}  // namespace

std::vector<ReproducedRow> reproduce(const std::string& paper, const std::string& section) {
  std::vector<ReproducedRow> rows = rows_of(paper_named(paper));
  if (section.empty()) return rows;
  std::vector<std::string> sections;
  for (const ReproducedRow& row : rows)
    if (std::find(sections.begin(), sections.end(), row.section) == sections.end())
      sections.push_back(row.section);
  if (std::find(sections.begin(), sections.end(), section) == sections.end()) {
    // No suggestion: most sections are numbers, and none of them is near.
    std::string text = "unknown section '" + section + "' of " + paper + "; expected one of: ";
    for (const std::string& known_section : sections)
      text += (&known_section == &sections.front() ? "" : ", ") + known_section;
    throw InputError(text);
  }
  std::erase_if(rows, [&](const ReproducedRow& row) { return row.section != section; });
  return rows;
}

bool ok(const std::vector<ReproducedRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ReproducedRow& row) {
    return row.status == "reproduced" || row.status == "improved" || row.status == "erratum" ||
           row.status == "qualitative";
  });
}

nlohmann::json to_json(const std::string& paper, const std::vector<ReproducedRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const ReproducedRow& r : rows) {
    nlohmann::json row{
        {"id", r.id},     {"section", r.section},       {"equation", r.equation},   {"printed", r.printed},
        {"ours", r.ours}, {"difference", r.difference}, {"tolerance", r.tolerance}, {"status", r.status}};
    row["erratum"] = r.erratum.empty() ? nlohmann::json(nullptr) : nlohmann::json(r.erratum);
    list.push_back(row);
  }
  return {{"paper", paper}, {"ok", ok(rows)}, {"rows", list}};
}

}  // namespace pfaff
