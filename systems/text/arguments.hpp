// The names that the formulas of a text model read: parameters, definitions, and the arguments of each kind
// of formula.
#pragma once

#include <pfaff/core/text/scope.hpp>
#include <pfaff/systems/text/declaration.hpp>

namespace pfaff::text {

/// What a formula is a function of, beside the time.
enum class Arguments {
  state,       // the coordinates
  positions,   // the first half of them
  momenta,     // the second half
  velocities,  // the first half, and velocities in place of the second
  motion,      // the coordinates, and velocities behind them
  chart,       // coordinates of a chart, y[1], y[2], ... or by their names
  pair,        // new_NAME and old_NAME for every coordinate, and the second time t0
  elapsed,     // the coordinates at the time t0; the time is `elapsed`
  flow,        // the coordinates; the time is `h`, for which they flow
  none         // neither time nor state
};
Arguments arguments_of(Formula formula);

/// The names of one model, its parameters fixed.
class TextNames {
 public:
  TextNames(const TextDeclaration& declaration, const std::vector<Real>& values);
  /// The coordinates one by one: those with a count are named name1, name2, ...
  [[nodiscard]] const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t dimension() const { return coordinates_.size(); }
  /// How many numbers a tape of these arguments reads.
  [[nodiscard]] std::size_t inputs(Arguments arguments) const;
  /// A scope with everything that a formula of these arguments may read. `what` is its name, for messages.
  [[nodiscard]] Scope scope(Arguments arguments, const std::string& what, const Recorded& time,
                            const std::vector<Recorded>& inputs) const;
  /// Evaluates every definition with all names that any formula knows, so that a mistake in one that no
  /// formula reads is found too.
  void check_definitions(const TextDeclaration& declaration) const;

 private:
  /// Coordinates that stand together: one of them, or several with a count.
  struct Block {
    std::string name;
    std::size_t first = 0, count = 1;
    bool several = false;
  };
  void define_state(Scope& scope, const std::vector<Recorded>& values, const std::string& prefix = {}) const;
  void define_half(Scope& scope, std::size_t first, const std::vector<Recorded>& values,
                   const std::string& what, const std::string& of) const;
  static void define_list(Scope& scope, const std::vector<std::string>& names, const std::string& otherwise,
                          const std::vector<Recorded>& values);

  Scope constants_;  // parameters and definitions
  std::vector<Block> blocks_;
  std::vector<Coordinate> coordinates_;
  std::vector<std::string> velocities_, chart_coordinates_;
};

}  // namespace pfaff::text
