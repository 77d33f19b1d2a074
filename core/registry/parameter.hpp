// Parameters: declared once by a plug-in, seen by the command line, experiments, `describe` and the docs.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/real.hpp>
#include <pfaff/core/registry/member_names.hpp>

namespace pfaff {

/// The least and the largest value that a number may have.
using Range = std::array<double, 2>;
inline constexpr Range unbounded{-std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};

/// name = value settings from the command line or a file, in order.
using Assignments = std::vector<std::pair<std::string, std::string>>;

/// True where the key is among the settings.
bool is_set(const Assignments& assignments, std::string_view key);

/// Another plug-in with its settings, as the value of a parameter. Its text is NAME or
/// NAME(key=value, key=value); values may be of this form themselves.
struct PluginValue {
  std::string name;
  Assignments settings{};
};

/// Parses a text of that form; InputError, naming `what`, for any other, and where a key is set twice. A
/// comma begins the next setting where a key and '=' follow it; elsewhere it belongs to a list of numbers.
PluginValue parse_plugin_value(const std::string& text, const std::string& what);
std::string to_string(const PluginValue& value);

struct Parameter;

/// The plug-ins that a parameter may be given.
struct PluginChoice {
  std::string kind;                                 // "integrator", "formulation", ...
  std::function<std::vector<std::string>()> names;  // asked when needed: plug-ins register in any order
  /// The parameters of the plug-in of that name. InputError, with the nearest name, where there is none.
  std::function<std::vector<Parameter>(const std::string& name)> parameters;
  /// Every parameter of the plug-in `value` with the value it gets. InputError for what cannot be chosen.
  std::function<Assignments(const PluginValue& value)> resolve;
};

/// A named, ranged setting of a plug-in.
struct Parameter {
  enum class Kind { real, integer, choice, list, file, text, plugin };

  std::string name;
  std::string unit;  // empty for pure numbers
  std::string meaning;
  Kind kind = Kind::real;
  double minimum = 0, maximum = 0;   // numbers only, both ends included
  std::vector<std::string> choices;  // of choices; of a text what it is, such as EXPRESSION
  PluginChoice plugins{};            // plug-ins only

  /// Writes and reads the member of the plug-in object this parameter stands for.
  std::function<void(void* object, const std::string& text)> write;
  std::function<std::string(const void* object)> read;

  /// True for the name itself and, where the value is a plug-in, for name.KEY, which sets a parameter of that
  /// plug-in.
  [[nodiscard]] bool takes(std::string_view key) const;

  /// Sets the parameter from text. Throws InputError naming the parameter, its range and what was given.
  void assign(void* object, const std::string& text, std::string_view owner) const;
};

/// "0 .. 10 1/s", "P|S" or "FILE"; of plug-ins the names that can be chosen, as in "verlet|rattle".
std::string range_of(const Parameter& parameter);

/// The numbers of "1,-0.5,1/3", none for an empty text; nullopt where one is not a number.
std::optional<std::vector<Real>> parse_list(std::string_view text);

/// A real parameter of plug-in struct S.
template <class S>
Parameter parameter(Real S::*member, std::string name, std::string unit, double minimum, double maximum,
                    std::string meaning = {}) {
  Parameter p{std::move(name),
              std::move(unit),
              std::move(meaning),
              Parameter::Kind::real,
              minimum,
              maximum,
              {},
              {},
              {},
              {}};
  p.write = [member](void* object, const std::string& text) {
    static_cast<S*>(object)->*member = *Real::parse(text);
  };
  p.read = [member](const void* object) { return to_string(static_cast<const S*>(object)->*member); };
  return p;
}

/// Refused: a double is not the decimal that it was written as, which a run in quad shows.
template <class S, std::floating_point F, class... Rest>
Parameter parameter(F S::* /*member*/, const char* name, const Rest&... /*rest*/) {
  static_assert(!std::floating_point<F>,
                "parameter: expected a member of the type Real, such as Real nu = 0.3_r, and not a double, "
                "which is not the decimal that it is written as");
  return {.name = name, .unit = {}, .meaning = {}};
}

/// An integer parameter.
template <class S>
Parameter parameter(int S::*member, std::string name, std::string unit, int minimum, int maximum,
                    std::string meaning = {}) {
  Parameter p{std::move(name),
              std::move(unit),
              std::move(meaning),
              Parameter::Kind::integer,
              static_cast<double>(minimum),
              static_cast<double>(maximum),
              {},
              {},
              {},
              {}};
  p.write = [member](void* object, const std::string& text) {
    static_cast<S*>(object)->*member = std::stoi(text);
  };
  p.read = [member](const void* object) { return std::to_string(static_cast<const S*>(object)->*member); };
  return p;
}

/// A choice among names.
template <class S>
Parameter parameter(std::string S::*member, std::string name, std::vector<std::string> choices,
                    std::string meaning = {}) {
  Parameter p{
      std::move(name), {}, std::move(meaning), Parameter::Kind::choice, 0, 0, std::move(choices), {}, {}, {}};
  p.write = [member](void* object, const std::string& text) { static_cast<S*>(object)->*member = text; };
  p.read = [member](const void* object) { return static_cast<const S*>(object)->*member; };
  return p;
}

/// The path of a file, empty for none.
template <class S>
Parameter file_parameter(std::string S::*member, std::string name, std::string meaning = {}) {
  Parameter p{std::move(name), {}, std::move(meaning), Parameter::Kind::file, 0, 0, {}, {}, {}, {}};
  p.write = [member](void* object, const std::string& text) { static_cast<S*>(object)->*member = text; };
  p.read = [member](const void* object) { return static_cast<const S*>(object)->*member; };
  return p;
}

/// A text that the plug-in reads itself, of which `placeholder` says what it is, such as EXPRESSION.
template <class S>
Parameter text_parameter(std::string S::*member, std::string name, std::string placeholder,
                         std::string meaning = {}) {
  Parameter p = file_parameter(member, std::move(name), std::move(meaning));
  p.kind = Parameter::Kind::text;
  p.choices = {std::move(placeholder)};
  return p;
}

/// A yes/no setting.
template <class S>
Parameter parameter(bool S::*member, std::string name, std::string meaning = {}) {
  Parameter p{
      std::move(name), {}, std::move(meaning), Parameter::Kind::choice, 0, 0, {"yes", "no"}, {}, {}, {}};
  p.write = [member](void* object, const std::string& text) {
    static_cast<S*>(object)->*member = text == "yes";
  };
  p.read = [member](const void* object) {
    return std::string(static_cast<const S*>(object)->*member ? "yes" : "no");
  };
  return p;
}

/// A list of real numbers, each in the range, written with commas: "1,-0.5,1/3".
template <class S>
Parameter parameter(std::vector<Real> S::*member, std::string name, std::string unit, double minimum,
                    double maximum, std::string meaning = {}) {
  Parameter p{std::move(name),
              std::move(unit),
              std::move(meaning),
              Parameter::Kind::list,
              minimum,
              maximum,
              {},
              {},
              {},
              {}};
  p.write = [member](void* object, const std::string& text) {
    static_cast<S*>(object)->*member = *parse_list(text);
  };
  p.read = [member](const void* object) {
    std::string text;
    for (const Real& x : static_cast<const S*>(object)->*member)
      text += (text.empty() ? "" : ",") + to_string(x);
    return text;
  };
  return p;
}

/// Another plug-in, one of `plugins`.
template <class S>
Parameter parameter(PluginValue S::*member, std::string name, PluginChoice plugins,
                    std::string meaning = {}) {
  Parameter p{
      std::move(name), {}, std::move(meaning), Parameter::Kind::plugin, 0, 0, {}, std::move(plugins), {}, {}};
  p.write = [member](void* object, const std::string& text) {
    static_cast<S*>(object)->*member = parse_plugin_value(text, "value");
  };
  p.read = [member](const void* object) { return to_string(static_cast<const S*>(object)->*member); };
  return p;
}

/// Applies `assignments` to `object`; name.KEY = value is applied after name = value, whichever stands first.
/// Throws InputError for unknown names (with the nearest), bad values and defaults outside their own range.
void assign_all(const std::vector<Parameter>& parameters, void* object, const Assignments& assignments,
                const std::string& owner);

/// Every parameter with its present value.
Assignments resolved(const std::vector<Parameter>& parameters, const void* object);

namespace detail::plugin {
PFAFF_MEMBER_NAME(parameters)
}  // namespace detail::plugin

/// The parameters of plug-in struct S; empty where it declares none.
template <class S>
std::vector<Parameter> parameters_of() {
  static_assert(!std::is_final_v<S>,
                "a plug-in's struct must not be final: its members are looked up by derivation");
  static_assert(
      !detail::plugin::has_parameters<S> ||
          requires {
            { S::parameters() } -> std::same_as<std::vector<Parameter>>;
          },
      "parameters: expected static std::vector<Parameter> parameters()");
  if constexpr (requires { S::parameters(); }) {
    return S::parameters();
  } else {
    return {};
  }
}

}  // namespace pfaff

// Every plug-in holds such vectors: they are compiled once.
extern template class std::vector<pfaff::Parameter>;
