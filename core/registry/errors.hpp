// Errors that reach the user, each one line: what, where, what was expected.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pfaff {

/// Wrong usage or input (exit status 2): found before work starts.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Something went wrong while working (exit status 1), such as a disk that is full.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance; empty when none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

/// "unknown system 'damped-oscilator'; did you mean 'damped-oscillator'?" or with the list of valid names.
std::string unknown_name(std::string_view kind, std::string_view name,
                         const std::vector<std::string>& candidates);

}  // namespace pfaff
