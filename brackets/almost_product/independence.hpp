// Whether the rows of a matrix are independent, asked of any scalar, and said in words where they are not.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/errors/errors.hpp>

namespace pfaff::detail {

/// The numbers under the scalar: of duals without their derivatives.
template <class T>
Matrix<Value<T>> values_of(const Matrix<T>& m) {
  Matrix<Value<T>> values(m.rows(), m.columns());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) values(i, j) = value_of(m(i, j));
  return values;
}

/// What a sum of n products may be off by, relative to the terms; 0 of exact scalars.
template <class T>
double rounding(std::size_t n) {
  return 64 * static_cast<double>(n) * static_cast<double>(unit_roundoff<T>());
}

/// The rank of a matrix to working precision, or exact.
template <class T>
std::size_t rank_of(const Matrix<T>& m) {
  return independent_rows(m, rounding<T>(m.columns())).independent.size();
}

/// InputError unless the rows are finite and independent to working precision: "what: row 3 (name) is a
/// combination of rows 1, 2; expected ...". Rows are counted from 1; `names` may be empty.
template <class T>
void expect_independent_rows(const Matrix<T>& m, const std::string& what, const std::string& expected,
                             const std::vector<std::string>& names = {}) {
  const Matrix<Value<T>> values = values_of(m);
  const auto row = [&](std::size_t k) {
    return std::to_string(k + 1) + (names.empty() ? "" : " (" + names[k] + ")");
  };
  for (std::size_t i = 0; i < values.rows(); ++i)
    for (std::size_t j = 0; j < values.columns(); ++j)
      if (!isfinite(values(i, j)))
        throw InputError(what + ": row " + row(i) + " is not finite; expected " + expected);
  const auto rows = independent_rows(values, rounding<Value<T>>(values.columns()));
  if (rows.dependent.empty()) return;
  const std::vector<Value<T>>& combination = rows.combinations.front();
  std::string others;
  int count = 0;
  for (const std::size_t k : rows.independent)
    if (k < rows.dependent.front() && std::abs(static_cast<double>(combination[k])) > 1e-8) {
      others += (others.empty() ? "" : ", ") + row(k);
      ++count;
    }
  throw InputError(
      what + ": row " + row(rows.dependent.front()) +
      (count == 0 ? " vanishes" : " is a combination of row" + std::string(count > 1 ? "s " : " ") + others) +
      "; expected " + expected);
}

}  // namespace pfaff::detail
