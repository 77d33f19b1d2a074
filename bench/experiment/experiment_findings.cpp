#include <pfaff/bench/experiment/experiment_findings.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/csv_cells.hpp>
#include <pfaff/bench/runner/text_table.hpp>
#include <pfaff/core/numbers/real.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/runs/support/setback.hpp>
#include <pfaff/runs/support/watched_quantity.hpp>

namespace pfaff {

namespace {
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

bool agree(const ExperimentRun& a, const ExperimentRun& b) {
  if (a.seed != b.seed) return false;
  if (a.tolerance.empty() != b.tolerance.empty()) return true;
  return a.step == b.step && a.tolerance == b.tolerance;
}

// However they are written.
bool same_number(const std::string& a, const std::string& b) {
  const auto x = Real::parse(a), y = Real::parse(b);
  return a == b || (x && y && *x == *y);
}

// The pairs of runs that a claim is about, by their indices in `runs`. A claim about a bound has no second
// run; both indices are then the same.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const ExperimentClaim& claim,
                                                          const std::vector<ExperimentRun>& runs) {
  const auto meant = [&](const ExperimentRun& run, const std::string& label) {
    return run.which->name == claim.of && run.method->label == label &&
           (claim.step.empty() || same_number(claim.step, run.step) ||
            same_number(claim.step, run.tolerance));
  };
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < runs.size(); ++a) {
    if (!meant(runs[a], claim.first)) continue;
    if (claim.second.empty()) {
      pairs.emplace_back(a, a);
      continue;
    }
    for (std::size_t b = 0; b < runs.size(); ++b)
      if (meant(runs[b], claim.second) && agree(runs[a], runs[b])) pairs.emplace_back(a, b);
  }
  return pairs;
}
}  // namespace

std::vector<std::string> measures_of(const ResolvedRun& run, bool reference) {
  std::vector<std::string> names;
  if (reference) names = {"error_max", "error_final"};
  const auto add = [&](const std::string& name, bool residual) {
    for (const QuantityField& field : quantity_fields())
      if (field.compared && field.is_of(residual)) names.push_back(name + ":" + field.name);
  };
  for (const Invariant& i : run.model->invariants()) {
    if (i.behaviour == Behaviour::conserved) add(i.name, false);
    if (const auto words = setback_words(run.expected(i)))
      names.push_back(i.name + ":" + std::string(words->move));
  }
  for (const std::string& name : constraint_residual_names(*run.model)) add(name, true);
  return names;
}

std::optional<double> measured(const nlohmann::json& summary, const std::string& measure) {
  const std::size_t colon = measure.rfind(':');
  const auto number = [](const nlohmann::json& entry, const std::string& key) -> std::optional<double> {
    if (!entry.contains(key) || !entry[key].is_number()) return std::nullopt;
    return key == "final" ? std::abs(entry[key].get<double>()) : entry[key].get<double>();
  };
  if (colon == std::string::npos) return number(summary, measure);
  const std::string name = measure.substr(0, colon), what = measure.substr(colon + 1);
  for (const char* list : {"invariants", "constraints"})
    if (summary.contains(list))
      for (const nlohmann::json& entry : summary[list])
        if (entry["name"] == name) {
          const auto setback = setback_in(entry);
          return number(entry, setback && setback->move == what ? "largest_" + what : what);
        }
  return std::nullopt;
}

Spread spread_over_seeds(const ExperimentRun& of, const std::string& measure,
                         const std::vector<ExperimentRun>& runs,
                         const std::vector<nlohmann::json>& summaries) {
  Spread spread;
  std::vector<double> values;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    if (run.which != of.which || run.method != of.method || run.step != of.step ||
        run.tolerance != of.tolerance)
      continue;
    ++spread.runs;
    if (summaries[k]["status"] != "converged") continue;
    ++spread.finished;
    if (const auto value = measured(summaries[k], measure)) values.push_back(*value);
  }
  spread.measured = values.size();
  if (values.empty()) return spread;
  spread.median = median(values);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  spread.low = *low;
  spread.high = *high;
  return spread;
}

std::string ensembles_csv(const std::vector<ExperimentRun>& runs,
                          const std::vector<nlohmann::json>& summaries) {
  TextStream text;
  for (const ExperimentRun& run : runs) {
    if (run.seed != 1) continue;
    for (const std::string& measure : measures_of(run.resolved, run.which->reference)) {
      const Spread s = spread_over_seeds(run, measure, runs, summaries);
      text << csv_quoted(run.which->name) << ',' << csv_quoted(run.method->label) << ',' << run.step << ','
           << run.tolerance << ',' << s.runs << ',' << s.finished << ',' << csv_quoted(measure) << ','
           << s.measured;
      for (const double x : {s.median, s.low, s.high})
        text << ',' << (s.measured == 0 ? "" : formatted("%.17g", x));
      text << '\n';
    }
  }
  if (text.str().empty()) return {};
  return head_of(ensemble_columns()) + "\n" + text.str();
}

Columns ensemble_columns() {
  return columns_named({"case*", "method*", "step", "tolerance", "runs", "finished", "measure*", "measured",
                        "median", "low", "high"});
}

Columns finding_columns() {
  return columns_named({"case*", "measure*", "method*", "relation*", "factor", "than*", "bound", "step",
                        "runs", "holding", "needed", "holds*", "median", "than_median", "ratio_median"});
}

namespace {
// The steps and tolerances of the runs of a claim's first method in its case.
std::string sizes_of(const ExperimentClaim& claim, const std::vector<ExperimentRun>& runs) {
  std::vector<std::string> sizes;
  std::string text;
  for (const ExperimentRun& run : runs) {
    const std::string& size = run.tolerance.empty() ? run.step : run.tolerance;
    if (run.which->name != claim.of || run.method->label != claim.first ||
        std::find(sizes.begin(), sizes.end(), size) != sizes.end())
      continue;
    text += (sizes.empty() ? "" : ", ") + size;
    sizes.push_back(size);
  }
  return text.empty() ? "no step" : text;
}
}  // namespace

void check_claims(const Experiment& experiment, const std::vector<ExperimentRun>& runs) {
  for (const ExperimentClaim& claim : experiment.claims) {
    const std::string where = experiment.name + " [[finding]] of case " + claim.of;
    const auto pairs = pairs_of(claim, runs);
    if (pairs.empty())
      throw InputError(
          where + ": " + claim.first + (claim.second.empty() ? "" : " and " + claim.second) +
          " have no runs to compare" +
          (claim.step.empty() ? "" : " at " + claim.step + "; there are runs at " + sizes_of(claim, runs)));
    if (claim.at_least > pairs.size())
      throw InputError(where + ": key 'at_least': expected at most " + std::to_string(pairs.size()) +
                       ", the runs to compare, got " + std::to_string(claim.at_least));
    for (const std::size_t k : {pairs.front().first, pairs.front().second}) {
      const auto names = measures_of(runs[k].resolved, runs[k].which->reference);
      if (std::find(names.begin(), names.end(), claim.measure) == names.end())
        throw InputError(where + ": " + unknown_name("measure", claim.measure, names));
    }
  }
}

std::vector<Finding> findings_of(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                                 const std::vector<nlohmann::json>& summaries) {
  std::vector<Finding> findings;
  for (const ExperimentClaim& claim : experiment.claims) {
    Finding finding{.claim = &claim};
    std::vector<double> first, second, ratio;
    for (const auto& [a, b] : pairs_of(claim, runs)) {
      ++finding.pairs;
      if (summaries[a]["status"] != "converged" || summaries[b]["status"] != "converged") continue;
      const auto x = measured(summaries[a], claim.measure);
      const auto y = claim.second.empty() ? claim.bound : measured(summaries[b], claim.measure);
      if (!x || !y) continue;
      const double limit = claim.factor * *y;
      finding.holding += claim.relation == "exceeds" ? *x > limit : *x < limit;
      first.push_back(*x);
      second.push_back(*y);
      ratio.push_back(*x / *y);
    }
    finding.needed = claim.at_least == 0 ? finding.pairs : claim.at_least;
    if (!first.empty()) {
      finding.first_median = median(first);
      finding.second_median = median(second);
      finding.ratio_median = median(ratio);
    }
    findings.push_back(finding);
  }
  return findings;
}

std::string in_words(const Finding& finding) {
  const ExperimentClaim& claim = *finding.claim;
  const std::string times = claim.factor == 1 ? "" : formatted("%g", claim.factor) + " times ";
  return claim.measure + " of " + claim.first + (claim.step.empty() ? "" : " at " + claim.step) +
         (claim.relation == "exceeds" ? " exceeds " : " stays below ") + times +
         (claim.second.empty() ? formatted("%g", claim.bound) : "that of " + claim.second) + " in " +
         std::to_string(finding.holding) + " of " + std::to_string(finding.pairs) +
         (finding.pairs == 1 ? " run" : " runs");
}

std::string findings_csv(const std::vector<Finding>& findings) {
  TextStream text;
  text << head_of(finding_columns()) << '\n';
  for (const Finding& f : findings) {
    const ExperimentClaim& c = *f.claim;
    text << csv_quoted(c.of) << ',' << csv_quoted(c.measure) << ',' << csv_quoted(c.first) << ','
         << c.relation << ',' << formatted("%.17g", c.factor) << ',' << csv_quoted(c.second) << ','
         << (c.second.empty() ? formatted("%.17g", c.bound) : "") << ',' << c.step << ',' << f.pairs << ','
         << f.holding << ',' << f.needed << ',' << (f.holds() ? "yes" : "no") << ','
         << formatted("%.17g", f.first_median) << ',' << formatted("%.17g", f.second_median) << ','
         << formatted("%.17g", f.ratio_median) << '\n';
  }
  return text.str();
}

std::string findings_table(const std::vector<Finding>& findings) {
  if (findings.empty()) return {};
  TableRows rows;
  for (const Finding& f : findings)
    rows.push_back({f.holds() ? "  holds" : "  FAILS",
                    in_words(f) + " (median ratio " + formatted("%.2g", f.ratio_median) +
                        (f.needed == f.pairs ? "" : ", expected in " + std::to_string(f.needed)) + ")"});
  return "\nfindings\n" + facts(rows);
}

nlohmann::json to_json(const Finding& f) {
  nlohmann::json j{{"case", f.claim->of},
                   {"finding", in_words(f)},
                   {"measure", f.claim->measure},
                   {"method", f.claim->first},
                   {"relation", f.claim->relation},
                   {"runs", f.pairs},
                   {"holding", f.holding},
                   {"needed", f.needed},
                   {"holds", f.holds()},
                   {"median", f.first_median},
                   {"ratio_median", f.ratio_median}};
  if (f.claim->second.empty()) {
    j["bound"] = f.claim->bound;
  } else {
    j["than"] = f.claim->second;
    j["than_median"] = f.second_median;
  }
  return j;
}

std::string failed_claims(const std::vector<Finding>& findings) {
  std::string text;
  std::size_t failed = 0;
  for (const Finding& f : findings) {
    if (f.holds()) continue;
    if (++failed == 1) text = in_words(f) + ", expected in " + std::to_string(f.needed);
  }
  if (failed > 1)
    text += "; and " + std::to_string(failed - 1) + " more of " + std::to_string(findings.size());
  return text;
}

}  // namespace pfaff
