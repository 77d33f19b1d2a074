#include <pfaff/core/emit/emitter.hpp>

#include <array>

namespace pfaff {

std::span<const Emitter> emitters() {
  static constexpr std::array<Emitter, 5> table{{
      {"cpp", "a C++ function behind a C interface, to be compiled without Pfaff", &write_cpp},
      {"latex", "a LaTeX document: a legend, named intermediate quantities, the equations", &write_latex},
      {"sympy", "a Python module for SymPy, with exact constants", &write_sympy},
      {"mathematica", "a Mathematica function, with exact constants", &write_mathematica},
      {"julia", "a Julia function for any number type, as DifferentialEquations.jl calls it", &write_julia},
  }};
  return table;
}

}  // namespace pfaff
