// Small matrices for formulas as papers print them. Determinants are expanded by Laplace's rule and inverses
// are made of cofactors, so that nothing here is shared with the engine's linear algebra, which eliminates.
// T is Quad or Rational; indices count from 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfaff::printed {

/// Rows of numbers, all of one length.
template <class T>
using Table = std::vector<std::vector<T>>;

template <class T>
Table<T> zero_table(std::size_t rows, std::size_t columns) {
  return Table<T>(rows, std::vector<T>(columns, T(0)));
}
template <class T>
Table<T> unit_table(std::size_t n) {
  Table<T> m = zero_table<T>(n, n);
  for (std::size_t i = 0; i < n; ++i) m[i][i] = T(1);
  return m;
}
/// The entries, row by row.
template <class T>
std::vector<T> listed(const Table<T>& m) {
  std::vector<T> list;
  for (const std::vector<T>& row : m) list.insert(list.end(), row.begin(), row.end());
  return list;
}
template <class T>
Table<T> transposed(const Table<T>& m) {
  Table<T> turned = zero_table<T>(m.front().size(), m.size());
  for (std::size_t i = 0; i < m.size(); ++i)
    for (std::size_t j = 0; j < m[i].size(); ++j) turned[j][i] = m[i][j];
  return turned;
}
template <class T>
Table<T> product(const Table<T>& a, const Table<T>& b) {
  Table<T> m = zero_table<T>(a.size(), b.front().size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.front().size(); ++j)
      for (std::size_t k = 0; k < b.size(); ++k) m[i][j] = m[i][j] + a[i][k] * b[k][j];
  return m;
}
template <class T>
std::vector<T> product(const Table<T>& a, const std::vector<T>& x) {
  std::vector<T> y(a.size(), T(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) y[i] = y[i] + a[i][j] * x[j];
  return y;
}
/// factor a + b.
template <class T>
Table<T> sum(Table<T> a, const Table<T>& b, const T& factor = T(1)) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) a[i][j] = factor * a[i][j] + b[i][j];
  return a;
}
template <class T>
Table<T> difference(Table<T> a, const Table<T>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) a[i][j] = a[i][j] - b[i][j];
  return a;
}
/// Chosen rows and columns, in the order given.
template <class T>
Table<T> part(const Table<T>& m, const std::vector<std::size_t>& rows,
              const std::vector<std::size_t>& columns) {
  Table<T> chosen;
  for (const std::size_t i : rows) {
    chosen.emplace_back();
    for (const std::size_t j : columns) chosen.back().push_back(m[i][j]);
  }
  return chosen;
}

/// The determinant: Laplace's expansion along the first row, the second row, and so on, each set of columns
/// once. 1 for the empty matrix.
template <class T>
T determinant(const Table<T>& m) {
  const std::size_t n = m.size();
  // minors[columns] is the determinant of the last rows, as many as the set has columns.
  std::vector<T> minors(std::size_t{1} << n, T(0));
  minors[0] = T(1);
  for (std::uint32_t columns = 1; columns < minors.size(); ++columns) {
    std::size_t size = 0;
    for (std::uint32_t rest = columns; rest != 0; rest &= rest - 1) ++size;
    const std::vector<T>& row = m[n - size];
    bool positive = true;
    for (std::size_t j = 0; j < n; ++j) {
      if ((columns >> j & 1U) == 0) continue;
      const T term = row[j] * minors[columns & ~(1U << j)];
      minors[columns] = positive ? minors[columns] + term : minors[columns] - term;
      positive = !positive;
    }
  }
  return minors.back();
}

/// The inverse, cofactors over the determinant.
template <class T>
Table<T> inverse(const Table<T>& m) {
  const std::size_t n = m.size();
  const T whole = determinant(m);
  Table<T> result = zero_table<T>(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<std::size_t> rows, columns;
      for (std::size_t k = 0; k < n; ++k) {
        if (k != i) rows.push_back(k);
        if (k != j) columns.push_back(k);
      }
      const T minor = determinant(part(m, rows, columns));
      result[j][i] = ((i + j) % 2 == 0 ? minor : T(0) - minor) / whole;
    }
  return result;
}

}  // namespace pfaff::printed
