// Schedule: the order in which the instructions of a tape are carried out.
//
// An interpreter that looks at every instruction's operation loses more time on the jump than on the
// arithmetic, most of all on long tapes, whose jumps no processor foresees. Instructions that do not need
// each other may be carried out in any order, with the same bits as results; so a schedule puts together
// those of one operation, and the interpreter jumps once for each of these runs. A gradient of two hundred
// instructions has ten.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

enum class ScheduleOrder {
  recorded,     // as the tape has them: for scalars that record, whose tapes depend on the order
  by_operation  // runs of one operation, as long as the instructions' needs permit
};

/// An instruction without its operation: `slot` is what it writes, a, b and c are as in Instruction.
struct ScheduledInstruction {
  int slot = 0, a = 0, b = 0, c = 0;
};

/// Consecutive instructions of one operation: instructions[begin, end).
struct OperationRun {
  Operation operation;
  std::size_t begin = 0, end = 0;
};

struct Schedule {
  std::vector<ScheduledInstruction> instructions;
  std::vector<OperationRun> runs;

  Schedule() = default;
  /// Of the slots begin, ..., end - 1 of a tape, which read each other and slots before them alone. Constants
  /// are left out, and so are the slots that another instruction writes (cosines, further components of a
  /// linear solve).
  Schedule(const Tape& tape, std::size_t begin, std::size_t end, ScheduleOrder order);
};

}  // namespace pfaff
