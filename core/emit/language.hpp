// How a language writes numbers and operations, and the expressions of a tape written in it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/emit/plan.hpp>

namespace pfaff::emit {

/// How strongly the parts of a text hold together: a part of a product that holds together less than a
/// product is put in parentheses. A negative number is as weak as a sum.
enum class Strength { sum, product, call, atom };

struct Phrase {
  std::string text;
  Strength strength;
};

/// The usual names of the functions of one argument; of special ones in the order of SpecialFunction.
inline constexpr std::array<std::string_view, 5> elementary_functions{"sqrt", "exp", "log", "sin", "cos"};
inline constexpr std::array<std::string_view, 4> special_functions{"atan", "erf", "sinh", "tanh"};

/// A language. What most of them share is written here; the members that differ are virtual.
class Language {
 public:
  virtual ~Language() = default;

  /// An expression gets a variable after so many operations.
  [[nodiscard]] virtual PlanRules rules() const = 0;
  /// Whether a + (b + c) may be written a + b + c. It may not where the order of roundings matters.
  [[nodiscard]] virtual bool associative() const = 0;
  [[nodiscard]] virtual Phrase number(const Real& value) const = 0;
  /// A function of one argument by its usual name.
  [[nodiscard]] virtual Phrase function(std::string_view name, const Phrase& argument) const = 0;
  [[nodiscard]] virtual Phrase power(const Phrase& base, const Real& exponent) const = 0;
  /// `positive` where condition > 0, else `otherwise`.
  [[nodiscard]] virtual Phrase choice(const Phrase& condition, const Phrase& positive,
                                      const Phrase& otherwise) const = 0;
  [[nodiscard]] virtual Phrase product(const Phrase& a, const Phrase& b) const;
  [[nodiscard]] virtual Phrase quotient(const Phrase& a, const Phrase& b) const;
  [[nodiscard]] virtual std::string parenthesised(const std::string& text) const { return "(" + text + ")"; }

  /// The text of a phrase, in parentheses where it is weaker than `least`.
  [[nodiscard]] std::string at_least(Strength least, const Phrase& phrase) const {
    return phrase.strength < least ? parenthesised(phrase.text) : phrase.text;
  }
};

/// The expressions of a tape in a language. `names` has a name for every slot that stands for itself but the
/// constants.
class Expressions {
 public:
  Expressions(const Tape& tape, const Language& language, const std::vector<std::string>& names)
      : tape_(tape), language_(language), names_(names) {}

  /// The value of a slot where it is used: its name, or what is written for it.
  [[nodiscard]] Phrase value(int slot) const;
  /// What the variable of a slot is set to.
  [[nodiscard]] Phrase definition(int slot) const;
  /// The entries of a linear system: its matrix, row by row, and then its right-hand side.
  [[nodiscard]] std::vector<Phrase> entries(const LinearSystem& system) const;

 private:
  const Tape& tape_;
  const Language& language_;
  const std::vector<std::string>& names_;
};

/// The usual name of a function of one argument: sqrt, exp, log, sin, cos, atan, erf.
std::string_view usual_name(const Instruction& function);

/// True where a tape calls this special function, by its usual name.
bool calls(const Tape& tape, std::string_view name);

/// The double nearest to a constant, in as few digits as name it, with a point or an exponent: "2.0",
/// "1e-12".
std::string double_text(const Real& value);

/// A system's name in words that may stand in any text: what could end a comment or a string is left out.
std::string plain_words(const std::string& text);

}  // namespace pfaff::emit
