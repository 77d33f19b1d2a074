// One-step maps written as text: a list of assignments, one after another, each of which reads what those
// before it have made.
//
//   z = z + h*field(t + h/2, z + h/2*field(t, z))                      of any system with a vector field
//   p = p + h/2*force(t, q);  q = q + h*velocity(t + h/2, p);  ...     of one with T(p, t) + V(q, t)
//   p = (p - h*sin(r))/(1 + h*nu);  r = r + h*p                        of one system, by its coordinates
//
// A name stands for one number, for the numbers of half of the state or of all of it. What is written holds
// for each component: an expression is recorded once and replayed component by component. Calls of the
// system's formulas become operations of their own, so that a program is a list of operations on registers.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/tape/tape.hpp>
#include <pfaff/core/text/vocabulary.hpp>

namespace pfaff {

/// How many numbers a register holds.
enum class MapExtent { one, half, whole };

/// Where the value of a name, or of a part of an expression, is kept while a step is made.
struct MapRegister {
  std::string name;  // empty for parts of expressions
  MapExtent extent = MapExtent::one;
};

struct MapOperation {
  enum class Kind {
    assign,   // target = tape(reads), component by component
    add,      // target = target + tape(reads), a part of the state, with compensated summation
    field,    // target = X(reads[1], time reads[0])
    force,    // target = -V_q
    velocity  // target = T_p
  };
  Kind kind = Kind::assign;
  std::size_t target = 0;
  std::vector<std::size_t> reads{};
  std::shared_ptr<const Tape> tape{};
};

/// What a map's state is called in its expressions.
enum class MapState {
  whole,       // z
  canonical,   // q and p
  coordinates  // every coordinate has its name
};

/// A map as operations on registers. The first registers are t and h, then come the constants, then the
/// state, then everything else.
struct MapProgram {
  MapState state = MapState::whole;
  std::vector<MapRegister> registers;
  std::size_t constants = 0, first_of_state = 0, state_registers = 0;
  std::vector<MapOperation> operations;

  [[nodiscard]] bool is_state(std::size_t number) const {
    return number >= first_of_state && number < first_of_state + state_registers;
  }
};

/// Which names the texts of assignments use for the state: q, p, force and velocity where one of these is
/// among them.
MapState state_of_assignments(const text::Item& list);

/// Translates assignments, a list of texts. `constants` are the names of numbers, `coordinates` those of the
/// state where it is called by them. `names` knows all of these already. TextError with the place for what
/// cannot be translated.
MapProgram translate_map(const text::Item& list, MapState state, const std::vector<std::string>& constants,
                         const std::vector<std::string>& coordinates, text::TakenNames& names);

}  // namespace pfaff
