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
void copy_one_by_one(const Tiles<T>& from, std::size_t first, std::size_t count, double* to) {
  for (std::size_t row = first; row < first + count; ++row)
    for (std::size_t i = 0; i < from.components(); ++i) *to++ = static_cast<double>(from.at(row, i));
}

template <class T>
void times_of(const Block<T>& of, std::size_t first, std::size_t count, double* to) {
  for (std::size_t row = first; row < first + count; ++row) *to++ = static_cast<double>(of.time(row));
}
}  // namespace

void copy_rows(const Tiles<double>& from, std::size_t first, std::size_t count, double* to) {
  const std::size_t n = from.components();
  const std::size_t before = std::min(count, (lanes<double> - first % lanes<double>) % lanes<double>);
  copy_one_by_one(from, first, before, to);
  std::size_t row = first + before;
  const auto copy = n == 1   ? copy_tile<1>
                    : n == 2 ? copy_tile<2>
                    : n == 4 ? copy_tile<4>
                    : n == 6 ? copy_tile<6>
                             : copy_tile<0>;
  for (; row + lanes<double> <= first + count; row += lanes<double>)
    copy(from.tile(row / lanes<double>), n, to + (row - first) * n);
  copy_one_by_one(from, row, first + count - row, to + (row - first) * n);
}
void copy_rows(const Tiles<Quad>& from, std::size_t first, std::size_t count, double* to) {
  copy_one_by_one(from, first, count, to);
}
void copy_times(const Block<double>& of, std::size_t first, std::size_t count, double* to) {
  times_of(of, first, count, to);
}
void copy_times(const Block<Quad>& of, std::size_t first, std::size_t count, double* to) {
  times_of(of, first, count, to);
}

}  // namespace pfaff
