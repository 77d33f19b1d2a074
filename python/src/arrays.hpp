// NumPy arrays that own the memory of results, so that these reach Python without a copy.
#pragma once

#include <pybind11/numpy.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

namespace pfaff::python {

/// Doubles that grow in number. A vector would set new ones to zero and copy them where they move, which
/// costs as much as a step of a cheap method; large memory moves here without being copied.
class Numbers {
 public:
  Numbers() = default;
  Numbers(Numbers&& other) noexcept { swap(other); }
  Numbers& operator=(Numbers&& other) noexcept {
    Numbers taken(std::move(other));
    swap(taken);
    return *this;
  }
  ~Numbers() { std::free(data_); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const double* data() const { return data_; }
  /// Room for so many more, which the caller writes.
  [[nodiscard]] double* extend(std::size_t count) {
    if (size_ + count > capacity_) reserve(std::max(size_ + count, 2 * capacity_));
    size_ += count;
    return data_ + size_ - count;
  }
  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    const bool large = data_ == nullptr && capacity >= page_size / 2;
    if (large) capacity = (capacity + page_size - 1) / page_size * page_size;
    const std::size_t bytes = capacity * sizeof(double);
    void* const moved =
        large ? std::aligned_alloc(page_size * sizeof(double), bytes) : std::realloc(data_, bytes);
    if (moved == nullptr) throw std::bad_alloc();
    data_ = static_cast<double*>(moved);
    capacity_ = capacity;
    ask_for_large_pages();
  }
  /// The memory, to be given to std::free.
  [[nodiscard]] double* release() {
    size_ = capacity_ = 0;
    return std::exchange(data_, nullptr);
  }

 private:
  // Large memory comes in large pages where the system has them: to make room in small ones takes longer than
  // the steps of a cheap method. What is reserved at once begins and ends with one.
  void ask_for_large_pages() const {
    constexpr std::uintptr_t page = page_size * sizeof(double);
    const auto begin = (reinterpret_cast<std::uintptr_t>(data_) + page - 1) / page * page,
               end = reinterpret_cast<std::uintptr_t>(data_ + capacity_) / page * page;
    if (begin < end) (void)madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
  }
  void swap(Numbers& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  static constexpr std::size_t page_size = 1 << 18;  // of a large page, in numbers

  double* data_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

/// An array of that shape, which has as many numbers.
inline pybind11::array_t<double> array_owning(Numbers numbers, std::vector<pybind11::ssize_t> shape) {
  if (numbers.data() == nullptr) return pybind11::array_t<double>(std::move(shape));
  double* const data = numbers.release();
  const pybind11::capsule owner(data, [](void* held) { std::free(held); });
  return pybind11::array_t<double>(std::move(shape), data, owner);
}

/// The array of a few numbers.
inline pybind11::array_t<double> array_of_numbers(const std::vector<double>& numbers,
                                                  std::vector<pybind11::ssize_t> shape) {
  return pybind11::array_t<double>(std::move(shape), numbers.data());
}

}  // namespace pfaff::python
