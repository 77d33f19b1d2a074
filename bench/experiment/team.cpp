#include <pfaff/bench/experiment/team.hpp>

#include <mutex>

#include <pfaff/bench/runner/parallel.hpp>

namespace pfaff {

void ThisProcess::share(std::size_t count, const std::function<bool(std::size_t)>& make,
                        const std::function<void(std::size_t)>& done) {
  std::mutex mutex;
  in_parallel(count, [&](std::size_t k) {
    if (!make(k)) return;
    const std::lock_guard lock(mutex);
    done(k);
  });
}

}  // namespace pfaff
