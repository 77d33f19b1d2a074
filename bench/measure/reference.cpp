#include <pfaff/bench/measure/reference.hpp>

#include <algorithm>

namespace pfaff {

ReferenceExpansion::ReferenceExpansion(const Model& model)
    : TaylorExpansion(model.tape(Formula::field), 28) {}

Quad ReferenceExpansion::safe_step() const {
  // The radius of convergence is estimated from the last two degrees. A step of e^-2.9 of it leaves terms of
  // degree 28 at e^(-2.9 * 28) = 5e-36 of the first term.
  // Where these are zero the series says nothing of the time scale, and the step is at most 1.
  const Quad scale = largest(0) > Quad(0) ? largest(0) : Quad(1e-30);
  Quad step(-1);
  for (const std::size_t degree : {order() - 1, order()}) {
    const Quad ratio = largest(degree) / scale;
    if (!(ratio > Quad(0))) continue;
    const Quad radius = exp(-log(ratio) / Quad(static_cast<int>(degree)));
    step = step < Quad(0) ? radius : std::min(step, radius);
  }
  return step < Quad(0) ? Quad(1) : step * exp(Quad(-2.9));
}

void ReferenceExpansion::evaluate(Quad s, Quad* z) const {
  for (std::size_t k = 0; k < size(); ++k) z[k] = coefficients()[k] + increment(s, k);
}

void taylor_flow(const Model& model, Quad t, Quad elapsed, std::vector<Quad>& z) {
  ReferenceExpansion expansion(model);
  const Quad sign(elapsed < Quad(0) ? -1 : 1);
  Quad left = abs(elapsed);
  while (left > Quad(0)) {
    expansion.expand(t, z.data());
    const Quad step = std::min(left, expansion.safe_step());
    expansion.evaluate(sign * step, z.data());
    t += sign * step;
    left -= step;
  }
}

ReferenceSolution::ReferenceSolution(std::shared_ptr<const Model> model, Quad t0, std::vector<Quad> initial,
                                     Quad duration)
    : model_(std::move(model)), t0_(t0), initial_(std::move(initial)) {
  if (model_->facets().has(Facet::exact_solution)) {
    problem_ = std::make_shared<const Problem<Quad>>(model_);
    return;
  }
  ReferenceExpansion expansion(*model_);
  std::vector<Quad> z = initial_;
  for (Quad t = t0; t <= t0 + duration;) {
    expansion.expand(t, z.data());
    pieces_.push_back({t, expansion.coefficients()});
    const Quad step = expansion.safe_step();
    expansion.evaluate(step, z.data());
    t += step;
    if (!isfinite(z[0])) break;  // the solution has left the domain; later times extrapolate the last piece
  }
}

std::vector<Quad> ReferenceSolution::at(Quad t) const {
  const std::size_t n = initial_.size();
  std::vector<Quad> z(n);
  if (problem_ != nullptr) {
    // A problem evaluates in buffers of its own; each call makes one, so that threads can call at once.
    const Problem<Quad> problem(model_);
    std::vector<Quad> arguments = initial_;
    arguments.push_back(t0_);
    problem.exact_solution(t - t0_, arguments, z);
    return z;
  }
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                      [](Quad time, const Piece& piece) { return time < piece.begin; });
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *std::prev(after);
  const Quad s = t - piece.begin;
  const std::size_t degrees = piece.coefficients.size() / n;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = degrees; l-- > 0;) z[k] = z[k] * s + piece.coefficients[l * n + k];
  return z;
}

}  // namespace pfaff
