#include <pfaff/bench/reproduce/rows.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

std::string shown(const Numbers& x) {
  std::string text;
  for (const Quad& v : x) {
    if (!text.empty()) text += ' ';
    text += to_string(v, 6);
  }
  return text;
}
double distance(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto difference = static_cast<double>(abs(a[k] - b[k]));
    if (!std::isfinite(difference)) return INFINITY;
    worst = std::max(worst, difference);
  }
  return worst;
}

void Rows::add(ReproducedRow row) {
  row.section = section_;
  row.id = row.equation + " " + row.id;
  rows_.push_back(std::move(row));
}
void Rows::reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                      const Numbers& ours) {
  ReproducedRow r{what,         "", equation, shown(printed), shown(ours), distance(printed, ours),
                  at_round_off, "", ""};
  r.status = r.difference <= r.tolerance ? "reproduced" : "failed";
  add(r);
}
void Rows::measured(const std::string& equation, const std::string& what, double printed, double ours,
                    double tolerance) {
  ReproducedRow r{what,
                  "",
                  equation,
                  to_string(Quad(printed), 4),
                  to_string(Quad(ours), 4),
                  std::abs(printed - ours),
                  tolerance,
                  "",
                  ""};
  r.status = r.difference <= r.tolerance ? "reproduced" : "failed";
  add(r);
}
void Rows::erratum(const std::string& equation, const std::string& what, const Numbers& printed,
                   const Numbers& corrected, const Numbers& ours, const std::string& entry) {
  ReproducedRow r{what,         "", equation, shown(printed), shown(ours), distance(printed, ours),
                  at_round_off, "", entry};
  const bool shown_to_be =
      r.difference > clearly && std::isfinite(r.difference) && distance(corrected, ours) <= at_round_off;
  r.status = shown_to_be ? "erratum" : "failed";
  add(r);
}
void Rows::claim(const std::string& equation, const std::string& what, const std::string& printed,
                 const std::string& ours, double difference, bool corrected_holds, const std::string& entry) {
  ReproducedRow r{what, "", equation, printed, ours, difference, at_round_off, "", entry};
  r.status = difference > clearly && std::isfinite(difference) && corrected_holds ? "erratum" : "failed";
  add(r);
}
void Rows::qualitative(const std::string& equation, const std::string& what, const std::string& printed,
                       const std::string& ours, double difference, double tolerance, bool holds,
                       const std::string& tested) {
  ReproducedRow r{what, "", equation, printed, ours, difference, tolerance, "", tested};
  r.status = holds ? "qualitative" : "failed";
  add(r);
}

}  // namespace pfaff
