// Rows out of tiles, one after another or some apart: every size, from every row on.
#include <gtest/gtest.h>

#include <vector>

#include <pfaff/core/facets/tile_rows.hpp>

namespace pfaff {
namespace {

template <class T>
void gives_every_row() {
  constexpr std::size_t rows = 29;
  for (std::size_t components = 1; components <= 9; ++components) {
    Block<T> block(components, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<T> z;
      for (std::size_t i = 0; i < components; ++i) z.push_back(T(static_cast<double>(100 * row + i)));
      block.states.put(row, z.data());
    }
    block.first = 7, block.stride = 3, block.t0 = T(0.5), block.h = T(0.25);
    for (std::size_t first = 0; first < rows; ++first)
      for (std::size_t apart = 1; apart <= 4; ++apart)
        for (std::size_t count = 0; count == 0 || first + (count - 1) * apart < rows; ++count) {
          std::vector<double> states(components * count + 1, -1), times(count + 1, -1);
          copy_rows(block.states, {first, count, apart}, states.data());
          copy_times(block, {first, count, apart}, times.data());
          for (std::size_t row = 0; row < count; ++row) {
            const auto number = static_cast<double>(first + row * apart);
            EXPECT_EQ(times[row], 0.5 + (7 + number * 3) * 0.25);
            for (std::size_t i = 0; i < components; ++i)
              EXPECT_EQ(states[row * components + i], 100 * number + static_cast<double>(i));
          }
          EXPECT_EQ(states.back(), -1) << "written behind the last row";
          EXPECT_EQ(times.back(), -1);
        }
  }
}
TEST(TileRows, AreThoseOfTheTiles) {
  gives_every_row<double>();
  gives_every_row<Quad>();
}

}  // namespace
}  // namespace pfaff
