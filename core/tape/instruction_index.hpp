// Finds an instruction among those that a recorder has collected, so that equal ones are recorded once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// The positions of instructions in a list of code, found by the instructions themselves. The list is the
/// recorder's own and is handed to every call: the index keeps positions alone.
///
/// Every instruction is looked up, and in one large table each look-up waits for memory, which took half of
/// the time of deriving the equations of a long chain. What is recorded reads what was recorded shortly
/// before. There is therefore a table for every few hundred slots, with the instructions whose last operand
/// is among them, and the tables that are in use are few and stay near.
class InstructionIndex {
 public:
  /// Not found.
  static constexpr int none = -1;

  /// The position of an instruction in `code`, or none.
  [[nodiscard]] int find(const Instruction& instruction, const std::vector<Instruction>& code) const {
    const std::size_t region = region_of(instruction);
    return region < tables_.size() ? tables_[region].find(instruction, code) : none;
  }

  /// Adds an instruction that was not found, which stands in `code` at `position`.
  void add(int position, const std::vector<Instruction>& code) {
    const std::size_t region = region_of(code[static_cast<std::size_t>(position)]);
    if (region >= tables_.size()) tables_.resize(region + 1);
    tables_[region].add(position, code);
  }

 private:
  static constexpr unsigned region_bits = 8;  // a table has the slots that agree in all bits above these

  /// Open addressing, one array without pointers.
  class Table {
   public:
    [[nodiscard]] int find(const Instruction& instruction, const std::vector<Instruction>& code) const {
      return positions_.empty() ? none : positions_[place_of(instruction, code)];
    }
    void add(int position, const std::vector<Instruction>& code) {
      // At most half of the places are taken, so that a search ends after two places or three.
      if (2 * (count_ + 1) > positions_.size()) grow(code);
      positions_[place_of(code[static_cast<std::size_t>(position)], code)] = position;
      ++count_;
    }

   private:
    // Where the position of the instruction stands, or the free place where it belongs.
    [[nodiscard]] std::size_t place_of(const Instruction& instruction,
                                       const std::vector<Instruction>& code) const {
      const std::size_t last = positions_.size() - 1;
      std::size_t place = static_cast<std::size_t>(hash(instruction) >> 32U) & last;
      while (positions_[place] != none && !(code[static_cast<std::size_t>(positions_[place])] == instruction))
        place = (place + 1) & last;
      return place;
    }
    void grow(const std::vector<Instruction>& code) {
      std::vector<int> before;
      before.swap(positions_);
      positions_.assign(before.empty() ? 16 : 4 * before.size(), none);
      for (const int position : before)
        if (position != none) positions_[place_of(code[static_cast<std::size_t>(position)], code)] = position;
    }

    std::vector<int> positions_;  // a power of two of them; `none` where a place is free
    std::size_t count_ = 0;
  };

  static std::size_t region_of(const Instruction& i) {
    return static_cast<std::size_t>(std::max({i.a, i.b, i.c, 0})) >> region_bits;
  }
  static std::uint64_t hash(const Instruction& i) {
    const auto word = [](int high, int low) {
      return std::uint64_t{static_cast<std::uint32_t>(high)} << 32U | static_cast<std::uint32_t>(low);
    };
    // Two multiplications by odd numbers mix what stands low into the high half, which is used.
    const std::uint64_t first = word(i.a, i.b) * 0x9E3779B97F4A7C15U;
    return ((first ^ first >> 32U) + word(static_cast<int>(i.operation), i.c)) * 0xD1B54A32D192ED03U;
  }

  std::vector<Table> tables_;
};

}  // namespace pfaff
