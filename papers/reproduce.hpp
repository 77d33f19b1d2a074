// Reproductions: what a paper prints, what the engine gives, and what to call the difference.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/studies/papers.hpp>
#include <pfaff/papers/evidence.hpp>

namespace pfaff {

/// One published value.
struct ReproducedRow {
  std::string id, section;
  /// What the paper calls it: items of its coverage, "(4.7)", "(3.8)-(3.10)" or "(1), (7), (16)".
  std::string equation;
  std::string printed, ours;
  double difference = 0, tolerance = 0;
  /// judge(evidence): reproduced, improved (better than stated, such as a higher order), erratum (names its
  /// entry), qualitative (the claim tested is stated), or failed.
  std::string status;
  std::string erratum;  // the entry in the list of misprints, or the claim tested
  Evidence evidence;
};

class Rows;

/// The rows of a paper, of one section or of all (empty). InputError for unknown names.
std::vector<ReproducedRow> reproduce(const std::string& paper, const std::string& section);

/// {paper, ok, rows}.
nlohmann::json to_json(const std::string& paper, const std::vector<ReproducedRow>& rows);
/// True when every row is reproduced, improved, an erratum shown to be one, or qualitative.
bool ok(const std::vector<ReproducedRow>& rows);

/// A part of a paper's rows: the section that they belong to, and what adds them.
struct PartOfPaper {
  std::string section;
  void (*add)(Rows& rows);
};
/// The parts of each paper, in its folder.
std::vector<PartOfPaper> su_qin_parts();
std::vector<PartOfPaper> nguyen_turski_parts();
std::vector<PartOfPaper> pitanga_rodrigues_parts();
std::vector<PartOfPaper> others_parts();

}  // namespace pfaff
