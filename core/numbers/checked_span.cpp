#include <pfaff/core/numbers/checked_span.hpp>

#include <stdexcept>
#include <string>

namespace pfaff {

void refuse_elements(std::size_t begin, std::size_t count, std::size_t size) {
  const std::string elements =
      count == 1 ? "element [" + std::to_string(begin) + "]"
                 : std::to_string(count) + " elements from [" + std::to_string(begin) + "] on";
  throw std::out_of_range("asks for " + elements + " of an argument with " + std::to_string(size) +
                          (size == 1 ? " element" : " elements"));
}

}  // namespace pfaff
