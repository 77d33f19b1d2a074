// Files of reference values, whose numbers are decimal strings.
#pragma once

#include <fstream>
#include <pfaff/bench/runner/json.hpp>
#include <string>
#include <vector>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff::testing {

/// The file of that name, without its ending, in tests/golden.
inline nlohmann::json golden(const std::string& name) {
  return nlohmann::json::parse(std::ifstream(std::string(PFAFF_GOLDEN) + "/" + name + ".json"));
}

inline Real real_of(const nlohmann::json& text) { return Real::parse(text.get<std::string>()).value(); }
inline std::vector<Real> reals_of(const nlohmann::json& list) {
  std::vector<Real> values;
  for (const auto& text : list) values.push_back(real_of(text));
  return values;
}
template <class T = Quad>
std::vector<T> numbers(const nlohmann::json& list) {
  std::vector<T> values;
  for (const auto& text : list) values.push_back(T(real_of(text)));
  return values;
}

}  // namespace pfaff::testing
