// The reference Gram matrices of recursive_brackets.json, exact.
#pragma once

#include <string>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/rational.hpp>

#include "../golden_numbers.hpp"

namespace pfaff::testing {

inline const nlohmann::json& golden_brackets() {
  static const nlohmann::json file = golden("recursive_brackets");
  return file;
}
inline Rational fraction(const std::string& text) { return Rational(*Real::parse(text)); }
inline Matrix<Rational> golden_matrix(const nlohmann::json& rows) {
  Matrix<Rational> m(rows.size(), rows[0].size());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = fraction(rows[i][j].get<std::string>());
  return m;
}

using Exact = Matrix<Rational>;
inline bool zero(const Exact& m) { return largest(m) == Rational(0); }

}  // namespace pfaff::testing
