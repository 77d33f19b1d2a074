// What is said of a measure beside its code: its descriptor, its columns, and what it has to give where the
// answer is known.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// A column of a table.
struct Column {
  enum class Kind { number, text };
  std::string name, unit{};  // of numbers; empty for pure ones
  Kind kind = Kind::number;
  int digits = 0;  // that its numbers are written with; 0: all that the run's precision has
};

/// The names of the columns that the joined tables of an experiment have before those of a measure.
inline constexpr std::array columns_of_the_run{"case", "method", "step", "t"};

/// A number, which leaves its cell empty where it is not finite, or a text.
using Cell = std::variant<double, Quad, std::string>;
/// A cell for each column.
using Row = std::vector<Cell>;

/// What a table is shown over: the time, a row for each look, or the size of the step, a row for each run.
enum class Over { time, step };

/// What is said about a measure, once.
struct MeasureDescriptor {
  std::string name;           // kebab-case
  std::string title;          // one line
  std::string reference{};    // bib key and equations
  std::string description{};  // two to four sentences: what it is, when it says something, where it ends
  int version = 1;            // of what it gives: tables of another version are made anew
  Over over = Over::time;
  std::vector<Claim> watches{};  // of methods, which it sees along a run
  bool usual = false;            // is taken by experiments that name no measures
};

/// A run of which a measure's answer is known.
struct MeasureControl {
  std::string system;
  Assignments system_parameters{};
  std::string method;
  Assignments method_parameters{}, settings{};  // settings: of the measure
  std::vector<std::string> initial{};           // the state it begins at; none: the system's own
  std::string step;
  std::int64_t steps = 0;
  std::string column;                // the number of which in the last row
  double expected = 0, allowed = 0;  // is this, to so much
  bool fault = false;                // the method does not keep it: the number is off by more than that

  /// A run from the system's own initial state, of which an answer is still to be named.
  static MeasureControl of(std::string system, std::string method, std::string step, std::int64_t steps) {
    MeasureControl control;
    control.system = std::move(system), control.method = std::move(method);
    control.step = std::move(step), control.steps = steps;
    return control;
  }
  /// This run, with its answer.
  [[nodiscard]] MeasureControl gives(std::string number, double answer, double to) const {
    MeasureControl control = *this;
    control.column = std::move(number), control.expected = answer, control.allowed = to;
    return control;
  }
  /// This run, of a method that has another one.
  [[nodiscard]] MeasureControl does_not_give(std::string number, double answer, double to) const {
    MeasureControl control = gives(std::move(number), answer, to);
    control.fault = true;
    return control;
  }
};

}  // namespace pfaff
