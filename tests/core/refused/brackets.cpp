// Brackets that the compiler must refuse. Each comment `refused:` is the beginning of a message it must give.
#include <pfaff/core/bracket.hpp>

namespace {
using namespace pfaff;

// What is sound of them.
struct Plane {
  static constexpr int dimension = 2;
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    vector[0] = covector[1];
    vector[1] = -covector[0];
  }
};

// refused: sharp: expected template <class T> void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector)
// const
struct SharpWithoutTime {
  static constexpr int dimension = 2;
  template <class T>
  void sharp(In<T> /*z*/, In<T> covector, Out<T> vector) const {
    vector[0] = covector[1];
    vector[1] = -covector[0];
  }
};
// refused: dimension: expected static constexpr int dimension or int dimension() const
struct DimensionByName {
  [[nodiscard]] static const char* dimension() { return "two"; }
  template <class T>
  void sharp(const T& /*t*/, In<T> /*z*/, In<T> covector, Out<T> vector) const {
    vector[0] = covector[1];
    vector[1] = -covector[0];
  }
};
// refused: casimir_count: expected int casimir_count() const
struct CasimirCountAsData : Plane {
  static constexpr int casimir_count = 1;
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[0];
  }
};
// refused: casimirs: expected template <class T> void casimirs(const T& t, In<T> z, Out<T> values) const
struct CasimirsReturned : Plane {
  [[nodiscard]] int casimir_count() const { return 1; }
  template <class T>
  T casimirs(const T& /*t*/, In<T> z) const {
    return z[0];
  }
};
// refused: casimir_count and casimirs belong together: one of them is missing
struct NoCount : Plane {
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[0];
  }
};
// refused: parameters: expected static std::vector<Parameter> parameters()
struct ParametersAsData : Plane {
  std::vector<Parameter> parameters;
};

template <class B>
const Bracket<B> registered{{.name = "refused", .title = "", .reference = ""}};
const BracketPlugin* const all[] = {
    &registered<SharpWithoutTime>, &registered<DimensionByName>, &registered<CasimirCountAsData>,
    &registered<CasimirsReturned>, &registered<NoCount>,         &registered<ParametersAsData>};
}  // namespace
