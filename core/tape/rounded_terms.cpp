#include <pfaff/core/tape/rounded_terms.hpp>

#include <utility>

namespace pfaff {

template <class T>
RoundedTerms<T>::RoundedTerms(std::shared_ptr<const Tape> tape)
    : replay_(std::move(tape)),
      inputs_(static_cast<std::size_t>(replay_.tape().inputs)),
      outputs_(replay_.tape().outputs.size()),
      terms_(outputs_.size()) {}

template <class T>
const std::vector<T>& RoundedTerms<T>::operator()(const T& t, std::span<const T> z,
                                                  std::span<const T> sizes) {
  for (std::size_t k = 0; k < inputs_.size(); ++k) inputs_[k] = {z[k], sizes[k]};
  replay_(WithRounding<T>(t, T(abs(t))), inputs_.data(), outputs_.data());
  for (std::size_t k = 0; k < terms_.size(); ++k) terms_[k] = outputs_[k].error;
  return terms_;
}

template class RoundedTerms<double>;
template class RoundedTerms<Quad>;

}  // namespace pfaff
