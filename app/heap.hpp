#pragma once

namespace pfaff::app {

/// Asks for the first 64 megabytes of the heap in large pages where the system offers them to programs that
/// ask (Linux, transparent huge pages `madvise`), and lets the heap keep what is given back to it. A tape of
/// a hundred thousand operations touches ten thousand small pages for the first time, which takes as long as
/// recording them, and in a virtual machine twice as long.
void use_large_pages();

}  // namespace pfaff::app
