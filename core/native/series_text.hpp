// The field in the Darboux chart as C++ for truncated series, in 1, 2 and 4 lanes: what OnlineSeries
// (core/tape/online_series.hpp) makes of an author's formula, made of a tape, by the same recurrences.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff::native {

/// How many levels of a collocation are compiled without loops, for each number of lanes, unless the tape is
/// long.
constexpr int known_levels(int lanes) { return lanes == 1 ? 3 : lanes == 2 ? 7 : 11; }

struct SeriesText {
  std::string text;  // empty where the tape is too long, or solves linear systems
  int slots = 0;     // inputs, the time, then the formula's own
  bool timed = false;
  std::vector<int> outputs;  // slots
};

/// The text of core/tape/recurrences.hpp, which the build puts into a source.
const char* recurrences_text();

/// The functions pfaff_level_W and pfaff_time_W and, for up to the known levels, pfaff_collocate_W, for W =
/// 1, 2, 4.
SeriesText series_text(const Tape& tape);

}  // namespace pfaff::native
