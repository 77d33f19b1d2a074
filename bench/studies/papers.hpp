// The papers that are reproduced, by name.
#pragma once

#include <string>
#include <vector>

namespace pfaff {

enum class Paper { su_qin, nguyen_turski, pitanga_rodrigues, others };

/// Their names, in the order in which they are reproduced.
std::vector<std::string> papers();

/// The paper of that name. InputError for an unknown one.
Paper paper_named(const std::string& name);

}  // namespace pfaff
