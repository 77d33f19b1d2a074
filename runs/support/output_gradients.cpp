#include <pfaff/runs/support/output_gradients.hpp>

#include <algorithm>
#include <cmath>

#include <pfaff/core/tape/sparse_gradients.hpp>

namespace pfaff {

template <class T>
OutputGradients<T>::OutputGradients(const Tape& tape) {
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

template <class T>
const std::vector<T>& OutputGradients<T>::values(const T& t, const T* z) {
  (*replay_)(t, z, values_.data());
  return values_;
}

template class OutputGradients<double>;
template class OutputGradients<Pack<8>>;

void PropagatedRoundings::add(const Pack<8>& t, const Pack<8>* z) {
  const std::vector<Pack<8>>& slopes = gradients_.values(t, z);
  const auto& entries = gradients_.entries();
  for (std::size_t e = 0; e < entries.size();) {
    const std::size_t output = entries[e].output;
    Pack<8> sum = 0;
    for (; e < entries.size() && entries[e].output == output; ++e)
      sum = sum + abs(slopes[e] * z[entries[e].input]);
    for (std::size_t lane = 0; lane < 8; ++lane)
      if (std::isfinite(sum[lane])) largest_[output] = std::max(largest_[output], sum[lane]);
  }
}

}  // namespace pfaff
