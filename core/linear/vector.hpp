// Vector: a small state vector of fixed size N, or of a size set at construction (N = dynamic).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pfaff {

/// The extent of vectors whose size is known at run time only.
inline constexpr int dynamic = -1;

/// N numbers of type T, on the stack.
template <class T, int N>
class Vector {
 public:
  Vector() = default;
  explicit Vector(std::size_t /*size*/) {}

  [[nodiscard]] static constexpr std::size_t size() { return static_cast<std::size_t>(N); }
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  T* data() { return elements_.data(); }
  const T* data() const { return elements_.data(); }
  T* begin() { return elements_.data(); }
  T* end() { return elements_.data() + N; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return elements_.data() + N; }

 private:
  std::array<T, static_cast<std::size_t>(N)> elements_{};
};

/// A vector whose size is set when it is made; copying between equal sizes does not allocate.
template <class T>
class Vector<T, dynamic> : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  using value_type = T;
};

}  // namespace pfaff
