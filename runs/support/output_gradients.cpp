#include <pfaff/runs/support/output_gradients.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/tape/sparse_gradients.hpp>

namespace pfaff {

OutputGradients::OutputGradients(const Tape& tape) {
  Recorder recorder(tape.inputs);
  std::vector<Recorded> slopes;
  const auto rows = sparse_gradients(tape, recorder.time(), recorder.inputs(), std::size_t(tape.inputs));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (const auto& [input, slope] : rows[k]) {
      entries_.push_back({k, input});
      slopes.push_back(slope);
    }
  replay_.emplace(std::make_shared<const Tape>(recorder.finish(slopes)));
  values_.resize(slopes.size());
}

const std::vector<double>& OutputGradients::values(double t, const std::vector<double>& z) {
  (*replay_)(t, z.data(), values_.data());
  return values_;
}

void PropagatedRoundings::add(double t, const std::vector<double>& z) {
  const std::vector<double>& slopes = gradients_.values(t, z);
  const auto& entries = gradients_.entries();
  for (std::size_t e = 0; e < entries.size();) {
    const std::size_t output = entries[e].output;
    double sum = 0;
    for (; e < entries.size() && entries[e].output == output; ++e)
      sum += std::abs(slopes[e] * z[entries[e].input]);
    if (std::isfinite(sum)) largest_[output] = std::max(largest_[output], sum);
  }
}

}  // namespace pfaff
