#include <pfaff/runs/support/rounding_sizes.hpp>

#include <algorithm>

namespace pfaff {

void RoundingSizes::add(double t, const std::vector<double>& z) {
  size_ = 1 + z.size();
  if (kept_.size() + size_ > std::max(most_kept, 8 * size_)) take_kept();
  kept_.push_back(t);
  kept_.insert(kept_.end(), z.begin(), z.end());
}

const std::vector<double>& RoundingSizes::first_terms() {
  take_kept();
  return first_terms_;
}

RoundOff RoundingSizes::largest(double unit, std::int64_t steps, std::size_t first, std::size_t stride) {
  take_kept();
  RoundOff result{unit, 0, steps};
  if (!terms_) return result;
  if (propagated_) result.propagated = 0;
  for (std::size_t k = first; k < terms_->largest().size(); k += stride) {
    result.scale = std::max(result.scale, terms_->largest()[k]);
    if (propagated_) result.propagated = std::max(*result.propagated, propagated_->largest()[k]);
  }
  return result;
}

void RoundingSizes::take_kept() {
  if (kept_.empty()) return;
  std::size_t taken = 0;
  if (!terms_) {
    terms_.emplace(tape_);
    if (takes_gradients(*tape_)) propagated_.emplace(*tape_);
    states_.resize(size_ - 1);
    take(taken++, 1);
    first_terms_ = terms_->largest();
  }
  for (const std::size_t all = kept_.size() / size_; taken < all;
       taken += std::min<std::size_t>(8, all - taken))
    take(taken, std::min<std::size_t>(8, all - taken));
  kept_.clear();
}

// In lanes behind the last state stand copies of it.
void RoundingSizes::take(std::size_t first, std::size_t count) {
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const double* state = kept_.data() + (first + std::min(lane, count - 1)) * size_;
    times_.set(lane, *state++);
    for (Pack<8>& x : states_) x.set(lane, *state++);
  }
  terms_->add(times_, states_.data());
  if (propagated_) propagated_->add(times_, states_.data());
}

}  // namespace pfaff
