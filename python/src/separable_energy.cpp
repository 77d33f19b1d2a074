#include <pfaff/python/src/separable_energy.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include <pfaff/core/tape/operands.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff::python {

namespace {
enum Reads : unsigned char { neither = 0, positions = 1, momenta = 2, both = 3 };

// What every slot of a tape reads.
std::vector<unsigned char> what_slots_read(const Tape& tape, int dimension) {
  std::vector<unsigned char> reads(tape.code.size(), neither);
  for (std::size_t k = 0; k < tape.code.size(); ++k) {
    const Instruction& i = tape.code[k];
    if (i.operation == Operation::input && i.a < dimension)
      reads[k] = i.a < dimension / 2 ? positions : momenta;
    operands(i, tape.solves, [&](int slot) {
      reads[k] = static_cast<unsigned char>(reads[k] | reads[static_cast<std::size_t>(slot)]);
    });
    if (const std::size_t start = group_start(tape.code, k); start != k) reads[k] = reads[start];
  }
  return reads;
}

// Two parts of a number, the one that reads momenta alone and the one that does not.
using Parts = std::pair<Recorded, Recorded>;

class Splitter {
 public:
  Splitter(const Tape& tape, const std::vector<Recorded>& values, int dimension)
      : tape_(tape), values_(values), reads_(what_slots_read(tape, dimension)) {}

  [[nodiscard]] std::optional<Parts> operator()(int slot) const {
    const auto k = static_cast<std::size_t>(slot);
    if (reads_[k] == momenta) return Parts(values_[k], 0);
    if (reads_[k] != both) return Parts(0, values_[k]);
    const Instruction& i = tape_.code[k];
    switch (i.operation) {
      case Operation::negate:
        return joined((*this)(i.a), (*this)(i.a), [](const Recorded& x, const Recorded&) { return -x; });
      case Operation::add:
        return joined((*this)(i.a), (*this)(i.b), [](const Recorded& x, const Recorded& y) { return x + y; });
      case Operation::subtract:
        return joined((*this)(i.a), (*this)(i.b), [](const Recorded& x, const Recorded& y) { return x - y; });
      case Operation::multiply:
        if (reads_[static_cast<std::size_t>(i.a)] == neither) return scaled(i.b, i.a, false);
        if (reads_[static_cast<std::size_t>(i.b)] == neither) return scaled(i.a, i.b, false);
        return std::nullopt;
      case Operation::divide:
        if (reads_[static_cast<std::size_t>(i.b)] == neither) return scaled(i.a, i.b, true);
        return std::nullopt;
      default:
        return std::nullopt;
    }
  }

 private:
  template <class Operation>
  static std::optional<Parts> joined(const std::optional<Parts>& a, const std::optional<Parts>& b,
                                     Operation operation) {
    if (!a || !b) return std::nullopt;
    return Parts(operation(a->first, b->first), operation(a->second, b->second));
  }
  [[nodiscard]] std::optional<Parts> scaled(int slot, int factor, bool divides) const {
    const auto parts = (*this)(slot);
    if (!parts) return std::nullopt;
    const Recorded& by = values_[static_cast<std::size_t>(factor)];
    return divides ? Parts(parts->first / by, parts->second / by)
                   : Parts(parts->first * by, parts->second * by);
  }

  const Tape& tape_;
  const std::vector<Recorded>& values_;
  std::vector<unsigned char> reads_;
};

// A tape without the half of the coordinates that it does not read, which begins at `unread`.
std::shared_ptr<const Tape> of_half(Tape tape, int dimension, int unread) {
  const int half = dimension / 2;
  tape.inputs -= half;
  for (Instruction& i : tape.code)
    if (i.operation == Operation::input && i.a >= unread + half) i.a -= half;
  return std::make_shared<const Tape>(std::move(tape));
}
}  // namespace

std::optional<SeparableEnergy> separable_energy(const Tape& hamiltonian, int dimension) {
  if (dimension % 2 != 0) return std::nullopt;
  Recorder recorder(hamiltonian.inputs);
  const std::vector<Recorded> z = recorder.inputs();
  Replay<Recorded> replay(std::make_shared<const Tape>(hamiltonian));
  std::vector<Recorded> whole(hamiltonian.outputs.size());
  replay(recorder.time(), z.data(), whole.data());
  const auto parts = Splitter(hamiltonian, replay.slots(), dimension)(hamiltonian.outputs.front());
  if (!parts) return std::nullopt;
  // Each tape takes of the recording what its output needs.
  const auto alone = [&](const Recorded& part, int unread) {
    return of_half(recorder.finish(std::vector<Recorded>{part}), dimension, unread);
  };
  return SeparableEnergy{alone(parts->first, 0), alone(parts->second, dimension / 2)};
}

}  // namespace pfaff::python
