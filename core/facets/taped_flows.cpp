#include <pfaff/core/facets/taped_flows.hpp>

#include <algorithm>
#include <utility>

#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {

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

class TapedFlowsFactory final : public MakerOf<TapedFlowsFactory, ExactFlowsFactory> {
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

}  // namespace

std::shared_ptr<const ExactFlowsFactory> taped_flows(std::vector<std::shared_ptr<const Tape>> changes) {
  return std::make_shared<const TapedFlowsFactory>(std::move(changes));
}

}  // namespace pfaff
