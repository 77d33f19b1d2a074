// The evidence behind a row of a reproduction, and the rule by which it is judged. The numbers stay with the
// row, so that the judgement can be repeated with other numbers: a test changes each printed number a little
// and expects every row to fail.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

using Numbers = std::vector<Quad>;

/// Rows are computed in quad with a few hundred roundings of 1e-34 on numbers about 1; the rest is room.
inline constexpr double at_round_off = 1e-30;
/// What a misprint must differ by to be called one.
inline constexpr double clearly = 1e-6;

/// A number that was measured, and the bound that it has to keep.
struct Condition {
  enum class Relation { at_most, at_least };
  double value = 0;
  Relation relation = Relation::at_most;
  double bound = 0;

  /// False too for a value that is not finite.
  [[nodiscard]] bool holds() const;
};
inline Condition at_most(double value, double bound) { return {value, Condition::Relation::at_most, bound}; }
inline Condition at_least(double value, double bound) {
  return {value, Condition::Relation::at_least, bound};
}
/// A yes or no of the engine.
inline Condition is_true(bool value) { return at_least(value ? 1 : 0, 1); }

struct Evidence {
  enum class Kind {
    value,     // printed and ours agree
    order,     // of convergence: ours agrees with the printed one or is higher by one or more
    misprint,  // printed and ours differ clearly, corrected and ours agree
    claim,     // a printed claim is wrong: the conditions show it and the corrected claim
    property   // nothing numerical is printed: the conditions state what was tested
  };
  Kind kind = Kind::value;
  Numbers printed, corrected, ours;  // `corrected` of a misprint alone; without numbers in claims
  std::vector<Condition> conditions;
  double tolerance = at_round_off;
};

/// The status of a row: reproduced, improved, erratum, qualitative; failed for everything else.
std::string judge(const Evidence& evidence);

/// The largest difference of two entries; infinite where one is not a number.
double distance(const Numbers& a, const Numbers& b);

}  // namespace pfaff
