// Flows of the parts of a system from tapes: of systems that are given as text.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The flows for one scalar.
template <class T>
class TapedFlows final : public ExactFlows<T> {
 public:
  explicit TapedFlows(const std::vector<std::shared_ptr<const Tape>>& changes) {
    for (const auto& tape : changes) parts_.emplace_back(tape);
  }
  Status change(std::size_t part, const T& h, In<T> z, Out<T> change) override {
    parts_[part](h, z.data(), change.data());
    const bool finite =
        std::all_of(change.begin(), change.end(), [](const T& x) { return isfinite(value_of(x)); });
    return finite ? Status::converged : Status::non_finite;
  }

 private:
  std::vector<Replay<T>> parts_;
};

/// The flows of parts, each given by the tape of its change phi_h(z) - z: inputs z, and h in the place of the
/// time, so that what depends on h alone is computed once while steps are equal. Where the change is not
/// finite, the status says so.
class TapedFlowsFactory final : public detail::MakerInUnits<TapedFlowsFactory, ExactFlowsFactory> {
 public:
  explicit TapedFlowsFactory(std::vector<std::shared_ptr<const Tape>> changes)
      : changes_(std::move(changes)) {}
  template <class T>
  [[nodiscard]] ExactFlowsPointer<T> made() const {
    return std::make_unique<TapedFlows<T>>(changes_);
  }

 private:
  std::vector<std::shared_ptr<const Tape>> changes_;
};

}  // namespace pfaff
