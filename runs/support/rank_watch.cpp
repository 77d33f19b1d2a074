#include <pfaff/runs/support/rank_watch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfaff {

template <class T>
SmallestPivot<T> smallest_pivot_of_symmetric(std::vector<T>& a, std::size_t count) {
  SmallestPivot<T> smallest;
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < count; ++i)
      if (a[i * count + i] > a[best * count + best]) best = i;
    for (std::size_t j = 0; j < count && best != k; ++j) std::swap(a[k * count + j], a[best * count + j]);
    for (std::size_t i = 0; i < count && best != k; ++i) std::swap(a[i * count + k], a[i * count + best]);
    const T pivot = a[k * count + k];
    smallest.size = pivot > T(0) ? pivot : T(0);
    if (!(pivot > T(0))) return smallest;  // round-off of zero, or not a number
    for (std::size_t i = k + 1; i < count; ++i)
      for (std::size_t j = k + 1; j < count; ++j)
        a[i * count + j] -= a[i * count + k] * a[k * count + j] / pivot;
  }
  return smallest;
}

template <class T>
SmallestPivot<T> smallest_pivot_of_skew(std::vector<T>& a, std::size_t count) {
  SmallestPivot<T> smallest;
  const auto exchange = [&](std::size_t i, std::size_t j) {
    if (i == j) return;
    for (std::size_t k = 0; k < count; ++k) std::swap(a[i * count + k], a[j * count + k]);
    for (std::size_t k = 0; k < count; ++k) std::swap(a[k * count + i], a[k * count + j]);
    smallest.sign = -smallest.sign;
  };
  for (std::size_t k = 0; k + 1 < count; k += 2) {
    std::size_t row = k, column = k + 1;
    for (std::size_t i = k; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        if (abs(a[i * count + j]) > abs(a[row * count + column])) {
          row = i;
          column = j;
        }
    exchange(k, row);
    exchange(k + 1, column);
    const T pivot = a[k * count + k + 1];
    smallest.size = abs(pivot);
    if (!(smallest.size > T(0))) return smallest;
    if (pivot < T(0)) smallest.sign = -smallest.sign;
    for (std::size_t i = k + 2; i < count; ++i)
      for (std::size_t j = k + 2; j < count; ++j)
        a[i * count + j] -=
            (a[i * count + k] * a[j * count + k + 1] - a[i * count + k + 1] * a[j * count + k]) / pivot;
  }
  return smallest;
}

template <class T>
RankWatch<T>::RankWatch(std::shared_ptr<const Model> model, Advance advance)
    : model_(std::move(model)), advance_(std::move(advance)) {
  const Model& m = *model_;
  const auto n = static_cast<std::size_t>(m.dimension());
  if (m.holonomic()) {
    positions_ = m.template holonomic_constraints<T>();
    count_ = positions_->count();
    matrix_ = "S = B H_pp B^T of the constraints";
  } else if (m.nonholonomic()) {
    velocities_ = m.template velocity_constraints<T>();
    count_ = velocities_->count();
    matrix_ = "S = A H_pp A^T of the constraints of velocities";
  } else if (m.restricted() && m.constrained()) {
    replays_.emplace_back(m.tape(Formula::constraint_gradients));
    replays_.emplace_back(m.tape(Formula::poisson_tensor));
    count_ = replays_.front().tape().outputs.size() / n;
    skew_ = true;
    matrix_ = "the matrix C of the constraints' Poisson brackets";
  } else if (m.facets().has(Facet::structure)) {
    replays_.emplace_back(m.tape(Formula::structure));
    count_ = n;
    skew_ = true;
    matrix_ = "the structure K";
  }
  if (count_ == 0 || count_ > most_rows_watched ||
      (skew_ && (count_ % 2 != 0 || n > most_coordinates_watched))) {
    matrix_.clear();
    positions_.reset();
    velocities_.reset();
    replays_.clear();
    return;
  }
  entries_.resize(count_ * count_);
  scales_.resize(count_);
  largest_.resize(count_);
  force_.resize(n / 2);
  velocity_.resize(n / 2);
  unit_.resize(count_);
  column_.resize(count_);
  if (replays_.size() < 2) return;
  gradients_.resize(count_ * n);
  tensor_.resize(n * n);
  image_.resize(n);
}

template <class T>
void RankWatch<T>::fill(const T& t, const std::vector<T>& z) {
  const std::size_t n = z.size(), half = n / 2;
  const In<T> state(z);
  if (positions_ || velocities_) {
    // Where S cannot be factored it is still there, and its columns are what is asked for.
    (void)(positions_ ? positions_->linearise(t, state.first(half), state.subspan(half))
                      : velocities_->linearise(t, state.first(half), state.subspan(half)));
    for (std::size_t j = 0; j < count_; ++j) {
      std::fill(unit_.begin(), unit_.end(), T(0));
      unit_[j] = T(1);
      if (positions_) {
        positions_->hidden_by_momentum_transpose(unit_, velocity_);
        positions_->apply(velocity_, column_);
      } else {
        velocities_->apply_transpose(unit_, force_);
        velocities_->by_momentum(force_, column_);
      }
      for (std::size_t i = 0; i < count_; ++i) entries_[i * count_ + j] = column_[i];
    }
    return;
  }
  if (replays_.size() == 1) return replays_[0](t, z.data(), entries_.data());
  replays_[0](t, z.data(), gradients_.data());
  replays_[1](t, z.data(), tensor_.data());
  for (std::size_t j = 0; j < count_; ++j) {
    for (std::size_t k = 0; k < n; ++k) {
      image_[k] = T(0);
      for (std::size_t l = 0; l < n; ++l) image_[k] += tensor_[k * n + l] * gradients_[j * n + l];
    }
    for (std::size_t i = 0; i < count_; ++i) {
      T sum(0);
      for (std::size_t k = 0; k < n; ++k) sum += gradients_[i * n + k] * image_[k];
      entries_[i * count_ + j] = sum;
    }
  }
}

template <class T>
SmallestPivot<T> RankWatch<T>::pivot_of_filled() {
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j) {
      const T size = sqrt(scales_[i]) * sqrt(scales_[j]);
      if (size > T(0)) entries_[i * count_ + j] /= size;
    }
  return skew_ ? smallest_pivot_of_skew(entries_, count_) : smallest_pivot_of_symmetric(entries_, count_);
}

// What rounding leaves of a pivot that is zero.
template <class T>
T RankWatch<T>::round_off() const {
  return T(64) * unit_roundoff<T>() * T(static_cast<double>(count_));
}

template <class T>
std::string RankWatch<T>::observe(const T& t, const std::vector<T>& z) {
  if (matrix_.empty()) return {};
  std::rotate(places_.begin(), places_.end() - 1, places_.end());
  Place& now = places_.front();
  now.t = t;
  now.z = z;
  fill(t, z);
  // What is beyond the range of numbers has not lost its rank, and can no longer be watched.
  if (!std::all_of(entries_.begin(), entries_.end(), [](const T& x) { return isfinite(x); })) {
    matrix_.clear();
    return {};
  }
  for (std::size_t i = 0; i < count_; ++i) {
    T size(0);
    for (std::size_t j = skew_ ? 0 : i; j < (skew_ ? count_ : i + 1); ++j)
      size = std::max(size, T(abs(entries_[i * count_ + j])));
    if (known_ == 0) scales_[i] = size;
    largest_[i] = std::max(scales_[i], size);
  }
  now.pivot = pivot_of_filled();
  if (++known_ == 1 && !(now.pivot.size > round_off())) matrix_.clear();
  std::string found = verdict();
  scales_ = largest_;  // sizes that a run leaps to are no measure of the states before the leap
  return found;
}

template <class T>
std::string RankWatch<T>::verdict() {
  if (known_ < 2) return {};
  const Place &now = places_[0], &before = places_[1];
  const auto between = [&](const T& from) {
    return " between t = " + to_string(Quad(from), 10) + " and t = " + to_string(Quad(now.t), 10);
  };
  const T noise = T(1024) * round_off();
  if (skew_ && now.pivot.sign != before.pivot.sign && now.pivot.size > noise && before.pivot.size > noise)
    return matrix_ + " is singular" + between(before.t) + ", where its Pfaffian changes its sign";
  if (known_ >= 3 && suspected() && vanishes())
    return matrix_ + " is singular" + between(places_[2].t) + ", where its smallest pivot vanishes";
  return {};
}

template <class T>
bool RankWatch<T>::suspected() const {
  const T &now = places_[0].pivot.size, &middle = places_[1].pivot.size, &first = places_[2].pivot.size;
  return middle <= now && middle <= first && T(2) * middle <= std::max(now, first);
}

template <class T>
bool RankWatch<T>::vanishes() {
  constexpr std::size_t parts = 4;
  const Place *from = &places_[2], *to = &places_[0];
  const T beside = std::min(from->pivot.size, to->pivot.size);
  // S is quadratic in the rows that vanish, and as many digits of their sizes are wanted.
  const T zero = std::max(beside * T(skew_ ? 1e-8 : 1e-16), round_off());
  if (!(beside > T(1024) * round_off())) return false;
  std::array<Place, parts + 1> at;
  at[0] = *from;
  T span = to->t - from->t;
  for (int halving = 0; halving < 60; ++halving) {
    std::size_t least = 0;
    for (std::size_t k = 0; k <= parts; ++k) {
      if (k > 0) {
        at[k].z = at[k - 1].z;
        const T part = span / T(static_cast<double>(parts));
        at[k].t = at[k - 1].t + part;
        const Status status = advance_(at[k - 1].t, part, at[k].z);
        if (status != Status::converged) return status == Status::singular;
      }
      fill(at[k].t, at[k].z);
      at[k].pivot = pivot_of_filled();
      if (at[k].pivot.size < at[least].pivot.size) least = k;
    }
    if (at[least].pivot.size <= zero) return true;
    if (least == 0 || least == parts) return false;
    if (std::max(at[least - 1].pivot.size, at[least + 1].pivot.size) < T(2) * at[least].pivot.size)
      return false;
    if (least > 1) at[0] = at[least - 1];
    span = span / T(2);
  }
  return true;
}

template SmallestPivot<double> smallest_pivot_of_symmetric(std::vector<double>& a, std::size_t count);
template SmallestPivot<Quad> smallest_pivot_of_symmetric(std::vector<Quad>& a, std::size_t count);
template SmallestPivot<double> smallest_pivot_of_skew(std::vector<double>& a, std::size_t count);
template SmallestPivot<Quad> smallest_pivot_of_skew(std::vector<Quad>& a, std::size_t count);
template class RankWatch<double>;
template class RankWatch<Quad>;

}  // namespace pfaff
