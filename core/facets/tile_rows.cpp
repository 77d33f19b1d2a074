#include <pfaff/core/facets/tile_rows.hpp>

namespace pfaff {

namespace {
// A tile is read where it lies in a row and written where its rows do, so that neither side leaps over memory
// for long. With a size that is known the compiler turns the tile around in registers.
template <std::size_t Known>
void copy_tile(const double* tile, std::size_t components, double* to) {
  const std::size_t n = Known == 0 ? components : Known;
  for (std::size_t lane = 0; lane < lanes<double>; ++lane)
    for (std::size_t i = 0; i < n; ++i) to[lane * n + i] = tile[i * lanes<double> + lane];
}

template <class T>
void copy_one_by_one(const Tiles<T>& from, const ChosenRows& rows, double* to) {
  for (std::size_t k = 0; k < rows.count; ++k)
    for (std::size_t i = 0; i < from.components(); ++i) *to++ = static_cast<double>(from.at(rows[k], i));
}

template <class T>
void times_of(const Block<T>& of, const ChosenRows& rows, double* to) {
  for (std::size_t k = 0; k < rows.count; ++k) *to++ = static_cast<double>(of.time(rows[k]));
}
}  // namespace

void copy_rows(const Tiles<double>& from, const ChosenRows& rows, double* to) {
  if (rows.apart != 1) {
    copy_one_by_one(from, rows, to);
    return;
  }
  const std::size_t n = from.components(), first = rows.first, count = rows.count;
  const std::size_t before = std::min(count, (lanes<double> - first % lanes<double>) % lanes<double>);
  copy_one_by_one(from, {first, before}, to);
  std::size_t row = first + before;
  const auto copy = n == 1   ? copy_tile<1>
                    : n == 2 ? copy_tile<2>
                    : n == 4 ? copy_tile<4>
                    : n == 6 ? copy_tile<6>
                             : copy_tile<0>;
  for (; row + lanes<double> <= first + count; row += lanes<double>)
    copy(from.tile(row / lanes<double>), n, to + (row - first) * n);
  copy_one_by_one(from, {row, first + count - row}, to + (row - first) * n);
}
void copy_rows(const Tiles<Quad>& from, const ChosenRows& rows, double* to) {
  copy_one_by_one(from, rows, to);
}
void copy_times(const Block<double>& of, const ChosenRows& rows, double* to) {
  if (!of.times.empty() || rows.count == 0) {
    times_of(of, rows, to);
    return;
  }
  // Numbers of steps are exact as doubles.
  const auto first = static_cast<double>(of.step(rows.first)),
             apart = static_cast<double>(rows.apart) * static_cast<double>(of.stride);
  for (int k = 0; k < static_cast<int>(rows.count); ++k) to[k] = of.t0 + (first + k * apart) * of.h;
}
void copy_times(const Block<Quad>& of, const ChosenRows& rows, double* to) { times_of(of, rows, to); }

}  // namespace pfaff
