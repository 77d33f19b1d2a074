// Notices: what a user should know although the work goes on, such as that formulas are not compiled because
// there is no compiler.
#pragma once

#include <string>

namespace pfaff {

/// Says a sentence, by default as a line on stderr. Not to be called while a lock is held.
void notice(const std::string& text);

/// Hands notices to `say` from now on: in an interpreter they are its warnings.
void say_notices_by(void (*say)(const std::string& text));

}  // namespace pfaff
