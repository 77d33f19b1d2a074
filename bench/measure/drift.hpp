#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>
namespace pfaff {
enum class DriftClass { exact, bounded, random_walk, linear, polynomial, exponential, undetermined };
const char* to_string(DriftClass kind);
struct Drift {
  DriftClass kind = DriftClass::undetermined;
  double probability = 0;
  std::size_t samples = 0;
  std::size_t non_finite = 0;
  std::optional<double> non_finite_time;
  double maximum = 0, rms = 0, final = 0;
  double slope = 0, slope_low = 0, slope_high = 0;
  double oscillation_amplitude = 0, oscillation_rms = 0;
  std::optional<double> growth_exponent, growth_rate;
};
class DriftAccumulator {
 public:
  struct Block {
    std::size_t count = 0;
    double time = 0, mean = 0, minimum = 0, maximum = 0, mean_square = 0;
  };
  explicit DriftAccumulator(std::size_t capacity = 1024);
  void add(double t, double error);
  Drift result() const;
  const std::vector<Block>& blocks() const { return blocks_; }
 private:
  static Block merged(const Block& a, const Block& b);
  std::vector<Block> blocks_;
  std::size_t capacity_, length_ = 1, samples_ = 0, non_finite_ = 0;
  double first_time_ = 0, last_time_ = 0, final_ = 0, bad_time_ = 0;
  double mean_time_ = 0, mean_ = 0, time_time_ = 0, time_error_ = 0, error_error_ = 0;
};
}
