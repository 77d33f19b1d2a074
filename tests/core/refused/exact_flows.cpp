// Systems with parts that the compiler must refuse. Each comment `refused:` is the beginning of a message it
// must give.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Spring {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
};
// refused: part_flow: expected template <class T> Status part_flow(std::size_t part, const T& h, In<T>
struct WithoutStatus : Spring {
  static constexpr int part_count = 1;
  template <class T>
  void part_flow(std::size_t /*part*/, const T& h, In<T> z, Out<T> change) const {
    change[0] = h * z[1];
  }
};
// refused: part_flow belongs together with part_count, which is missing: a static constexpr int or a member
struct NotCounted : Spring {
  template <class T>
  Status part_flow(std::size_t /*part*/, const T& h, In<T> z, Out<T> change) const {
    change[0] = h * z[1];
    return Status::converged;
  }
};
// refused: small_part is written beside part_flow, which is missing
struct SmallPartAlone : Spring {
  static constexpr std::size_t small_part = 1;
};

const SystemDescriptor descriptor{.name = "refused", .title = "", .reference = ""};
const auto models = {make_model(descriptor, WithoutStatus{}), make_model(descriptor, NotCounted{}),
                     make_model(descriptor, SmallPartAlone{})};
}  // namespace
