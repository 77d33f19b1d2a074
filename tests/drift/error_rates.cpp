// Prints how often the drift classifier is right on synthetic series of each kind, as the table of
// docs/drift-and-cost.md:
//     error_rates [SERIES OF EACH KIND [FEWEST SAMPLES MOST SAMPLES [FIRST SEED]]]
// The thresholds were last chosen on seeds from 100 000 on and looked at from 1 000 000 and 3 000 000 on; the
// table is of those from 5 000 000 on.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include <pfaff/runs/support/drift.hpp>

#include "synthetic_series.hpp"

namespace {

using namespace pfaff;

struct Row {
  std::map<std::string_view, int> classes;
  int slopes = 0, slopes_held = 0, parameters = 0, parameters_held = 0;
};

bool holds(const windows::Estimate& interval, double value) {
  return interval.low <= value && value <= interval.high;
}

std::string share(int part, int whole) {
  if (whole == 0) return "";
  std::string text(16, ' ');
  text.resize(std::size_t(std::snprintf(text.data(), text.size(), "%.1f", 100.0 * part / whole)));
  return part == 0 ? "-" : text;
}

}  // namespace

int main(int count, char** arguments) {
  const int series = count > 1 ? std::atoi(arguments[1]) : 2000;
  const std::size_t fewest = count > 3 ? std::size_t(std::atoi(arguments[2])) : 100;
  const std::size_t most = count > 3 ? std::size_t(std::atoi(arguments[3])) : 2000;
  const int first = count > 4 ? std::atoi(arguments[4]) : 0;
  std::vector<std::string_view> columns;
  for (const DriftClassEntry& entry : drift_classes())
    if (entry.drift_class != DriftClass::exact && entry.drift_class != DriftClass::biased_round_off)
      columns.push_back(entry.name);
  std::printf("| kind | n |");
  for (const std::string_view name : columns) std::printf(" %s |", std::string(name).c_str());
  std::printf(" slope held | exponent or rate held |\n|---|---|");
  for (std::size_t k = 0; k < columns.size() + 2; ++k) std::printf("---|");
  std::printf("\n");
  for (std::size_t kind = 0; kind < testing::series_kinds.size(); ++kind) {
    Row row;
    for (int seed = first; seed < first + series; ++seed) {
      const testing::SyntheticSeries s = testing::make_series(kind, std::uint64_t(seed), fewest, most);
      DriftAccumulator accumulator;
      for (std::size_t k = 0; k < s.errors.size(); ++k) accumulator.add(s.times[k], s.errors[k]);
      const Drift drift = accumulator.result({s.unit, s.scale, std::int64_t(s.errors.size()) - 1});
      ++row.classes[to_string(drift.drift_class)];
      if (s.slope) {
        ++row.slopes;
        row.slopes_held += drift.slope_low <= *s.slope && *s.slope <= drift.slope_high;
      }
      if (to_string(drift.drift_class) != testing::series_kinds[kind].expected) continue;
      const auto& estimate = s.rate ? drift.rate : drift.exponent;
      if ((s.rate || s.exponent) && estimate) {
        ++row.parameters;
        row.parameters_held += holds(*estimate, s.rate ? *s.rate : *s.exponent);
      }
    }
    std::printf("| %s | %d |", std::string(testing::series_kinds[kind].name).c_str(), series);
    for (const std::string_view name : columns) {
      const bool right = name == testing::series_kinds[kind].expected;
      const std::string cell = share(row.classes[name], series);
      std::printf(right ? " **%s** |" : " %s |", cell.c_str());
    }
    std::printf(" %s | %s |\n", share(row.slopes_held, row.slopes).c_str(),
                share(row.parameters_held, row.parameters).c_str());
  }
}
