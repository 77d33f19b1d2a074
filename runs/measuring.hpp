// Measuring a run: its steps are taken, and measures look at them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/runs/measure.hpp>

namespace pfaff {

/// What a measure has left of a run.
struct MeasuredTable {
  struct Line {
    std::int64_t step;
    Row cells;
  };
  std::vector<Column> columns;
  std::vector<Line> lines;
  std::string ended;  // why it ends before the run does, a sentence without a full stop; or empty
};

/// Takes at most `steps` steps from `start`, as many as the measures look at, and gives a table for each of
/// them. A measure whose code throws ends its own table and no other. BudgetSpent passes. `solution` is that
/// of the run where it is shared with others.
template <class T>
std::vector<MeasuredTable> measured(const Integration<T>& start, std::int64_t steps,
                                    const std::vector<const MeasureInstance*>& measures,
                                    const SharedSolution* solution = nullptr);

extern template std::vector<MeasuredTable> measured(const Integration<double>&, std::int64_t,
                                                    const std::vector<const MeasureInstance*>&,
                                                    const SharedSolution*);
extern template std::vector<MeasuredTable> measured(const Integration<Quad>&, std::int64_t,
                                                    const std::vector<const MeasureInstance*>&,
                                                    const SharedSolution*);

/// The text of a cell, as its column is written.
std::string text_of(const Cell& cell, const Column& column);

}  // namespace pfaff
