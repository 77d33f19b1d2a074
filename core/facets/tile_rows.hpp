// The rows of a block, one after another: states as whoever keeps all of them wants them, out of the tiles in
// which they are evaluated.
#pragma once

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// Some of the rows of a block: `count` of them from `first` on, so far apart.
struct ChosenRows {
  std::size_t first = 0, count = 0, apart = 1;
  [[nodiscard]] std::size_t operator[](std::size_t k) const { return first + k * apart; }
  /// Of these, where there are any.
  [[nodiscard]] std::size_t last() const { return (*this)[count - 1]; }
};

/// Writes the numbers of these rows, as doubles: components() of them for each row.
void copy_rows(const Tiles<double>& from, const ChosenRows& rows, double* to);
void copy_rows(const Tiles<Quad>& from, const ChosenRows& rows, double* to);
/// Writes the times of these rows of a block.
void copy_times(const Block<double>& of, const ChosenRows& rows, double* to);
void copy_times(const Block<Quad>& of, const ChosenRows& rows, double* to);

}  // namespace pfaff
