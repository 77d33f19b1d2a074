#include <pfaff/bench/experiment/team.hpp>

#include <oneapi/tbb/parallel_for.h>

#include <mutex>

namespace pfaff {

void ThisProcess::share(std::size_t count, const std::function<bool(std::size_t)>& make,
                        const std::function<void(std::size_t)>& done) {
  std::mutex mutex;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    if (!make(k)) return;
    const std::lock_guard lock(mutex);
    done(k);
  });
}

}  // namespace pfaff
