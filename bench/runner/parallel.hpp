// Tasks on all cores of this machine.
#pragma once

#include <cstddef>
#include <functional>

namespace pfaff {

/// Calls task(0), ..., task(count - 1) on all cores, and returns when all have ended. A budget is of one
/// thread: each task gets its own, without limits, which ends where that of the caller is asked to stop. The
/// first exception of a task passes; no task begins after it.
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace pfaff
