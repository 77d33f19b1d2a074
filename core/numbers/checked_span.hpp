// CheckedSpan: a span that refuses an element past its end.
//
// The spans of formulas have no checks, because a step would pay for them. Every formula is also run with the
// recording scalar, though, before any step is taken; with that scalar its arguments and results are
// CheckedSpans, and the author of p[1], where there is one momentum, is told so.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

namespace pfaff {

/// Throws std::out_of_range: elements begin ... begin + count - 1 were asked for in a span of `size`.
[[noreturn]] void refuse_elements(std::size_t begin, std::size_t count, std::size_t size);

/// std::span<E>, into which it converts, with checked access by index and checked parts. `data()` and the
/// iterators are the span's own, without checks.
template <class E>
class CheckedSpan : public std::span<E> {
  using Span = std::span<E>;

 public:
  CheckedSpan() = default;
  CheckedSpan(E* data, std::size_t size) : Span(data, size) {}
  /// From whatever a span can be made of without being asked to: spans, vectors, arrays.
  template <class Range>
  requires(std::convertible_to<Range, Span>) CheckedSpan(Range&& range)  // NOLINT
      : Span(static_cast<Range&&>(range)) {}

  E& operator[](std::size_t index) const {
    require(index, 1);
    return Span::operator[](index);
  }
  [[nodiscard]] E& front() const { return (*this)[0]; }
  [[nodiscard]] E& back() const {
    require(0, 1);
    return Span::back();
  }
  [[nodiscard]] CheckedSpan first(std::size_t count) const { return subspan(0, count); }
  [[nodiscard]] CheckedSpan last(std::size_t count) const {
    require(0, count);
    return subspan(this->size() - count, count);
  }
  /// Without a count, the rest.
  [[nodiscard]] CheckedSpan subspan(std::size_t begin, std::size_t count = std::dynamic_extent) const {
    require(begin, 0);
    const std::size_t taken = count == std::dynamic_extent ? this->size() - begin : count;
    require(begin, taken);
    return {this->data() + begin, taken};
  }

 private:
  void require(std::size_t begin, std::size_t count) const {
    if (begin > this->size() || count > this->size() - begin) refuse_elements(begin, count, this->size());
  }
};

}  // namespace pfaff
