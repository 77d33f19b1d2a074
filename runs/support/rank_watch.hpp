// Whether a matrix that the motion needs regular is singular somewhere between two states of a run.
//
// Velocity constraints whose rows A(q) turn into dependent ones at a point, constraints phi(z, t) = 0 whose
// Poisson brackets C vanish there, and a structure K(z, t) that is singular there leave the motion undefined.
// A step whose stages lie on either side of the point does not notice. Two signs show that it was passed:
//
//   - the Pfaffian of C or K, which are skew, has changed its sign: it is continuous, and so was zero;
//   - the smallest pivot has a minimum that is zero. That is suspected where it falls to half or less of what
//     it is beside the minimum, and is looked into with steps of the method that become smaller and smaller.
//     A minimum that is not zero becomes flat, a zero looks the same at every magnification.
//
// S = A H_pp A^T, which is symmetric and not negative, shows only the second sign. Pivots are taken with rows
// and columns divided by the largest sizes that they have had in the run. What is singular from the start,
// such as constraints that say the same twice, changes no rank and is not watched, nor are matrices of more
// than most_rows_watched rows, whose elimination would take most of a run.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The largest matrices that are watched, and the largest states where a dense tensor takes part in them.
inline constexpr std::size_t most_rows_watched = 16;
inline constexpr std::size_t most_coordinates_watched = 64;

/// The elimination of a matrix with the largest pivots first.
template <class T>
struct SmallestPivot {
  T size{0};     // of the last pivot
  int sign = 1;  // of the Pfaffian
};
/// Of a symmetric matrix without negative eigenvalues, count x count and row-major. `a` is overwritten.
template <class T>
SmallestPivot<T> smallest_pivot_of_symmetric(std::vector<T>& a, std::size_t count);
/// Of a skew matrix, whose pivots are blocks of two rows. The count is even.
template <class T>
SmallestPivot<T> smallest_pivot_of_skew(std::vector<T>& a, std::size_t count);

/// Watches one run in the scalar T.
template <class T>
class RankWatch {
 public:
  /// Moves a state from t over a span of time, in steps no longer than those of the run.
  using Advance = std::function<Status(const T& t, const T& span, std::vector<T>& z)>;

  RankWatch(std::shared_ptr<const Model> model, Advance advance);

  /// False where the model has no such matrix.
  [[nodiscard]] bool watches() const { return !matrix_.empty(); }

  /// Takes the next state of the run. Says, in a sentence without its end, which matrix has changed its rank
  /// since one of the two states before; nothing where none has.
  [[nodiscard]] std::string observe(const T& t, const std::vector<T>& z);

 private:
  struct Place {
    T t{0};
    std::vector<T> z;
    SmallestPivot<T> pivot;
  };

  void fill(const T& t, const std::vector<T>& z);
  // Of what was filled in, which is overwritten.
  [[nodiscard]] SmallestPivot<T> pivot_of_filled();
  [[nodiscard]] std::string verdict();
  [[nodiscard]] bool suspected() const;
  // Whether the smallest pivot vanishes between the first and the last of the three places.
  [[nodiscard]] bool vanishes();
  [[nodiscard]] T round_off() const;

  std::shared_ptr<const Model> model_;
  Advance advance_;
  std::string matrix_;     // its name and meaning; empty where nothing is watched
  std::size_t count_ = 0;  // of its rows
  bool skew_ = false;
  std::unique_ptr<PositionConstraints<T>> positions_;
  VelocityPointer<T> velocities_;
  std::vector<Replay<T>> replays_;  // of K, or of the constraints' gradients and Poisson's tensor
  std::vector<T> entries_, scales_, largest_, gradients_, tensor_, image_, force_, velocity_, unit_, column_;
  std::array<Place, 3> places_;  // the last one first
  std::size_t known_ = 0;
};

}  // namespace pfaff
