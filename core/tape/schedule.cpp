#include <pfaff/core/tape/schedule.hpp>

#include <algorithm>
#include <array>

#include <pfaff/core/tape/operands.hpp>

namespace pfaff {

namespace {

constexpr std::size_t operation_count = static_cast<std::size_t>(Operation::solve_next) + 1;

bool written_by_another(Operation operation) {
  return operation == Operation::constant || operation == Operation::cosine ||
         operation == Operation::solve_next;
}

void append(Schedule& schedule, const Tape& tape, std::size_t slot) {
  const Instruction& i = tape.code[slot];
  if (schedule.runs.empty() || schedule.runs.back().operation != i.operation)
    schedule.runs.push_back({i.operation, schedule.instructions.size(), schedule.instructions.size()});
  schedule.instructions.push_back({static_cast<int>(slot), i.a, i.b, i.c});
  ++schedule.runs.back().end;
}

// Which instructions of code[begin, end) wait for which, by their distance from `begin`.
struct Waiting {
  std::vector<int> needs;                   // how many operands of an instruction are still to be written
  std::vector<std::size_t> first, readers;  // readers[first[k], first[k + 1]): the readers of k

  Waiting(const Tape& tape, std::size_t begin, std::size_t end) : needs(end - begin), first(end - begin + 1) {
    const auto each_operand = [&](const auto& visit) {
      for (std::size_t k = begin; k < end; ++k) {
        if (written_by_another(tape.code[k].operation)) continue;
        operands(tape.code[k], tape.solves, [&](int slot) {
          const std::size_t writer = group_start(tape.code, static_cast<std::size_t>(slot));
          if (writer >= begin) visit(writer - begin, k - begin);
        });
      }
    };
    each_operand([&](std::size_t writer, std::size_t reader) {
      ++first[writer + 1];
      ++needs[reader];
    });
    for (std::size_t k = 0; k + 1 < first.size(); ++k) first[k + 1] += first[k];
    readers.resize(first.back());
    std::vector<std::size_t> place(first.begin(), first.end() - 1);
    each_operand([&](std::size_t writer, std::size_t reader) { readers[place[writer]++] = reader; });
  }
};

// Takes, again and again, the operation of which most instructions have all they need, and all of its
// instructions that have, or come to have by others of the same run.
void by_operation(Schedule& schedule, const Tape& tape, std::size_t begin, std::size_t end) {
  Waiting waiting(tape, begin, end);
  std::array<std::vector<std::size_t>, operation_count> ready;
  const auto list_of = [&](std::size_t k) -> std::vector<std::size_t>& {
    return ready[static_cast<std::size_t>(tape.code[begin + k].operation)];
  };
  for (std::size_t k = 0; k < end - begin; ++k)
    if (waiting.needs[k] == 0 && !written_by_another(tape.code[begin + k].operation)) list_of(k).push_back(k);
  for (;;) {
    auto& run = *std::max_element(ready.begin(), ready.end(),
                                  [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (run.empty()) return;
    std::size_t taken = 0;
    while (taken < run.size()) {  // which grows
      const std::size_t k = run[taken++];
      append(schedule, tape, begin + k);
      for (std::size_t r = waiting.first[k]; r < waiting.first[k + 1]; ++r) {
        const std::size_t reader = waiting.readers[r];
        if (--waiting.needs[reader] == 0) list_of(reader).push_back(reader);
      }
    }
    run.clear();
  }
}

}  // namespace

Schedule::Schedule(const Tape& tape, std::size_t begin, std::size_t end, ScheduleOrder order) {
  instructions.reserve(end - begin);
  if (order == ScheduleOrder::by_operation) {
    by_operation(*this, tape, begin, end);
    return;
  }
  for (std::size_t k = begin; k < end; ++k)
    if (!written_by_another(tape.code[k].operation)) append(*this, tape, k);
}

}  // namespace pfaff
