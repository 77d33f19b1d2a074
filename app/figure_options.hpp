// The options of figures for papers, which `pfaff compare` and `pfaff plot` share.
#pragma once

#include <pfaff/app/command.hpp>
#include <pfaff/bench/experiment/results.hpp>

namespace pfaff::app {

/// Adds --figures, --width and --style to a command.
void add_figure_options(CLI::App& sub, PaperFigures& wanted);

}  // namespace pfaff::app
