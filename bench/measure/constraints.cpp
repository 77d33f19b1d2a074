#include <pfaff/bench/measure/constraints.hpp>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

std::vector<std::string> constraint_residual_names(const Model& model) {
  if (!model.restricted()) return {};
  if (model.holonomic()) return {"constraint", "hidden-constraint"};
  return {"constraint"};
}

namespace {
constexpr int most_iterations = 50;

Quad norm(std::span<const Quad> x) {
  Quad sum(0);
  for (const Quad& value : x) sum += value * value;
  return sqrt(sum);
}
// |after - before| / |before|, or |after - before| alone where `before` is zero.
double relative_change(std::span<const Quad> before, std::span<const Quad> after) {
  std::vector<Quad> difference;
  for (std::size_t k = 0; k < before.size(); ++k) difference.push_back(after[k] - before[k]);
  const Quad size = norm(before), change = norm(difference);
  return static_cast<double>(size > Quad(0) ? Quad(change / size) : change);
}
void note_worst(std::span<const Quad> values, std::size_t stride, std::size_t first,
                const std::vector<std::string>& names, ProjectionOntoConstraints& result) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const auto size = static_cast<double>(abs(values[k])); size > result.worst_residual) {
      result.worst_residual = size;
      result.worst = names[k * stride + first];
    }
}

// A correction of the state, relative to it; none where it failed.
struct Correction {
  Status status;
  Quad size{0};
};

// x -= move; the size of that relative to x, not-a-number where it is not finite: the residual then says so.
Quad move_by(std::span<const Quad> move, std::span<Quad> x) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] -= move[k];
  const Quad change = norm(move);
  return change == Quad(0) ? change : Quad(change / norm(x));
}

// Newton's method until the residual no longer falls or the state no longer moves. The second criterion is
// needed because components that are zero but for round-off may come closer to zero for ever. `measure` fills
// the residual, `correct` moves the state.
template <class Measure, class Correct>
Status iterate(std::vector<Quad>& residual, const Measure& measure, const Correct& correct) {
  Quad last = std::numeric_limits<Quad>::infinity();
  for (int k = 0;; ++k) {
    measure();
    const Quad size = norm(residual);
    if (!isfinite(size)) return Status::non_finite;
    if (size == Quad(0) || (k > 3 && !(size < last / Quad(2)))) return Status::converged;
    if (k == most_iterations) return Status::not_converged;
    last = size;
    const Correction correction = correct();
    if (correction.status != Status::converged) return correction.status;
    if (correction.size <= unit_roundoff<Quad>() / Quad(8)) return Status::converged;
  }
}

ProjectionOntoConstraints project_holonomic(const Model& model, const Quad& t, std::vector<Quad>& z) {
  ProjectionOntoConstraints result;
  const auto constraints = model.holonomic_constraints<Quad>();
  const std::size_t n = constraints->degrees(), count = constraints->count();
  const std::vector<Quad> before = z;
  const std::span<Quad> q = std::span<Quad>(z).first(n), p = std::span<Quad>(z).subspan(n);
  std::vector<Quad> residual(count), move(n);
  const std::vector<std::string> names = model.constraint_names();
  const auto positions = [&] { constraints->values(t, q, residual); };
  const auto momenta = [&] { constraints->hidden_values(t, q, p, residual); };
  positions();
  note_worst(residual, 2, 0, names, result);
  momenta();
  note_worst(residual, 2, 1, names, result);
  // x is moved by along(), a combination of gradients with the coefficients S^-1 residual.
  const auto bring = [&](std::span<Quad> x, const auto& measure, const auto& along) {
    return iterate(residual, measure, [&] {
      if (const Status status = constraints->linearise(t, q, p); status != Status::converged)
        return Correction{status};
      constraints->solve(residual, residual);
      along();
      return Correction{Status::converged, move_by(move, x)};
    });
  };
  result.status = bring(q, positions, [&] { constraints->hidden_by_momentum_transpose(residual, move); });
  if (result.status == Status::converged)
    result.status = bring(p, momenta, [&] { constraints->apply_transpose(residual, move); });
  const std::span<const Quad> old(before);
  result.change = std::max(relative_change(old.first(n), q), relative_change(old.subspan(n), p));
  return result;
}

ProjectionOntoConstraints project_in_phase_space(const Model& model, const Quad& t, std::vector<Quad>& z) {
  ProjectionOntoConstraints result;
  Replay<Quad> values(model.tape(Formula::constraints)), slopes(model.tape(Formula::constraint_gradients));
  const std::size_t n = z.size(), count = values.tape().outputs.size();
  const std::vector<Quad> before = z;
  std::vector<Quad> residual(count), rows(count * n), move(n);
  const auto measure = [&] { values(t, z.data(), residual.data()); };
  measure();
  note_worst(residual, 1, 0, model.constraint_names(), result);
  result.status = iterate(residual, measure, [&] {
    slopes(t, z.data(), rows.data());
    const Matrix<Quad> g(count, rows);
    move = g.transposed() * (inverse(g * g.transposed()) * residual);
    return Correction{Status::converged, move_by(move, z)};
  });
  result.change = relative_change(before, z);
  return result;
}
}  // namespace

ProjectionOntoConstraints project_onto_constraints(const Model& model, const Quad& t, std::vector<Quad>& z) {
  return model.holonomic() ? project_holonomic(model, t, z) : project_in_phase_space(model, t, z);
}

}  // namespace pfaff
