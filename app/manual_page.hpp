// The manual page of the program, made from the declarations of its commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pfaff::app {

/// The page in the macros of man(7).
std::string manual_page(const CLI::App& app);

}  // namespace pfaff::app
