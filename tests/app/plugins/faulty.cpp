// Plug-ins with faults of every kind that the program meets once they are loaded: each must be named, and
// none may end the program otherwise than by a message.
#include <stdexcept>
#include <type_traits>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct Odd {};  // thrown, and no std::exception

SystemDescriptor described(const char* name, const char* title, const char* reference = "su-qin (6)") {
  return {.name = name,
          .title = title,
          .reference = reference,
          .coordinates = {{"q", "m"}, {"p", "kg m/s"}},
          .initial = {1, 0}};
}

struct Oscillator {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
  }
};
// One momentum, and a second one is read.
struct ReadsPast {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
};
// An index far from the array.
struct ReadsFarAway {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[static_cast<std::size_t>(-1)];
    rate[1] = z[100000000];
  }
};
// The last of the arguments before t0, which stands behind them on the tape.
struct ReadsItsNeighbour : Oscillator {
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    z[0] = z0[0] * cos(elapsed) + z0[1] * sin(elapsed);
    z[1] = z0[2];
  }
};
struct WritesFarAway {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = rate[100000000] = -z[0];
  }
};
struct ThrowsWhileRecorded {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> /*rate*/) const {
    throw Odd{};
  }
};
struct ThrowsWhenCompiled {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    if constexpr (std::is_same_v<T, double>)
      if (t > 0.25) throw std::runtime_error("no formula after a quarter");
    rate[0] = z[1] + t - t;
    rate[1] = -z[0];
  }
};

const System<ReadsPast> reads_past{described("reads-past", "reads p[1]")};
const System<ReadsFarAway> reads_far_away{described("reads-far-away", "reads z[-1]")};
const System<ReadsItsNeighbour> reads_its_neighbour{described("reads-its-neighbour", "reads z0[2]")};
const System<WritesFarAway> writes_far_away{described("writes-far-away", "writes rate[100000000]")};
const System<ThrowsWhileRecorded> throws_while_recorded{described("throws-while-recorded", "throws")};
const System<ThrowsWhenCompiled> throws_when_compiled{described("throws-when-compiled", "throws later")};
const System<Oscillator> coloured{described("coloured",
                                            "\033[31mred\033[0m, \007\xC2\x9B"
                                            "2J and \x80 more")};
const System<Oscillator> uncited{described("uncited", "cites nobody", "nobody (1)")};

SystemDescriptor too_long() {
  SystemDescriptor d = described("too-long", "lists three numbers");
  d.initial = {1, 0, 0};
  return d;
}
const System<Oscillator> lists_too_many{too_long()};
}  // namespace
