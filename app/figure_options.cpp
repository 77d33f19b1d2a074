#include <pfaff/app/figure_options.hpp>

namespace pfaff::app {

void add_figure_options(CLI::App& sub, PaperFigures& wanted) {
  CLI::Option* kinds = sub.add_option("--figures", wanted.kinds,
                                      "Figures and tables for papers too: some of pdf, svg, pgf, png")
                           ->type_name("KIND,...");
  sub.add_option("--width", wanted.width, "Width of the figures for papers (default 85mm)")
      ->type_name("LENGTH")
      ->needs(kinds);
  sub.add_option("--style", wanted.style, "A style file of matplotlib's for the figures for papers")
      ->type_name("FILE")
      ->needs(kinds);
}

}  // namespace pfaff::app
