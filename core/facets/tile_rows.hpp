// The rows of a block, one after another: states as whoever keeps all of them wants them, out of the tiles in
// which they are evaluated.
#pragma once

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// Writes the numbers of `count` rows from `first` on, as doubles: components() of them for each row.
void copy_rows(const Tiles<double>& from, std::size_t first, std::size_t count, double* to);
void copy_rows(const Tiles<Quad>& from, std::size_t first, std::size_t count, double* to);
/// Writes the times of these rows of a block.
void copy_times(const Block<double>& of, std::size_t first, std::size_t count, double* to);
void copy_times(const Block<Quad>& of, std::size_t first, std::size_t count, double* to);

}  // namespace pfaff
