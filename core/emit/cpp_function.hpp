// One tape as a C++ function: straight-line code with one variable for each number that has one.
//
// A long tape is cut into functions of a few hundred operations, the parts, because the time of a compiler
// grows faster than the length of a function. A number that one part computes and a later one reads is put
// into an array, whose places are used again once nobody reads them any more. Results are written at the end,
// so that they may lie where the arguments do. Linear systems are solved by a function that is written into
// the text, with the pivots and the order of operations of core/linear/lu.hpp: the code computes what a
// replay of the tape computes, rounding by rounding, unless the compiler contracts products and sums.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/emit/language.hpp>

namespace pfaff::emit {

/// How a function is called, and the names of what it reads.
struct CppInterface {
  std::string name;
  std::string parameters;                 // all of them: the last is `double* results`
  std::string part_parameters;            // what parts get besides the array `shared`
  std::string part_arguments;             // and how it is handed on
  std::vector<std::string> input_names;   // of the tape's inputs, as local variables
  std::vector<std::string> input_values;  // what these are set to, such as "state[0]"
  /// The type of all numbers, to which others than double are converted by as_lanes<number>(...). Tapes with
  /// linear systems are written for double alone.
  std::string number = "double";
};

/// The functions of the standard library are written with this before their names: "std::" or "".
class Cpp : public Language {
 public:
  explicit Cpp(std::string prefix) : prefix_(std::move(prefix)) {}
  [[nodiscard]] PlanRules rules() const override { return {40, false, false}; }
  [[nodiscard]] bool associative() const override { return false; }
  [[nodiscard]] Phrase number(const Real& value) const override;
  [[nodiscard]] Phrase function(std::string_view name, const Phrase& argument) const override;
  [[nodiscard]] Phrase power(const Phrase& base, const Real& exponent) const override;
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override;

 private:
  std::string prefix_;
};

/// For vectors of doubles, between which `?` does not choose.
class CppInLanes final : public Cpp {
 public:
  CppInLanes() : Cpp("") {}
  [[nodiscard]] Phrase choice(const Phrase& condition, const Phrase& positive,
                              const Phrase& otherwise) const override;
};

/// Operations in one part.
inline constexpr int cpp_part_size = 400;

/// Whether the tape is so long that it is cut into parts, and the plan for it.
bool cut_into_parts(const Tape& tape);
Plan cpp_plan(const Tape& tape, const Cpp& language);

/// The text of the function, parts before it. `names` has the names of slots (names.hpp).
std::string cpp_function(const Tape& tape, const Plan& plan, const Cpp& language,
                         const CppInterface& interface, std::vector<std::string> names);

/// The function template half_power, with which powers of half an integer are written.
std::string cpp_half_power(const std::string& prefix);

/// The function template that solves linear systems; empty where the tape has none.
std::string cpp_solver(const Tape& tape);

/// Words that are no names in C++, or are used in the emitted text.
extern const std::string_view cpp_reserved;

}  // namespace pfaff::emit
