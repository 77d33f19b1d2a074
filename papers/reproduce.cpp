#include <pfaff/papers/reproduce.hpp>

#include <algorithm>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/papers/rows.hpp>

namespace pfaff {

namespace {
std::vector<PartOfPaper> parts_of(Paper paper) {
  switch (paper) {
    case Paper::su_qin:
      return su_qin_parts();
    case Paper::nguyen_turski:
      return nguyen_turski_parts();
    case Paper::pitanga_rodrigues:
      return pitanga_rodrigues_parts();
    case Paper::others:
      break;
  }
  return others_parts();
}
}  // namespace

std::vector<ReproducedRow> reproduce(const std::string& paper, const std::string& section) {
  std::vector<std::string> sections;
  const std::vector<PartOfPaper> parts = parts_of(paper_named(paper));
  for (const PartOfPaper& part : parts)
    if (sections.empty() || sections.back() != part.section) sections.push_back(part.section);
  if (!section.empty() && std::find(sections.begin(), sections.end(), section) == sections.end()) {
    // No suggestion: most sections are numbers, and none of them is near.
    std::string text = "unknown section '" + section + "' of " + paper + "; expected one of: ";
    for (const std::string& known_section : sections)
      text += (&known_section == &sections.front() ? "" : ", ") + known_section;
    throw InputError(text);
  }
  std::vector<ReproducedRow> all;
  for (const auto& [name, add] : parts) {
    if (!section.empty() && name != section) continue;
    Rows rows(name);
    add(rows);
    for (ReproducedRow& row : rows.take()) all.push_back(std::move(row));
  }
  return all;
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
