#pragma once

namespace pfaff::app {

/// Asks for the first 64 megabytes of the heap in large pages where the system offers them to programs that
/// ask (Linux, transparent huge pages `madvise`), and lets the heap keep what is given back to it. A tape of
/// a hundred thousand operations touches several thousand small pages for the first time, which on a virtual
/// machine took longer than recording them.
void use_large_pages();

}  // namespace pfaff::app
