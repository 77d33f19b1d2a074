// The rows of a paper's reproduction, as its sections write them down.
//
// "Printed" is computed by the files of papers/printed/ alone, which know the formulas of the papers
// and nothing of the engine, and "ours" by the engine alone: its plug-ins, tapes and solvers.
#pragma once

#include <string>
#include <vector>

#include <pfaff/papers/reproduce.hpp>

namespace pfaff {

/// Six digits of each number; 0 for what is no more than round-off of the largest of them, or of 1.
std::string shown(const Numbers& x);
/// Four digits; 0 for round-off of 1.
std::string shown(double x);

/// What stands in a row without numbers to compare: texts instead of what is printed and of what is ours.
struct Texts {
  std::string printed, ours;
};

/// Collects the rows of one section.
class Rows {
 public:
  explicit Rows(std::string section) : section_(std::move(section)) {}

  /// Printed and ours agree to round-off.
  void reproduced(const std::string& equation, const std::string& what, const Numbers& printed,
                  const Numbers& ours);
  /// Digits that are printed, shown as they are, and ours with as many: they agree to the tolerance.
  void published(const std::string& equation, const std::string& what,
                 const std::vector<std::string>& printed, const Numbers& ours, double tolerance);
  /// An order of convergence agrees with the printed one to a tolerance of its own, or is higher by one.
  void order(const std::string& equation, const std::string& what, double printed, double measured,
             double tolerance);
  /// A misprint: the printed value must differ from ours clearly, and the corrected one must not.
  void erratum(const std::string& equation, const std::string& what, const Numbers& printed,
               const Numbers& corrected, const Numbers& ours, const std::string& entry);
  /// A claim that is wrong as printed. The conditions are that it is, and that the corrected one holds; the
  /// value of the first is shown as the difference.
  void claim(const std::string& equation, const std::string& what, const Texts& texts,
             const std::vector<Condition>& conditions, const std::string& entry);
  /// Something that no printed number says: a misprint of notation, whose corrected form is tested, or a
  /// property. The value and the bound of the first condition are shown.
  void qualitative(const std::string& equation, const std::string& what, const Texts& texts,
                   const std::vector<Condition>& conditions, const std::string& tested);

  [[nodiscard]] std::vector<ReproducedRow> take() { return std::move(rows_); }

 private:
  void add(const std::string& equation, const std::string& what, const Texts& texts, Evidence evidence,
           const std::string& entry);
  std::string section_;
  std::vector<ReproducedRow> rows_;
};

}  // namespace pfaff
