// What is left of a quantity that was watched along a run, a conserved one or the residual of a level of
// constraints: one list of numbers and texts, from which summary.json, results.csv, findings, reports and the
// table of docs/drift-and-cost.md are made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <pfaff/runs/support/drift.hpp>
#include <pfaff/runs/support/growth.hpp>

namespace pfaff {

struct WatchedQuantity {
  Drift drift;
  RoundOff round_off{};                         // of conserved quantities
  std::optional<Growth> growth = std::nullopt;  // of residuals
  bool residual = false;
};

struct QuantityField {
  enum class Of { both, conserved, residuals };
  /// Nothing where the number is not known.
  using Value = std::variant<std::monostate, double, std::int64_t, std::string>;

  std::string name;  // its key in summary.json, and its column in results.csv behind the quantity and a colon
  std::string unit;  // with [e] for that of the quantity and [t] for that of time; empty for pure numbers
  std::string meaning;
  bool column;    // results.csv has it
  bool compared;  // findings and ensembles may name it; of `final` it is the size
  Of of;
  Value (*value)(const WatchedQuantity& quantity);

  [[nodiscard]] bool is_of(bool residual) const {
    return of == Of::both || residual == (of == Of::residuals);
  }
};

/// All of them, in the order of columns.
const std::vector<QuantityField>& quantity_fields();

/// The unit of a field of a quantity in `quantity`, in a motion whose times are in `time`; an empty one is 1.
std::string unit_of(const QuantityField& field, const std::string& quantity, const std::string& time);

}  // namespace pfaff
