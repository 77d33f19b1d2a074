#include <pfaff/brackets/dirac/dirac_bergmann.hpp>

#include <algorithm>
#include <random>

#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/registry/errors.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {

using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;
using Indices = std::vector<std::size_t>;

// First-order error bounds are trusted up to this factor.
constexpr int trust = 16;

Recorded product(std::span<const Recorded> a, std::span<const Recorded> b) {
  Recorded sum(0);
  for (std::size_t k = 0; k < a.size(); ++k) sum = sum + a[k] * b[k];
  return sum;
}

/// The tape of several tapes' outputs, one after the other.
std::shared_ptr<const Tape> joined(const Tape& first, const Tape& second) {
  const auto count = static_cast<int>(first.outputs.size() + second.outputs.size());
  return std::make_shared<const Tape>(
      record(first.inputs, count, [&](const Recorded& t, Arguments z, Results out) {
        const auto a = evaluate(first, t, z), b = evaluate(second, t, z);
        std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), out.begin()));
      }));
}

/// Rates d_t phi + {phi, H} and brackets {phi_a, phi_m} with the primary constraints, as recorded
/// expressions.
struct Brackets {
  std::vector<Recorded> rates;    // K
  std::vector<Recorded> primary;  // K x primary
  std::vector<Recorded> all;      // K x K where asked for

  Brackets(const ConstrainedHamiltonian& system, const Tape& constraints, const Recorded& t, Arguments z,
           bool mutual) {
    const std::size_t n = z.size(), count = constraints.outputs.size();
    const std::size_t columns = mutual ? count : system.primary->outputs.size();
    const auto gradients = jacobian(constraints, t, z);
    const auto row = [&](std::size_t k) { return Arguments(gradients).subspan(k * n, n); };
    const auto sharp = [&](Arguments covector) {
      std::vector<Recorded> x(z.begin(), z.end());
      x.insert(x.end(), covector.begin(), covector.end());
      return evaluate(*system.sharp, t, x);
    };
    rates = time_derivative(constraints, t, z);
    const auto velocity = sharp(gradient(*system.hamiltonian, t, z, std::vector<Recorded>{Recorded(1)}));
    for (std::size_t a = 0; a < count; ++a) rates[a] = rates[a] + product(row(a), velocity);
    std::vector<Recorded>& brackets = mutual ? all : primary;
    brackets.resize(count * columns);
    for (std::size_t m = 0; m < columns; ++m) {
      const auto image = sharp(row(m));
      for (std::size_t a = 0; a < count; ++a) brackets[a * columns + m] = product(row(a), image);
    }
  }
};

template <class T>
class Algorithm {
 public:
  using Number = WithRounding<T>;

  Algorithm(const ConstrainedHamiltonian& system, const T& t, In<T> z) : system_(system), t_(t) {
    result_.point.assign(z.begin(), z.end());
  }

  ConstraintAlgorithm<T> run(int generations) {
    for (std::size_t m = 0; m < primary(); ++m) {
      const Tape one = only(*system_.primary, m);
      if (!admit(one, {system_.names[m], 1}, true)) return std::move(result_);
    }
    while (find_one(generations)) {
    }
    if (result_.closure == ConstraintClosure::closed) finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t primary() const { return system_.primary->outputs.size(); }

  static Tape only(const Tape& tape, std::size_t k) {
    return record(tape.inputs, 1,
                  [&](const Recorded& t, Arguments z, Results out) { out[0] = evaluate(tape, t, z)[k]; });
  }

  // The outputs of a tape with the errors that inputs good to a few units in the last place make of them.
  std::vector<Number> at(const std::vector<T>& point, const Tape& tape) const {
    T largest(0);
    for (const T& x : point) largest = std::max(largest, T(abs(x)));
    std::vector<Number> x, out(tape.outputs.size());
    for (const T& value : point) x.emplace_back(value, T(4) * largest);
    Replay<Number> replay(std::make_shared<const Tape>(tape));
    replay(Number(t_), x.data(), out.data());
    return out;
  }
  static bool nonzero(const Number& x) { return Number(x.value, T(trust) * x.error).significant(); }

  static Matrix<T> value_rows(const std::vector<Number>& x, std::size_t rows) {
    Matrix<T> m(rows, x.size() / std::max<std::size_t>(rows, 1));
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = x[i * m.columns() + j].value;
    return m;
  }
  // What independent_rows() compares with: lengths of the errors of each row, those of the other rows that
  // may be subtracted from it included.
  static std::vector<T> error_lengths(const std::vector<Number>& x, std::size_t rows) {
    const std::size_t n = x.size() / rows;
    std::vector<T> lengths(rows);
    T worst(0);
    for (std::size_t i = 0; i < rows; ++i) {
      T error(0), length(0);
      for (std::size_t j = 0; j < n; ++j) {
        error = error + x[i * n + j].error;
        length = length + abs(x[i * n + j].value);
      }
      if (length > T(0) && i + 1 < rows) worst = std::max(worst, T(error / length));
      lengths[i] = error + worst * length;
    }
    return lengths;
  }

  // Is the gradient of the last of the constraints independent of the others?
  bool independent(const Tape& constraints) const {
    const std::size_t count = constraints.outputs.size();
    const auto gradients = at(result_.point, jacobian_tape(constraints));
    for (const Number& x : gradients)
      if (!isfinite(x.value)) throw InputError("constraints: a gradient is not finite at the point");
    const auto rows =
        independent_rows(value_rows(gradients, count), trust * static_cast<double>(unit_roundoff<T>()),
                         error_lengths(gradients, count));
    return std::find(rows.dependent.begin(), rows.dependent.end(), count - 1) == rows.dependent.end();
  }

  // The point of the constraints next to `point`, by Newton steps normal to them. False where there is none.
  bool project(const Tape& constraints, std::vector<T>& point) const {
    const std::size_t count = constraints.outputs.size(), n = point.size();
    const Tape slopes = jacobian_tape(constraints);
    for (int step = 0; step < 60; ++step) {
      const auto values = at(point, constraints);
      if (std::none_of(values.begin(), values.end(), [](const Number& x) { return nonzero(x); })) return true;
      const Matrix<T> b = value_rows(at(point, slopes), count);
      LU<T> lu(count);
      const Matrix<T> gram = b * b.transposed();
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) lu(i, j) = gram(i, j);
      if (!lu.factor()) return false;
      std::vector<T> right(count), share(count);
      for (std::size_t i = 0; i < count; ++i) right[i] = values[i].value;
      lu.solve(right.data(), share.data());
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < count; ++i) point[j] = point[j] - b(i, j) * share[i];
      for (const T& x : point)
        if (!isfinite(x)) return false;
    }
    return false;
  }

  bool stop(ConstraintClosure closure, const std::string& trouble) {
    result_.closure = closure;
    result_.trouble = trouble;
    return false;
  }

  // Takes a condition in where it is new. False where the algorithm ends; `taken_` says whether it was new.
  bool admit(const Tape& condition, const FoundConstraint& what, bool keep_dependent) {
    taken_ = false;
    const auto with = known_ ? joined(*known_, condition) : std::make_shared<const Tape>(condition);
    const Number value = at(result_.point, condition)[0];
    if (!isfinite(value.value)) throw InputError("constraints: " + what.name + " is not finite at the point");
    if (independent(*with)) {
      taken_ = true;
      known_ = with;
      note(what, condition);
      if (!project(*known_, result_.point))
        return stop(ConstraintClosure::unreachable,
                    "no point found where " + what.name + " = 0 and the " + "constraints before it hold");
      return true;
    }
    if (nonzero(value))
      return stop(ConstraintClosure::inconsistent,
                  what.name + " = " + to_string(Quad(value.value), 4) +
                      " on the constraints before it, and its gradient is a combination of theirs");
    if (!vanishes_nearby(condition))
      return stop(ConstraintClosure::irregular,
                  what.name +
                      " vanishes at the point and not on the constraints nearby, and its gradient is a " +
                      "combination of theirs");
    if (keep_dependent) note(what, condition);
    return true;
  }
  void note(const FoundConstraint& what, const Tape& condition) {
    result_.constraints.push_back(what);
    result_.values =
        result_.values ? joined(*result_.values, condition) : std::make_shared<const Tape>(condition);
  }

  [[nodiscard]] bool vanishes_nearby(const Tape& condition) const {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> draw(-64, 64);
    for (int probe = 0; probe < 4; ++probe) {
      std::vector<T> point = result_.point;
      for (T& x : point) x = x + T(draw(random)) / T(8192) * (T(1) + T(abs(x)));
      if (known_ && !project(*known_, point)) continue;
      if (nonzero(at(point, condition)[0])) return false;
    }
    return true;
  }

  // Pivots of {phi_a, phi_m}, rows of early generations first.
  void choose(std::vector<Number> m, Indices& rows, Indices& columns) const {
    const std::size_t width = primary(), count = result_.constraints.size();
    rows.clear();
    columns.clear();
    int last = 1;
    for (const FoundConstraint& c : result_.constraints) last = std::max(last, c.generation);
    const auto taken = [](const Indices& list, std::size_t k) {
      return std::find(list.begin(), list.end(), k) != list.end();
    };
    for (int generation = 1; generation <= last; ++generation)
      for (;;) {
        std::size_t row = count, column = 0;
        for (std::size_t a = 0; a < count; ++a) {
          if (result_.constraints[a].generation != generation || taken(rows, a)) continue;
          for (std::size_t b = 0; b < width; ++b)
            if (!taken(columns, b) && nonzero(m[a * width + b]) &&
                (row == count || abs(m[a * width + b].value) > abs(m[row * width + column].value))) {
              row = a;
              column = b;
            }
        }
        if (row == count) break;
        rows.push_back(row);
        columns.push_back(column);
        for (std::size_t a = 0; a < count; ++a) {
          if (taken(rows, a)) continue;
          const Number factor = m[a * width + column] / m[row * width + column];
          for (std::size_t b = 0; b < width; ++b)
            if (!taken(columns, b)) m[a * width + b] = m[a * width + b] - factor * m[row * width + b];
        }
      }
  }

  // u of the columns chosen, and chi of every constraint: zero by construction for the rows chosen.
  Tape conditions(const Indices& rows, const Indices& columns) const {
    const Tape& constraints = *result_.values;
    const std::size_t width = primary(), count = constraints.outputs.size(), rank = rows.size();
    return record(constraints.inputs, static_cast<int>(rank + count),
                  [&](const Recorded& t, Arguments z, Results out) {
                    const Brackets b(system_, constraints, t, z, false);
                    std::vector<Recorded> matrix, right;
                    for (const std::size_t a : rows) {
                      for (const std::size_t m : columns) matrix.push_back(b.primary[a * width + m]);
                      right.push_back(-b.rates[a]);
                    }
                    const auto u = rank > 0 ? solve(matrix, right) : std::vector<Recorded>{};
                    for (std::size_t k = 0; k < rank; ++k) out[k] = u[k];
                    for (std::size_t a = 0; a < count; ++a) {
                      Recorded chi = b.rates[a];
                      for (std::size_t k = 0; k < rank; ++k)
                        chi = chi + b.primary[a * width + columns[k]] * u[k];
                      out[rank + a] = chi;
                    }
                  });
  }

  std::vector<Number> brackets(bool mutual) const {
    const Tape& constraints = *result_.values;
    const auto count = static_cast<int>(constraints.outputs.size());
    const int columns = mutual ? count : static_cast<int>(primary());
    return at(result_.point,
              record(constraints.inputs, count * columns, [&](const Recorded& t, Arguments z, Results out) {
                const Brackets b(system_, constraints, t, z, mutual);
                const auto& entries = mutual ? b.all : b.primary;
                std::copy(entries.begin(), entries.end(), out.begin());
              }));
  }

  // Looks for one new constraint; false where there is none, or no motion.
  bool find_one(int generations) {
    Indices rows, columns;
    choose(brackets(false), rows, columns);
    const Tape all = conditions(rows, columns);
    for (std::size_t a = 0; a < result_.constraints.size(); ++a) {
      if (std::find(rows.begin(), rows.end(), a) != rows.end()) continue;
      const FoundConstraint what{result_.constraints[a].name + "'", result_.constraints[a].generation + 1};
      if (!admit(only(all, rows.size() + a), what, false)) return false;
      if (!taken_) continue;
      if (what.generation > generations)
        throw RunError("constraints: not closed after " + std::to_string(generations) + " generations; " +
                       what.name + " is new");
      return true;
    }
    return false;
  }

  void finish() {
    Indices rows, columns;
    const auto m = brackets(false);
    choose(m, rows, columns);
    const auto u = at(result_.point, conditions(rows, columns));
    result_.multipliers.resize(primary());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      Multiplier<T>& multiplier = result_.multipliers[columns[k]];
      multiplier.value = u[k].value;
      multiplier.determined = true;
    }
    untie(m, rows, columns);
    const std::size_t count = result_.constraints.size();
    const auto w = brackets(true);
    Matrix<T> values(count, count), sizes(count, count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        values(i, j) = w[i * count + j].value;
        sizes(i, j) = w[i * count + j].error;
      }
    const auto gradients = at(result_.point, jacobian_tape(*result_.values));
    result_.classes = classify(values, Symmetry::skew, value_rows(gradients, count), sizes);
  }

  // A multiplier is determined only where no arbitrary one changes it.
  void untie(const std::vector<Number>& m, const Indices& rows, const Indices& columns) {
    const std::size_t width = primary(), rank = rows.size();
    if (rank == 0) return;
    LU<Number> lu(rank);
    for (std::size_t i = 0; i < rank; ++i)
      for (std::size_t j = 0; j < rank; ++j) lu(i, j) = m[rows[i] * width + columns[j]];
    if (!lu.factor()) return;
    std::vector<Number> right(rank), share(rank);
    for (std::size_t f = 0; f < width; ++f) {
      if (std::find(columns.begin(), columns.end(), f) != columns.end()) continue;
      for (std::size_t i = 0; i < rank; ++i) right[i] = m[rows[i] * width + f];
      lu.solve(right.data(), share.data());
      for (std::size_t k = 0; k < rank; ++k)
        if (nonzero(share[k])) result_.multipliers[columns[k]] = {};
    }
  }

  const ConstrainedHamiltonian& system_;
  T t_;
  ConstraintAlgorithm<T> result_;
  std::shared_ptr<const Tape> known_;  // independent constraints
  bool taken_ = false;
};

void check(const ConstrainedHamiltonian& system, std::size_t dimension) {
  const auto n = static_cast<int>(dimension);
  const auto shape = [](const std::string& what, const Tape& tape, int inputs, std::size_t outputs) {
    if (tape.inputs != inputs || tape.outputs.size() != outputs)
      throw InputError("constraints: " + what + " maps " + std::to_string(tape.inputs) + " numbers to " +
                       std::to_string(tape.outputs.size()) + "; expected " + std::to_string(inputs) + " to " +
                       std::to_string(outputs));
  };
  shape("the Hamiltonian", *system.hamiltonian, n, 1);
  shape("the bracket", *system.sharp, 2 * n, dimension);
  shape("the primary constraints", *system.primary, n, system.names.size());
}

}  // namespace

std::string_view to_string(ConstraintClosure closure) {
  switch (closure) {
    case ConstraintClosure::closed:
      return "closed";
    case ConstraintClosure::inconsistent:
      return "inconsistent";
    case ConstraintClosure::irregular:
      return "irregular";
    case ConstraintClosure::unreachable:
      return "unreachable";
  }
  return "unknown";
}

template <class T>
ConstraintAlgorithm<T> dirac_bergmann(const ConstrainedHamiltonian& system, const T& t, In<T> z,
                                      int generations) {
  check(system, z.size());
  return Algorithm<T>(system, t, z).run(generations);
}

template <class T>
std::string describe(const ConstraintAlgorithm<T>& result) {
  std::string text;
  std::vector<std::string> names;
  int last = 0;
  for (const FoundConstraint& c : result.constraints) {
    names.push_back(c.name);
    last = std::max(last, c.generation);
  }
  for (int generation = 1; generation <= last; ++generation) {
    text += "generation " + std::to_string(generation) + ":";
    for (const FoundConstraint& c : result.constraints)
      if (c.generation == generation) text += " " + c.name;
    text += "\n";
  }
  if (result.closure != ConstraintClosure::closed)
    return text + std::string(to_string(result.closure)) + ": " + result.trouble;
  text += "closed after " + std::to_string(last) + (last == 1 ? " generation\n" : " generations\n");
  for (std::size_t m = 0; m < result.multipliers.size(); ++m)
    text += "multiplier of " + names[m] +
            (result.multipliers[m].determined ? " = " + to_string(Quad(result.multipliers[m].value), 6) + "\n"
                                              : std::string(" is not determined\n"));
  return text + describe(result.classes, names);
}

#define PFAFF_INSTANTIATE(T)                                                                           \
  template ConstraintAlgorithm<T> dirac_bergmann(const ConstrainedHamiltonian&, const T&, In<T>, int); \
  template std::string describe(const ConstraintAlgorithm<T>&);
PFAFF_INSTANTIATE(double)
PFAFF_INSTANTIATE(Quad)
#undef PFAFF_INSTANTIATE

}  // namespace pfaff
