#include <pfaff/runs/watched/solution_errors.hpp>

namespace pfaff {

template <class T>
SolutionErrors<T>::SolutionErrors(const std::shared_ptr<const Model>& model,
                                  const ReferenceSolution& solution)
    : solution_(solution) {
  for (std::size_t i = 0; i < model->invariants().size(); ++i)
    if (model->invariants()[i].behaviour != Behaviour::conserved) changing_.push_back(i);
  if (!changing_.empty()) problem_.emplace(model);
}

template <class T>
Quad SolutionErrors<T>::operator()(const Quad& exact_time, std::span<const T> state) {
  time_ = exact_time;
  exact_ = solution_.at(exact_time);
  Quad distance(0), norm(0);
  for (std::size_t k = 0; k < exact_.size(); ++k) {
    const Quad d = Quad(state[k]) - exact_[k];
    distance += d * d;
    norm += exact_[k] * exact_[k];
  }
  return distance == Quad(0) ? Quad(0) : sqrt(distance / norm);
}

template <class T>
std::vector<Quad> SolutionErrors<T>::of_invariants(std::span<const T> invariants) {
  std::vector<Quad> off, values(invariants.size());
  if (!problem_) return off;
  problem_->invariants(time_, exact_, values);
  for (const std::size_t i : changing_) off.push_back(Quad(invariants[i]) - values[i]);
  return off;
}

template class SolutionErrors<double>;
template class SolutionErrors<Quad>;

}  // namespace pfaff
