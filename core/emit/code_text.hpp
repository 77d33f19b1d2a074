// What texts for algebra systems and scripting languages share: a list of assignments and a list of results.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/emit/language.hpp>
#include <pfaff/core/emit/names.hpp>

namespace pfaff::emit {

/// The assignments of a text, one for each statement of the plan.
struct Assignment {
  std::vector<std::string> names;  // one, or those of all components of a linear system's solution
  std::string value;
  bool list = false;  // whether the value is a list of such components
};

/// A linear system in a language: the text of a list of `size` numbers, x with matrix x = right_hand_side.
using SolveText = std::string (*)(const std::vector<std::vector<Phrase>>& matrix,
                                  const std::vector<Phrase>& right_hand_side);

/// The statements of a plan in a language, in their order.
std::vector<Assignment> assignments_of(const Tape& tape, const Plan& plan, const Language& language,
                                       const std::vector<std::string>& names, SolveText solve);

/// The values of all outputs.
std::vector<std::string> outputs_of(const Tape& tape, const Language& language,
                                    const std::vector<std::string>& names);

/// Texts with a separator between them.
std::string joined(const std::vector<std::string>& texts, const std::string& separator);

/// The names of what the equations give: for each coordinate its rate, then the further outputs.
std::vector<std::string> names_of_results(const Equations& equations);

/// The lines of a legend, "q1 [m]" or, where the name in the text is another, "lambda_ [kg/s]: lambda".
std::vector<std::string> legend_of(const Equations& equations, const std::vector<std::string>& names);

/// How a constant that is no fraction is written: a decimal of 36 digits.
std::string decimal_text(const Real& value);

}  // namespace pfaff::emit
