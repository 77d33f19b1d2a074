// Names in the emitted text: the user's own where the language allows them.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/emit/equations.hpp>
#include <pfaff/core/emit/plan.hpp>

namespace pfaff::emit {

/// What a language asks of a name. Everywhere a name is made of letters, digits and `joint`.
struct NameRules {
  std::string_view joint;                         // stands for characters that are not allowed; may be empty
  std::string_view reserved;                      // words with a meaning of their own, a space between them
  std::string (*other)(const std::string&);       // a name instead of a reserved one
  bool (*refuses)(const std::string&) = nullptr;  // names that are reserved besides
  bool usual_functions = true;                    // functions have their usual names, which are reserved then
};

/// Gives names, no two of them the same. A name that is taken, reserved or not allowed is changed; the same
/// sequence of names is always changed in the same way.
class Names {
 public:
  explicit Names(const NameRules& rules);
  /// A name like `wanted` that was not given before.
  std::string operator()(std::string_view wanted);

 private:
  [[nodiscard]] bool is_free(const std::string& name) const { return taken_.count(name) == 0; }
  NameRules rules_;
  std::set<std::string> taken_;
};

/// The names of everything that stands in the text of one set of equations.
struct TextNames {
  std::string time;
  std::vector<std::string> inputs;  // coordinates, then parameters
  std::vector<std::string> slots;   // of the time, of inputs and of slots with a variable; otherwise empty
};
/// Variables are called v1, v2, ..., and sin_x and cos_x where they are the sine and cosine of an input x.
TextNames text_names(const Equations& equations, const Plan& plan, Names& names);

/// `name_` of a reserved word.
std::string with_underscore(const std::string& name);

}  // namespace pfaff::emit
