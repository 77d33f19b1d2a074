#include <pfaff/core/facets/redundant_constraints.hpp>

#include <algorithm>

#include <pfaff/core/facets/followed_invariants.hpp>
#include <pfaff/core/facets/sparse_tape.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/numbers/random_numbers.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/sparse_gradients.hpp>

namespace pfaff {

namespace {
using Numbers = std::vector<Quad>;
using Indices = std::vector<std::size_t>;

Quad norm(const Numbers& x) {
  Quad square(0);
  for (const Quad& one : x) square += one * one;
  return sqrt(square);
}

// True where the matrix B B^T of the gradients is singular to the round-off of doubles. Its time is linear in
// the number of constraints where each has few neighbours.
bool may_be_dependent(const Tape& phi, const Numbers& q) {
  std::shared_ptr<const SymmetricPattern> pattern;
  const auto gram = record_list(
      phi.inputs, [&](const Recorded& t, const std::vector<Recorded>& x, std::vector<Recorded>& out) {
        SparseRecorded rows;
        for (const SparseGradient& row : sparse_gradients(phi, t, x, x.size())) {
          for (const auto& [column, entry] : row) rows.push_back(column, entry);
          rows.end_row();
        }
        pattern = record_gram(rows, rows, {}, out);
      });
  const std::vector<double> at = [&] {
    std::vector<double> list;
    for (const Quad& x : q) list.push_back(static_cast<double>(x));
    return list;
  }();
  std::vector<double> entries(gram->outputs.size());
  Replay<double>{gram}(0, at.data(), entries.data());
  StructuredLDLT<double> factors(pattern);
  std::copy_n(entries.begin(), phi.outputs.size(), factors.diagonal());
  std::copy(entries.begin() + static_cast<std::ptrdiff_t>(phi.outputs.size()), entries.end(),
            factors.couplings());
  return factors.factor_semidefinite() == Status::converged && factors.dropped() > 0;
}

// Constraints and their gradients at points of quad precision, at the time 0.
class Constraints {
 public:
  explicit Constraints(const std::shared_ptr<const Tape>& phi)
      : count(phi->outputs.size()),
        size(static_cast<std::size_t>(phi->inputs)),
        values_(phi),
        slopes_(std::make_shared<const Tape>(jacobian_tape(*phi))) {}

  [[nodiscard]] Numbers values(const Numbers& q) {
    Numbers out(count);
    values_(Quad(0), q.data(), out.data());
    return out;
  }
  [[nodiscard]] std::vector<Numbers> gradients(const Numbers& q) {
    Numbers entries(count * size);
    slopes_(Quad(0), q.data(), entries.data());
    std::vector<Numbers> rows;
    for (std::size_t i = 0; i < count; ++i)
      rows.emplace_back(entries.begin() + static_cast<std::ptrdiff_t>(i * size),
                        entries.begin() + static_cast<std::ptrdiff_t>((i + 1) * size));
    return rows;
  }

  const std::size_t count, size;

 private:
  Replay<Quad> values_, slopes_;
};

// The rows that depend on rows before them: Gram and Schmidt's orthogonalisation, twice.
Indices dependent_rows(std::vector<Numbers> rows) {
  // Far above the round-off of states that are given as doubles, far below what independent rows leave.
  constexpr double dependence = 1e-10;
  Indices dependent;
  std::vector<Numbers> units;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Numbers& row = rows[i];
    const Quad whole = norm(row);
    for (int pass = 0; pass < 2; ++pass)
      for (const Numbers& unit : units) {
        Quad along(0);
        for (std::size_t k = 0; k < row.size(); ++k) along += unit[k] * row[k];
        for (std::size_t k = 0; k < row.size(); ++k) row[k] -= along * unit[k];
      }
    const Quad left = norm(row);
    if (!(left > Quad(dependence) * whole)) {
      dependent.push_back(i);
      continue;
    }
    for (Quad& x : row) x = x / left;
    units.push_back(std::move(row));
  }
  return dependent;
}

// Moves q onto the surface of the constraints `kept` by Newton's iteration along their gradients. False where
// that does not converge.
bool bring_onto(Constraints& constraints, const Indices& kept, Numbers& q) {
  constexpr int most_iterations = 30;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Numbers values = constraints.values(q);
    const std::vector<Numbers> all = constraints.gradients(q);
    Matrix<Quad> rows(kept.size(), q.size());
    Numbers right;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      right.push_back(values[kept[i]]);
      for (std::size_t k = 0; k < q.size(); ++k) rows(i, k) = all[kept[i]][k];
    }
    const Matrix<Quad> gram = rows * rows.transposed();
    LU<Quad> lu(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t j = 0; j < kept.size(); ++j) lu(i, j) = gram(i, j);
    if (!lu.factor()) return false;
    Numbers multipliers(kept.size());
    lu.solve(right.data(), multipliers.data());
    const Numbers change = rows.transposed() * multipliers;
    for (std::size_t k = 0; k < q.size(); ++k) q[k] -= change[k];
    const Quad moved = norm(change);
    if (!isfinite(moved)) return false;
    // Newton's iteration squares what is left, until it is round-off and falls no more.
    if (iteration > 0 && moved <= Quad(1e-28) * norm(q)) return true;
  }
  return false;
}

// True where the constraints `left_out` are zero wherever the others are: at three points of their surface, a
// hundredth of the size of the state away from it in directions drawn at random.
bool follow_from(Constraints& constraints, const Indices& kept, const Indices& left_out, const Numbers& q) {
  constexpr double round_off = 1e-24;  // of Newton's iteration; second derivatives would leave 1e-4
  RandomNumbers random(34);
  const Quad scale = std::max(norm(q), Quad(1e-30));
  for (int trial = 0; trial < 3; ++trial) {
    Numbers direction(q.size());
    for (Quad& x : direction) x = random.next().quad();
    bool arrived = false;
    for (Quad length = scale / Quad(100); !arrived && length > scale / Quad(1e5);
         length = length / Quad(10)) {
      Numbers there = q;
      for (std::size_t k = 0; k < q.size(); ++k) there[k] += length * direction[k];
      if (!bring_onto(constraints, kept, there)) continue;
      arrived = true;
      const Numbers values = constraints.values(there);
      const std::vector<Numbers> slopes = constraints.gradients(there);
      for (const std::size_t i : left_out)
        if (!(abs(values[i]) <= Quad(round_off) * (norm(slopes[i]) * scale))) return false;
    }
    if (!arrived) return false;
  }
  return true;
}

// The tape of some results of another one.
std::shared_ptr<const Tape> results_of(const Tape& tape, const Indices& which) {
  return std::make_shared<const Tape>(record(tape.inputs, static_cast<int>(which.size()),
                                             [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                                               const std::vector<Recorded> all = evaluate(tape, t, x);
                                               for (std::size_t k = 0; k < which.size(); ++k)
                                                 out[k] = all[which[k]];
                                             }));
}
}  // namespace

void leave_out_redundant(ModelSource& source) {
  const std::shared_ptr<const Tape> phi = source.given[index(Formula::holonomic)];
  const bool compiled = source.holonomic != nullptr || source.programs[index(Formula::invariants)] != nullptr;
  if (phi == nullptr || compiled || source.initial.size() != static_cast<std::size_t>(source.dimension))
    return;
  constexpr std::size_t most_entries = 40000;  // of B in quad precision, a second or two
  const auto size = static_cast<std::size_t>(phi->inputs);
  Numbers q;
  for (std::size_t k = 0; k < size; ++k) q.push_back(source.initial[k].quad());
  if (!may_be_dependent(*phi, q) || phi->outputs.size() * size > most_entries) return;

  Constraints constraints(phi);
  const Indices dependent = dependent_rows(constraints.gradients(q));
  Indices kept;
  for (std::size_t i = 0; i < constraints.count; ++i)
    if (!std::binary_search(dependent.begin(), dependent.end(), i)) kept.push_back(i);
  if (dependent.empty() || kept.empty() || !follow_from(constraints, kept, dependent, q)) return;
  std::vector<FollowedQuantity> followed;
  for (const std::size_t k : dependent)
    followed.push_back({conserved(source.constraint_names[k], ""), phi, k});
  follow(source, followed);
  std::vector<std::string> names;
  for (const std::size_t k : kept) names.push_back(source.constraint_names[k]);
  for (const std::size_t k : dependent) source.redundant_constraints.push_back(source.constraint_names[k]);
  source.constraint_names = std::move(names);
  source.given[index(Formula::holonomic)] = results_of(*phi, kept);
}

}  // namespace pfaff
