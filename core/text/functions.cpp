#include <pfaff/core/text/functions.hpp>

#include <algorithm>
#include <array>

namespace pfaff::text {

namespace {
using Values = std::span<const Recorded>;

constexpr std::array functions{KnownFunction{{"sqrt", 1}, [](Values x) { return sqrt(x[0]); }},
                               KnownFunction{{"exp", 1}, [](Values x) { return exp(x[0]); }},
                               KnownFunction{{"log", 1}, [](Values x) { return log(x[0]); }},
                               KnownFunction{{"sin", 1}, [](Values x) { return sin(x[0]); }},
                               KnownFunction{{"cos", 1}, [](Values x) { return cos(x[0]); }},
                               KnownFunction{{"tan", 1}, [](Values x) { return sin(x[0]) / cos(x[0]); }},
                               KnownFunction{{"asin", 1}, [](Values x) { return asin(x[0]); }},
                               KnownFunction{{"acos", 1}, [](Values x) { return acos(x[0]); }},
                               KnownFunction{{"atan", 1}, [](Values x) { return atan(x[0]); }},
                               KnownFunction{{"atan2", 2}, [](Values x) { return atan2(x[0], x[1]); }},
                               KnownFunction{{"sinh", 1}, [](Values x) { return sinh(x[0]); }},
                               KnownFunction{{"cosh", 1}, [](Values x) { return cosh(x[0]); }},
                               KnownFunction{{"tanh", 1}, [](Values x) { return tanh(x[0]); }},
                               KnownFunction{{"erf", 1}, [](Values x) { return erf(x[0]); }},
                               KnownFunction{{"abs", 1}, [](Values x) { return abs(x[0]); }},
                               KnownFunction{{"sign", 1}, [](Values x) { return sign(x[0]); }},
                               KnownFunction{{"min", 2}, [](Values x) { return min(x[0], x[1]); }},
                               KnownFunction{{"max", 2}, [](Values x) { return max(x[0], x[1]); }},
                               KnownFunction{{"pow", 2}},
                               KnownFunction{{"select", 3}}};
}  // namespace

std::span<const KnownFunction> known_functions() { return functions; }

const KnownFunction* known_function(std::string_view name) {
  const auto* const found = std::find_if(functions.begin(), functions.end(),
                                         [&](const KnownFunction& f) { return f.function.name == name; });
  return found == functions.end() ? nullptr : found;
}

}  // namespace pfaff::text
