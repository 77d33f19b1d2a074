#include <pfaff/derive/derivation/explicit_solves.hpp>

#include <algorithm>
#include <array>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/derive/derivation/witness.hpp>

namespace pfaff {

namespace {

/// A recorded number with its value at the generic point.
class Witnessed {
 public:
  Witnessed() = default;
  Witnessed(int value) : node_(value), value_(value) {}  // NOLINT(google-explicit-constructor)
  explicit Witnessed(const Real& value) : node_(value), value_(value.quad()) {}
  Witnessed(const Recorded& node, Quad value) : node_(node), value_(value) {}

  [[nodiscard]] const Recorded& node() const { return node_; }
  [[nodiscard]] Quad value() const { return value_; }

  friend Witnessed operator-(const Witnessed& a) { return {-a.node_, -a.value_}; }
  friend Witnessed operator+(const Witnessed& a, const Witnessed& b) {
    return {a.node_ + b.node_, a.value_ + b.value_};
  }
  friend Witnessed operator-(const Witnessed& a, const Witnessed& b) {
    return {a.node_ - b.node_, a.value_ - b.value_};
  }
  friend Witnessed operator*(const Witnessed& a, const Witnessed& b) {
    return {a.node_ * b.node_, a.value_ * b.value_};
  }
  friend Witnessed operator/(const Witnessed& a, const Witnessed& b) {
    return {a.node_ / b.node_, a.value_ / b.value_};
  }
  friend Witnessed sqrt(const Witnessed& a) { return {sqrt(a.node_), sqrt(a.value_)}; }
  friend Witnessed exp(const Witnessed& a) { return {exp(a.node_), exp(a.value_)}; }
  friend Witnessed log(const Witnessed& a) { return {log(a.node_), log(a.value_)}; }
  friend Witnessed sin(const Witnessed& a) { return {sin(a.node_), sin(a.value_)}; }
  friend Witnessed cos(const Witnessed& a) { return {cos(a.node_), cos(a.value_)}; }
  friend Witnessed pow(const Witnessed& a, const Real& y) { return {pow(a.node_, y), pow(a.value_, y)}; }
  friend Witnessed special(SpecialFunction which, const Witnessed& a, const Witnessed& slope) {
    return {special(which, a.node_, slope.node_), special(which, a.value_, slope.value_)};
  }
  friend Witnessed select(const Witnessed& c, const Witnessed& a, const Witnessed& b) {
    return {select(c.node_, a.node_, b.node_), select(c.value_, a.value_, b.value_)};
  }
  friend bool structurally_zero(const Witnessed& x) { return structurally_zero(x.node_); }

 private:
  Recorded node_;
  Quad value_{0};
};

/// Entries below this, relative to the largest that is left, are taken for round-off of zero at the point.
constexpr double negligible = 1e-20;

struct SingularSystem {};

}  // namespace

template <>
class TapeSolver<Witnessed> {
 public:
  explicit TapeSolver(int size) : size_(static_cast<std::size_t>(size)) {}

  /// Gauss's elimination with the pivot that has the fewest entries beside it in its row and column.
  void operator()(const LinearSystem& system, std::vector<Witnessed>& slots, std::size_t first) const {
    const std::size_t n = size_;
    std::vector<Witnessed> a, b;
    for (const int slot : system.matrix) a.push_back(slots[static_cast<std::size_t>(slot)]);
    for (const int slot : system.right_hand_side) b.push_back(slots[static_cast<std::size_t>(slot)]);
    std::vector<char> row_used(n, 0), column_used(n, 0);
    std::vector<std::array<std::size_t, 2>> pivots;
    for (std::size_t step = 0; step < n; ++step) {
      const auto [r, c] = pivot(a, row_used, column_used);
      row_used[r] = column_used[c] = 1;
      pivots.push_back({r, c});
      for (std::size_t i = 0; i < n; ++i) {
        if (row_used[i] != 0 || structurally_zero(a[i * n + c])) continue;
        const Witnessed factor = a[i * n + c] / a[r * n + c];
        for (std::size_t j = 0; j < n; ++j)
          if (column_used[j] == 0) a[i * n + j] = a[i * n + j] - factor * a[r * n + j];
        b[i] = b[i] - factor * b[r];
      }
    }
    std::vector<char> known(n, 0);
    for (std::size_t step = n; step-- > 0;) {
      const auto [r, c] = pivots[step];
      Witnessed sum = b[r];
      for (std::size_t j = 0; j < n; ++j)
        if (known[j] != 0) sum = sum - a[r * n + j] * slots[first + j];
      slots[first + c] = sum / a[r * n + c];
      known[c] = 1;
    }
  }

 private:
  [[nodiscard]] std::array<std::size_t, 2> pivot(const std::vector<Witnessed>& a,
                                                 const std::vector<char>& row_used,
                                                 const std::vector<char>& column_used) const {
    const std::size_t n = size_;
    std::vector<std::size_t> in_row(n, 0), in_column(n, 0);
    Quad largest(0);
    const auto each = [&](const auto& visit) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (row_used[i] == 0 && column_used[j] == 0 && !structurally_zero(a[i * n + j])) visit(i, j);
    };
    each([&](std::size_t i, std::size_t j) {
      ++in_row[i];
      ++in_column[j];
      largest = std::max(largest, abs(a[i * n + j].value()));
    });
    std::array<std::size_t, 2> best{n, n};
    std::size_t fewest = n * n + 1;
    each([&](std::size_t i, std::size_t j) {
      if (!(abs(a[i * n + j].value()) > Quad(negligible) * largest)) return;
      const std::size_t cost = (in_row[i] - 1) * (in_column[j] - 1);
      if (cost >= fewest) return;
      fewest = cost;
      best = {i, j};
    });
    if (best[0] == n) throw SingularSystem();
    return best;
  }
  std::size_t size_;
};

Tape explicit_solves(const Tape& tape, const std::string& what) {
  if (tape.solves.empty()) return tape;
  Recorder recorder(tape.inputs);
  const std::vector<Real> point = generic_numbers(static_cast<std::size_t>(tape.inputs) + 1);
  std::vector<Witnessed> z, results(tape.outputs.size());
  for (const Recorded& x : recorder.inputs()) z.emplace_back(x, point[z.size()].quad());
  Replay<Witnessed> replay({std::shared_ptr<const Tape>(), &tape});
  try {
    replay(Witnessed(recorder.time(), point.back().quad()), z.data(), results.data());
  } catch (const SingularSystem&) {
    throw InputError(what + ": its linear system is singular whatever the state");
  }
  std::vector<Recorded> outputs;
  for (const Witnessed& x : results) outputs.push_back(x.node());
  return recorder.finish(outputs);
}

}  // namespace pfaff
