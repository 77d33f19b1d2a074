// The languages in which equations of motion are written as text.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <pfaff/core/emit/equations.hpp>

namespace pfaff {

/// One language.
struct Emitter {
  std::string_view name;         // as `pfaff derive --emit` takes it
  std::string_view description;  // what the text is, in one line
  std::string (*write)(const Equations& equations);
};

/// All languages, in the order in which they are listed.
std::span<const Emitter> emitters();

/// C++: a function behind a C interface that includes nothing of Pfaff. Replays of the tape in double
/// give the same numbers, to the last bit where the compiler does not contract.
std::string write_cpp(const Equations& equations);
/// LaTeX with amsmath: a short document with a legend of symbols, named intermediate quantities and the
/// equations.
std::string write_latex(const Equations& equations);
/// A Python module for SymPy, with exact constants.
std::string write_sympy(const Equations& equations);
/// A function of Mathematica, with exact constants.
std::string write_mathematica(const Equations& equations);
/// A function of Julia for any number type, in the form that DifferentialEquations.jl calls.
std::string write_julia(const Equations& equations);

}  // namespace pfaff
