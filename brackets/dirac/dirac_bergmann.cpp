#include <pfaff/brackets/dirac/dirac_bergmann.hpp>

#include <algorithm>
#include <random>

#include <pfaff/brackets/dirac/recorded_constraints.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/numbers/with_rounding.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {

using namespace recorded_constraints;
using Indices = std::vector<std::size_t>;

// Error bounds of first order in the rounding are multiplied by this factor before a number counts as
// nonzero.
constexpr int trust = 16;

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

  // The outputs of a tape with bounds of their errors, on the assumption that the coordinates of the point
  // are accurate to a few units in the last place of the largest one.
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
  // For each row, the length of the error vector that independent_rows() compares what is left of the row
  // with. The errors of earlier rows are included, because multiples of those rows may be subtracted from
  // this one.
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

  // True where the gradient of the last of the constraints is independent of the gradients of the others.
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

  // Moves `point` to a nearby one on the constraints, by Newton steps normal to them. False where none is
  // found.
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

  // Adds a condition to the constraints where it is new, and moves the point onto it. A condition that
  // depends on the known ones and vanishes with them is left out, or noted without use where `keep_dependent`
  // is set. Returns false where the algorithm ends here; `taken_` says whether the condition was new.
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

  // Chooses pivots of the matrix {phi_a, phi_m}, rows of early generations first: row rows[k] determines the
  // multiplier of column columns[k].
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

  // The tape of the multipliers u of the columns chosen, followed by chi of every constraint, which is zero
  // by construction for the rows chosen.
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

  // Looks for one new constraint. False where there is none, and where the algorithm ends because there is no
  // motion.
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

  // Marks multipliers as not determined that change with an arbitrary one: the solution for u_C contains the
  // multipliers of the columns not chosen, which are free.
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
  std::shared_ptr<const Tape> known_;  // the constraints with independent gradients
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

template <class T>
ConstraintAlgorithm<T> dirac_bergmann(const ConstrainedHamiltonian& system, const T& t, In<T> z,
                                      int generations) {
  check(system, z.size());
  return Algorithm<T>(system, t, z).run(generations);
}

template ConstraintAlgorithm<double> dirac_bergmann(const ConstrainedHamiltonian&, const double&, In<double>,
                                                    int);
template ConstraintAlgorithm<Quad> dirac_bergmann(const ConstrainedHamiltonian&, const Quad&, In<Quad>, int);

}  // namespace pfaff
