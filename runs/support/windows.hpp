// windows: a series of errors, kept in blocks of consecutive samples, and its means over windows in time.
//
// A series of any length is held in at most a few thousand blocks. From them follow, over overlapping windows
// of the run, the weighted mean of the errors, which shows what is slow, and their spread about that mean,
// which shows what is fast.
//
// B windows of width 2/(B+1) have their centres at j/(B+1), j = 1 .. B, on scaled time s in (0, 1), so that
// neighbours overlap by half. The weight is Hann's, 1 + cos(pi (s - centre)(B+1)): an oscillation of two or
// more periods a window is damped to less than 3 %, and what a sampling interval aliases to low frequencies
// vanishes quadratically.
#pragma once

#include <cstddef>
#include <vector>

namespace pfaff::windows {

/// Statistics of consecutive samples of the error e at times t.
struct Block {
  std::size_t count = 0;
  double time = 0, mean = 0;                         // means of t and e
  double minimum = 0, maximum = 0, mean_square = 0;  // of e
  bool minimum_first = true;                         // whether the minimum came before the maximum
};

/// The block of the samples of both, those of `a` before those of `b`.
Block merged(const Block& a, const Block& b);

/// Blocks on scaled time: sample k of n stands at s = (k + 1/2)/n.
struct Series {
  std::vector<Block> blocks;
  std::vector<double> s;  // scaled times of the blocks, in (0, 1), increasing
  std::size_t samples = 0;
  double span = 1;  // time per unit of s; negative where time runs backwards
};

/// The series of blocks whose first and last sample were taken at the times given.
Series on_scaled_time(std::vector<Block> blocks, double first_time, double last_time);

/// Weighted mean of the errors in each of `count` windows, and their root mean square about it. Empty where a
/// window holds no block.
struct Windows {
  std::vector<double> mean, spread;
};
Windows over_windows(const Series& series, std::size_t count);

/// Points of the grid on which the weights of windows are tabulated, in half a window: so many lie between
/// the centres of neighbours.
inline constexpr std::size_t points_in_half = 16;

/// Hann's weight at the scaled time s in the window of that centre, one of `count`.
double hann(double s, double centre, std::size_t count);

}  // namespace pfaff::windows
