// Methods that are read from tables of coefficients: those that ship, and how faulty ones are refused.
#pragma once

#include <gtest/gtest.h>

#include <fstream>

#include <pfaff/core/system.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

#include "../temporary_directory.hpp"

namespace pfaff::testing {

inline const std::string shipped_tables = std::string(PFAFF_GOLDEN) + "/../../examples/tables/";

/// The message with which a table is refused, or what it became.
inline std::string table_refusal(const std::string& text) {
  const TemporaryDirectory files;
  std::ofstream(files / "table.toml") << text;
  try {
    return "accepted: " + read_method_table(files / "table.toml")->name();
  } catch (const InputError& error) {
    return error.what();
  }
}
/// The table is refused in one line that names the file and holds every part.
inline void expect_table_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = table_refusal(text);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_NE(message.find("table.toml"), std::string::npos) << message;
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << message;
}

/// A kinetic energy that is not quadratic, and the same as far as it is.
struct Relativistic {
  static constexpr int dimension = 2;
  bool slow = false;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return slow ? T(p[0] * p[0] / 2) : sqrt(1 + p[0] * p[0]);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};

}  // namespace pfaff::testing
