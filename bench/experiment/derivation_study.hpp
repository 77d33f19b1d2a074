// Experiments of the kind `derivation`, as they are asked for: how large the equations of a system become and
// how long it takes to derive them, method by method, against the number of its constraints. They are run by
// derive/derivation_growth/, in the library of studies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

class Keys;

/// One method, with the values of the system's parameter at which it derives equations, in rising order.
struct DerivationSweep {
  std::string method;
  std::vector<std::string> sizes;
  double exponent_below = 0;  // a finding: the exponent of the operations stays below this; 0 for none
};

/// A published time for one pair of equations, factor e^(rate K) seconds.
struct PublishedTime {
  std::string label;
  double factor = 0, rate = 0;
};

struct DerivationStudy {
  std::string system, parameter;  // the parameter that makes it larger
  Assignments set;
  double seconds = 60;  // a method goes no further after a derivation that takes longer
  double fit_from = 8;
  std::vector<DerivationSweep> sweeps;
  std::vector<PublishedTime> published;

  /// The number of derivations.
  [[nodiscard]] std::size_t size() const;
};

/// Reads what such an experiment has beside title and references. InputError as read_experiment.
DerivationStudy read_derivation_study(Keys& keys, const std::string& where, bool quick);

}  // namespace pfaff
