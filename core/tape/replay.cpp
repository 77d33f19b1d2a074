#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

template class Replay<double>;
template class Replay<Quad>;

}  // namespace pfaff
