// What steps cost, counted: one list, from which summary.json, results.csv and the measure `cost` are made.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

/// A number of Counters.
struct CounterField {
  std::string_view name;      // its key in summary.json
  std::string_view per_step;  // its column in tables, over the number of steps
  std::int64_t Counters::*count;
};

/// All of them but the number of steps.
inline constexpr std::array<CounterField, 4> counter_fields{
    {{"right_hand_sides", "rhs_per_step", &Counters::fields},
     {"jacobians", "jacobians_per_step", &Counters::jacobians},
     {"iterations", "iterations_per_step", &Counters::iterations},
     {"factorisations", "factorisations_per_step", &Counters::factorisations}}};

}  // namespace pfaff
