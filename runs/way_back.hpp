// The way back of a run: what undoes its steps where a method is symmetric or reversible.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff {

/// Leads runs back by steps of -h, or by the reversal rho of a model: from the reversed state by steps of h,
/// at the end of which the state is reversed once more. The latter speaks of autonomous systems only.
template <class T>
class WayBack {
 public:
  /// By the reversal of this model; without one by steps of -h.
  explicit WayBack(const std::shared_ptr<const Model>& reversing = nullptr);
  [[nodiscard]] bool by_reversal() const { return reversal_.has_value(); }
  /// Where so many steps lead back from where the run is, with what it remembers. The run goes there; nullopt
  /// where a step fails, and where a reversed state is not finite.
  [[nodiscard]] std::optional<std::vector<T>> operator()(Integration<T>& run, std::int64_t steps) const;

 private:
  [[nodiscard]] std::vector<T> image(std::span<const T> z) const;
  std::optional<Evaluator<T>> reversal_;
};

/// What leads the method of a run back: the reversal that the model states, otherwise negative steps. A
/// method that remembers earlier steps, of whose steps after a turn nothing is known but what it claims, is
/// led back by what it claims to be, reversible or symmetric; nullopt where it claims neither.
template <class T>
std::optional<WayBack<T>> way_back(const Integration<T>& start, bool remembers);

}  // namespace pfaff
