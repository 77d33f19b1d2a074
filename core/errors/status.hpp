// How a step, a solve or a run ended.
#pragma once

#include <string_view>

namespace pfaff {

enum class Status {
  converged,      // the result is good to round-off
  not_converged,  // an implicit solve stopped above round-off
  singular,       // a linear system had no solution to working precision
  non_finite      // a NaN or an infinity appeared (overflow, a formula left its domain)
};

constexpr std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::not_converged:
      return "not_converged";
    case Status::singular:
      return "singular";
    case Status::non_finite:
      return "non_finite";
  }
  return "unknown";
}

}  // namespace pfaff
