#include <pfaff/runs/support/constraints.hpp>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

std::vector<std::string> constraint_residual_names(const Model& model) {
  if (!model.restricted()) return {};
  if (model.holonomic()) return {"constraint", "hidden-constraint"};
  return {"constraint"};
}

std::vector<std::string> velocity_constraint_names(const Model& model) {
  std::vector<std::string> names;
  for (const std::string& name : model.source().constraint_names) names.push_back(name + "~");
  for (const std::string& name : model.source().velocity_constraint_names) names.push_back(name);
  return names;
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

// Moves x, the positions or the momenta of (q, p), until measure() finds no residual: along(), a combination
// of gradients with the coefficients S^-1 residual, fills the move. S is that of `constraints`.
template <class Constraints, class Measure, class Along>
Status bring(Constraints& constraints, const Quad& t, std::span<const Quad> q, std::span<const Quad> p,
             std::span<Quad> x, std::vector<Quad>& residual, const std::vector<Quad>& move,
             const Measure& measure, const Along& along) {
  return iterate(residual, measure, [&] {
    if (const Status status = constraints.linearise(t, q, p); status != Status::converged)
      return Correction{status};
    constraints.solve(residual, residual);
    along();
    return Correction{Status::converged, move_by(move, x)};
  });
}

// Positions and momenta of a state, which are brought onto their constraints one after the other.
class InStages {
 public:
  InStages(const Model& model, const Quad& t, std::vector<Quad>& z)
      : model_(model),
        t_(t),
        before_(z),
        n_(z.size() / 2),
        q_(std::span<Quad>(z).first(n_)),
        p_(std::span<Quad>(z).subspan(n_)),
        move_(n_),
        names_(model.constraint_names()) {}

  ProjectionOntoConstraints result() {
    const std::span<const Quad> old(before_);
    result_.change = std::max(relative_change(old.first(n_), q_), relative_change(old.subspan(n_), p_));
    return result_;
  }

  void holonomic() {
    const auto constraints = model_.holonomic_constraints<Quad>();
    residual_.resize(constraints->count());
    const auto momenta = [&] { constraints->hidden_values(t_, q_, p_, residual_); };
    note_positions(*constraints);
    momenta();
    note_worst(residual_, 2, 1, names_, result_);
    move_positions(*constraints);
    if (result_.status == Status::converged)
      result_.status = bring(*constraints, t_, q_, p_, p_, residual_, move_, momenta,
                             [&] { constraints->apply_transpose(residual_, move_); });
  }

  // Holonomic constraints beside those of velocities first; their rates are among the psi.
  void velocities() {
    const auto constraints = model_.velocity_constraints<Quad>();
    const auto momenta = [&] { constraints->values(t_, q_, p_, residual_); };
    std::vector<Quad> psi(constraints->count());
    constraints->values(t_, q_, p_, psi);
    note_worst(psi, 1, 0, velocity_constraint_names(model_), result_);
    if (const std::size_t hidden = model_.source().constraint_names.size(); hidden > 0) {
      const auto positions = model_.holonomic_constraints<Quad>();
      residual_.resize(hidden);
      note_positions(*positions);
      move_positions(*positions);
    }
    residual_.resize(psi.size());
    if (result_.status == Status::converged)
      result_.status = bring(*constraints, t_, q_, p_, p_, residual_, move_, momenta,
                             [&] { constraints->apply_transpose(residual_, move_); });
  }

 private:
  void note_positions(HolonomicConstraints<Quad>& constraints) {
    constraints.values(t_, q_, residual_);
    note_worst(residual_, 2, 0, names_, result_);
  }
  void move_positions(HolonomicConstraints<Quad>& constraints) {
    result_.status = bring(
        constraints, t_, q_, p_, q_, residual_, move_, [&] { constraints.values(t_, q_, residual_); },
        [&] { constraints.hidden_by_momentum_transpose(residual_, move_); });
  }

  const Model& model_;
  const Quad& t_;
  const std::vector<Quad> before_;
  const std::size_t n_;
  const std::span<Quad> q_, p_;
  std::vector<Quad> residual_, move_;
  const std::vector<std::string> names_;
  ProjectionOntoConstraints result_;
};

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
  if (!model.holonomic() && !model.nonholonomic()) return project_in_phase_space(model, t, z);
  InStages stages(model, t, z);
  if (model.holonomic()) {
    stages.holonomic();
  } else {
    stages.velocities();
  }
  return stages.result();
}

}  // namespace pfaff
