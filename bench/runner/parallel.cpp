#include <pfaff/bench/runner/parallel.hpp>

#include <oneapi/tbb/parallel_for.h>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task) {
  const Budget* const caller = Budget::current();
  const std::atomic<bool>* const stop = caller == nullptr ? nullptr : caller->stop();
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    Budget budget({}, stop);
    budget.spend(0, 0);
    task(k);
  });
}

}  // namespace pfaff
