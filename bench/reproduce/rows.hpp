// The rows of a paper's reproduction: how printed and computed numbers are compared and what the result is
// called.
#pragma once

#include <string>
#include <vector>

#include <pfaff/bench/reproduce/reproduce.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

using Numbers = std::vector<Quad>;

/// Quad: 1e-34 a rounding, a few hundred of them on numbers about 1.
inline constexpr double at_round_off = 1e-30;
/// What a misprint must differ by to be called one.
inline constexpr double clearly = 1e-6;

/// Six digits of each number.
std::string shown(const Numbers& x);
/// The largest difference of two entries; infinite where one is not a number.
double distance(const Numbers& a, const Numbers& b);

/// Collects the rows of one section.
class Rows {
 public:
  explicit Rows(std::string section) : section_(std::move(section)) {}

  /// Printed and ours agree to round-off.
  void reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                  const Numbers& ours);
  /// A number agrees to a tolerance of its own.
  void measured(const std::string& equation, const std::string& what, double printed, double ours,
                double tolerance);
  /// A misprint: the printed value must differ from ours clearly, and the corrected one must not.
  void erratum(const std::string& equation, const std::string& what, const Numbers& printed,
               const Numbers& corrected, const Numbers& ours, const std::string& entry);
  /// A claim that is wrong as printed, with what was measured, how far off it is and whether the corrected
  /// one was seen to hold.
  void claim(const std::string& equation, const std::string& what, const std::string& printed,
             const std::string& ours, double difference, bool corrected_holds, const std::string& entry);
  /// Something that no printed number says: a misprint of notation, whose corrected form is tested, or a
  /// property.
  void qualitative(const std::string& equation, const std::string& what, const std::string& printed,
                   const std::string& ours, double difference, double tolerance, bool holds,
                   const std::string& tested);

  [[nodiscard]] std::vector<ReproducedRow> take() { return std::move(rows_); }

 private:
  void add(ReproducedRow row);
  std::string section_;
  std::vector<ReproducedRow> rows_;
};

}  // namespace pfaff
