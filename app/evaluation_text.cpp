#include <pfaff/app/evaluation_text.hpp>

#include <limits>
#include <vector>

#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff::app {

namespace {
using nlohmann::json;
using Rows = TableRows;

// What a text of this program says; NaN where it is no number, as "nan" and "-".
double number_in(const std::string& text) {
  Quad x;
  return parse(text, x) ? static_cast<double>(x) : std::numeric_limits<double>::quiet_NaN();
}

std::string shown_value(const json& value) {
  if (value.is_null()) return "-";
  const double x = value.is_string() ? number_in(value.get<std::string>()) : value.get<double>();
  return formatted("%.6g", x + 0.0);  // adding 0 turns -0 into 0
}
std::string joined(const json& list) {
  std::string text;
  for (const auto& x : list) text += (text.empty() ? "" : ", ") + x.get<std::string>();
  return text;
}

// A direction as a combination of the names of coordinates, such as "r - 0.5 p".
std::string combination(const json& direction, const json& names) {
  std::string text;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    std::string factor = shown_value(direction[k]);
    if (factor == "0") continue;
    const bool negative = factor.front() == '-';
    if (negative) factor.erase(0, 1);
    text += text.empty() ? (negative ? "-" : "") : negative ? " - " : " + ";
    text += (factor == "1" ? "" : factor + " ") + names[k].get<std::string>();
  }
  return text;
}

// Up to so many columns a matrix is shown as a whole.
constexpr std::size_t widest = 6;

// A matrix as text. One that would be too wide for the terminal is shown as a list of its nonzero entries on
// one side of the diagonal, and of those on the diagonal where it is symmetric.
std::string matrix_text(const std::string& title, const json& matrix, const json& names, bool symmetric) {
  constexpr std::size_t most_entries = 60;
  Rows rows;
  if (matrix.size() <= widest) {
    rows.push_back({title});
    for (const auto& name : names) rows[0].push_back(name);
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      rows.push_back({names[i]});
      for (const auto& x : matrix[i]) rows.back().push_back(shown_value(x));
    }
    return '\n' + table(rows);
  }
  rows.push_back({"i", "j", title + "_ij"});
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t k = symmetric ? i : i + 1; k < matrix.size(); ++k)
      if (shown_value(matrix[i][k]) != "0") rows.push_back({names[i], names[k], shown_value(matrix[i][k])});
  if (rows.size() > most_entries)
    return '\n' + title + ": " + std::to_string(matrix.size()) + " x " + std::to_string(matrix.size()) +
           ", in --json\n";
  return '\n' + table(rows);
}

void add_structure_facts(const json& j, Rows& facts) {
  facts.push_back({"class", j["class"]});
  const bool infinite = j["condition"].is_null();
  facts.push_back({"K", j["regular"]          ? "regular, condition " + shown_value(j["condition"])
                        : j["kernel"].empty() ? "not finite"
                                              : "degenerate, condition " +
                                                    (infinite ? "infinite" : shown_value(j["condition"]))});
  for (const auto& direction : j["kernel"])
    facts.push_back({"degenerate along", combination(direction, j["coordinates"])});
  facts.push_back({"self-adjoint", "skew to " + shown_value(j["self_adjoint"]["skew"]) + ", closed to " +
                                       shown_value(j["self_adjoint"]["closed"]) + ", time to " +
                                       shown_value(j["self_adjoint"]["time"]) + " (relative)"});
  facts.push_back({"B", shown_value(j["B"])});
  if (j["centre"].is_null()) return;
  std::string centre;
  for (const auto& x : j["centre"]) centre += (centre.empty() ? "" : ", ") + shown_value(x);
  facts.push_back({"F and B", "from K and D about " + centre});
}

void add_constraint_facts(const json& j, Rows& facts) {
  std::string count = std::to_string(j["constraint_names"].size());
  if (j.contains("hidden_constraints"))
    count = std::to_string(j["constraints"].size()) + " holonomic, as many hidden; S " +
            j["structure"].get<std::string>();
  facts.push_back({"constraints", count});
  if (j.contains("W") && !j["rank"].is_null()) {
    facts.push_back({"W", "rank " + std::to_string(j["rank"].get<std::size_t>()) + " of " +
                              std::to_string(j["constraint_names"].size()) + ", " +
                              (j["condition"].is_null() ? "singular to working precision"
                                                        : "condition " + shown_value(j["condition"]))});
    if (!j["first_class"].empty()) facts.push_back({"first class", joined(j["first_class"])});
    if (!j["redundant"].empty()) facts.push_back({"redundant", joined(j["redundant"])});
  }
}

void add_bracket_facts(const json& bracket, bool on_constraints, Rows& facts) {
  facts.push_back({"{,}_nh", "rank " + std::to_string(bracket["rank"].get<std::size_t>()) + " of " +
                                 std::to_string(bracket["bracket"].size())});
  facts.push_back({"Casimirs", joined(bracket["casimirs"]) + " to " +
                                   shown_value(bracket["casimir_residual"]) + " (relative)"});
  const auto& jacobiator = bracket["jacobiator"];
  facts.push_back(
      {"Jacobi", "largest sum " + shown_value(jacobiator["value"]) + ", of " + joined(jacobiator["of"])});
  if (bracket["flow_difference"].is_null()) return;
  const std::string difference = shown_value(bracket["flow_difference"]);
  const bool same = number_in(difference) < 1e-8;
  facts.push_back({"flow", (on_constraints ? "" : "on the constraints, where this state is not, ") +
                               (same ? "{z, H}_nh is the rhs, to " + difference
                                     : "{z, H}_nh is not the rhs, which differs by " + difference)});
}

std::string constraint_tables(const json& j) {
  const bool holonomic = j.contains("hidden_constraints"),
             moves = j.contains("multipliers") &&
                     (j["multipliers"].is_null() || j["multipliers"].size() == j["constraints"].size());
  const auto& names = j["constraint_names"];
  Rows rows{{"constraint", "value"}};
  json own = json::array();  // names of the phi alone, without their phi~
  if (holonomic) rows[0].emplace_back("hidden");
  if (moves) rows[0].emplace_back("multiplier");
  for (std::size_t k = 0; k < j["constraints"].size(); ++k) {
    own.push_back(names[holonomic ? 2 * k : k]);
    rows.push_back({own.back(), shown_value(j["constraints"][k])});
    if (holonomic) rows.back().push_back(shown_value(j["hidden_constraints"][k]));
    if (moves) rows.back().push_back(j["multipliers"].is_null() ? "-" : shown_value(j["multipliers"][k]));
  }
  std::string text = '\n' + table(rows);
  for (const char* key : {"S", "A", "S_D"})
    if (j.contains(key) && !j[key].is_null())
      text += matrix_text(key, j[key], j.value("velocity_names", own), key[0] == 'S');
  if (j.contains("W")) text += matrix_text("W", j["W"], names, false);
  if (j.contains("dirac_bracket")) text += matrix_text("{,}_D", j["dirac_bracket"], j["coordinates"], false);
  if (j.contains("nonholonomic") && !j["nonholonomic"].is_null()) {
    json positions = json::array();
    for (std::size_t k = 0; k < j["coordinates"].size() / 2; ++k) positions.push_back(j["coordinates"][k]);
    if (positions.size() <= widest) text += matrix_text("P", j["nonholonomic"]["P"], positions, false);
    text += matrix_text("{,}_nh", j["nonholonomic"]["bracket"], j["coordinates"], false);
  }
  if (!j.contains("solvers")) return text;
  Rows solvers{{"solver", "difference", "status"}};
  for (const auto& [name, solver] : j["solvers"].items())
    solvers.push_back({name, shown_value(solver["difference"]), solver["status"]});
  return text + '\n' + table(solvers);
}

}  // namespace

std::string evaluation_text(const json& j) {
  const bool structured = j.contains("K"), constrained = j.contains("constraints");
  const auto& names = j["coordinates"];
  std::string parameters;
  for (const auto& [key, value] : j["parameters"].items())
    parameters += (parameters.empty() ? "" : ", ") + key + "=" + value.get<std::string>();
  Rows known{{"system", j["system"]}};
  if (constrained) known.push_back({"formulation", j["formulation"]});
  if (!parameters.empty()) known.push_back({"parameters", parameters});
  known.push_back({"t", shown_value(j["t"])});
  known.push_back({"status", j["status"]});
  if (j.contains("reason")) known.push_back({"reason", j["reason"]});
  for (const auto& [key, label] : {std::pair{"energy", "energy"}, std::pair{"energy_rate", "energy rate"}})
    if (!j[key].is_null()) known.push_back({label, shown_value(j[key])});
  if (structured) add_structure_facts(j, known);
  if (constrained) add_constraint_facts(j, known);
  if (j.contains("nonholonomic") && !j["nonholonomic"].is_null()) {
    const auto& values = j["constraints"];
    add_bracket_facts(
        j["nonholonomic"],
        std::all_of(values.begin(), values.end(),
                    [](const json& value) { return std::abs(number_in(shown_value(value))) < 1e-8; }),
        known);
  }
  const bool forced = j.contains("constraint_forces") && !j["constraint_forces"].is_null();
  Rows rows{{"coordinate", "state", "rhs"}};
  if (structured)
    for (const char* label : {"D", "F", "F_t"}) rows[0].emplace_back(label);
  if (forced) rows[0].emplace_back("constraint force");
  for (std::size_t k = 0; k < names.size(); ++k) {
    rows.push_back(
        {names[k], shown_value(j["state"][k]), j["rhs"].is_null() ? "-" : shown_value(j["rhs"][k])});
    if (structured)
      for (const char* key : {"D", "F", "F_t"}) rows.back().push_back(shown_value(j[key][k]));
    if (forced)
      rows.back().push_back(k < names.size() / 2 ? ""
                                                 : shown_value(j["constraint_forces"][k - names.size() / 2]));
  }
  std::string text = facts(known) + '\n' + table(rows);
  if (structured) text += matrix_text("K", j["K"], names, false);
  if (constrained) text += constraint_tables(j);
  return text;
}

}  // namespace pfaff::app
