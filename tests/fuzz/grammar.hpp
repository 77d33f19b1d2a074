// Random inputs in the languages that the program reads: states, configurations, experiments, models of beads
// and rods, systems and brackets written as text, methods as tables of coefficients and as maps.
//
// Inputs are written by the grammar of their language with the names, parameters and ranges of the plug-ins
// that are registered, so that most of them pass the parser and reach what comes behind it. Then, now and
// then, something is made odd: a number, a name, a line. The same seed gives the same inputs on every
// machine.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace pfaff::fuzz {

/// A source of choices. The generator is the standard's own, whose numbers are fixed; its distributions are
/// not, and are not used.
class Choices {
 public:
  explicit Choices(std::uint64_t seed) : generator_(seed) {}
  /// 0 ... count - 1; `count` > 0.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(generator_() % count); }
  /// True once in `count` times.
  bool once_in(std::size_t count) { return below(count) == 0; }
  template <class List>
  const auto& one_of(const List& list) {
    return list[below(list.size())];
  }
  const char* one_of(std::initializer_list<const char*> list) { return list.begin()[below(list.size())]; }

 private:
  std::mt19937_64 generator_;
};

enum class Language { state, configuration, experiment, model, text, bracket, table };

/// An input and the name of the file that it would stand in, whose extension may matter.
struct Input {
  std::string file, text;
};

/// A random input of the language.
Input random_input(Language language, Choices& choices);

/// The text between quotation marks.
std::string quoted(const std::string& text);
/// A number as the languages write it: mostly a small decimal, sometimes an odd one.
std::string random_number(Choices& choices);
/// name = value for some of the parameters of a registered system or integrator, in their ranges; empty where
/// there is none of the name. Keys carry the prefix.
struct Setting {
  std::string key, value;
};
std::vector<Setting> random_settings(Choices& choices, const std::string& kind, const std::string& name,
                                     const std::string& prefix);

/// The text with one thing made odd: a number, a quoted text, a line.
std::string made_odd(std::string text, Choices& choices);

std::string random_model_toml(Choices& choices);
std::string random_model_json(Choices& choices);
std::string random_text_model(Choices& choices);
std::string random_text_bracket(Choices& choices);
std::string random_table(Choices& choices);
/// An expression that reads this name mostly.
std::string random_expression(Choices& choices, const std::string& name);

}  // namespace pfaff::fuzz
