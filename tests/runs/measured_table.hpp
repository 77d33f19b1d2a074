// The table that a measure leaves of a run which is named.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/measuring.hpp>

namespace pfaff::testing {

// A run that is to be measured.
struct ToMeasure {
  Integration<double> start;
  std::int64_t steps;
};

// Of whole steps within a duration. `set` are parameters of the system, or initial=a,b,...
inline ToMeasure to_measure(const std::string& system, const std::string& method, const std::string& step,
                            Assignments set, double time) {
  AskedIntegration asked{.step = step};
  for (auto one = set.begin(); one != set.end(); ++one)
    if (one->first == "initial") {
      const std::vector<Real> initial = parse_list(one->second).value();
      for (const Real& x : initial) asked.initial.push_back(to_string(x));
      set.erase(one);
      break;
    }
  auto start = integrate(system, set, method, {}, asked);
  const auto steps = static_cast<std::int64_t>(time / start.step() * (1 + 1e-12));
  return {std::move(start), steps};
}

inline MeasuredTable table_of(const std::string& measure, const ToMeasure& run) {
  const auto asked = measure_asked_for(measure);
  return measured(run.start, run.steps, {asked.get()}).front();
}
inline bool fits(const std::string& measure, const ToMeasure& run) {
  return measure_asked_for(measure)->refuses(*run.start.model(), run.start.method()).empty();
}

inline double number(const MeasuredTable::Line& line, std::size_t column) {
  return std::get<double>(line.cells[column]);
}
inline double time_of(const MeasuredTable::Line& line, const ToMeasure& run) {
  return static_cast<double>(line.step) * run.start.step();
}

}  // namespace pfaff::testing
