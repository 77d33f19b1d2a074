// What the author of a bracket structure includes: registration object Bracket<B>.
//
// B is a struct in an anonymous namespace with `dimension` (static constexpr int or member function),
// optional parameters, and
//   template <class T> void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const;
// which writes Pi(z, t) covector, and, where it claims Casimirs, casimir_count() and casimirs(t, z, values).
// One of these names with another signature is refused by the compiler, which says what was expected.
#pragma once

#include <concepts>
#include <memory>

#include <pfaff/core/registry/optional_member.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

enum class Symmetry { skew, symmetric, none };

constexpr std::string_view to_string(Symmetry symmetry) {
  return symmetry == Symmetry::skew ? "skew" : symmetry == Symmetry::symmetric ? "symmetric" : "none";
}

/// What is said, and claimed, about a bracket.
struct BracketDescriptor {
  std::string name;
  std::string title;
  std::string reference;
  std::string description{};  // two to four sentences: what it is, when to take it, where it ends
  Symmetry symmetry = Symmetry::skew;
  bool jacobi = true;       // claims the Jacobi identity
  bool semimetric = false;  // claims <f, f> >= 0
  /// Where each coordinate has to be for what is claimed, as {0, inf} says for a size; empty: anywhere.
  std::vector<Range> ranges{};
};

/// A bracket with its parameters fixed: its sharp map as a tape of (z, covector), 2 n inputs, n outputs.
struct BracketInstance {
  int dimension = 0;
  Assignments parameters;
  std::shared_ptr<const Tape> sharp;
  std::shared_ptr<const Tape> casimirs;  // null where none are claimed
  /// Where each coordinate states that what is claimed holds; empty where none does.
  std::vector<Range> ranges{};
};

/// A registered bracket.
class BracketPlugin : public Plugin {
 public:
  BracketPlugin(BracketDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
                const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const BracketDescriptor& descriptor() const { return descriptor_; }
  [[nodiscard]] virtual BracketInstance make(const Assignments& assignments) const = 0;

 private:
  BracketDescriptor descriptor_;
};

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace detail::bracket {
// clang-format off
PFAFF_OPTIONAL_MEMBER(casimir_count, "int casimir_count() const", (const S& s) { { s.casimir_count() } -> std::convertible_to<int>; })
PFAFF_OPTIONAL_MEMBER(casimirs, "template <class T> void casimirs(const T& t, In<T> z, Out<T> values) const",
                      (const S& s, const Recorded& t, In<Recorded> z, Out<Recorded> values) { s.casimirs(t, z, values); })
// clang-format on
}  // namespace detail::bracket

namespace detail {

template <class B>
concept WritesSharp = requires(const B& b, const Recorded& t, In<Recorded> z, Out<Recorded> vector) {
  b.sharp(t, z, z, vector);
};
template <class B>
concept WritesDimension = requires(const B& b) {
  { b.dimension() } -> std::convertible_to<int>;
}
|| requires {
  { B::dimension } -> std::convertible_to<int>;
};
/// Refuses, while B is compiled, a struct that is no bracket, and members that bear the name of an optional
/// one and cannot be used as one.
template <class B>
constexpr void check_bracket_members() {
  static_assert(WritesSharp<B>,
                "sharp: expected template <class T> void sharp(const T& t, In<T> z, In<T> covector, Out<T> "
                "vector) const");
  static_assert(WritesDimension<B>,
                "dimension: expected static constexpr int dimension or int dimension() const");
  bracket::check_casimir_count<B>(), bracket::check_casimirs<B>();
  static_assert(bracket::has_casimir_count<B> == bracket::has_casimirs<B>,
                "casimir_count and casimirs belong together: one of them is missing");
}

}  // namespace detail

/// Records the sharp map of a bracket object.
template <class B>
std::shared_ptr<const Tape> sharp_tape(const B& bracket, int dimension) {
  return std::make_shared<const Tape>(
      record(2 * dimension, dimension, [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
        const auto n = static_cast<std::size_t>(dimension);
        bracket.sharp(t, x.first(n), x.subspan(n), out);
      }));
}

/// Registers B when the library that holds it is loaded.
template <class B>
class Bracket final : public BracketPlugin {
 public:
  explicit Bracket(BracketDescriptor descriptor,
                   const std::source_location& where = std::source_location::current())
      : BracketPlugin(std::move(descriptor), parameters_of<B>(), typeid(B), where) {
    detail::check_bracket_members<B>();
    brackets().add(this);
  }
  [[nodiscard]] BracketInstance make(const Assignments& assignments) const override {
    return on_behalf_of("bracket " + name(), [&] {
      B object;
      assign_all(parameters(), &object, assignments, "bracket " + name());
      int dimension = 0;
      if constexpr (requires { object.dimension(); }) {
        dimension = object.dimension();
      } else {
        dimension = B::dimension;
      }
      BracketInstance instance{
          dimension, resolved(parameters(), &object), sharp_tape(object, dimension), {}, descriptor().ranges};
      if (!instance.ranges.empty() && instance.ranges.size() != static_cast<std::size_t>(dimension))
        throw InputError("bracket " + name() + ": expected a range for each of its " +
                         std::to_string(dimension) + " coordinates, got " +
                         std::to_string(instance.ranges.size()));
      if constexpr (requires { object.casimir_count(); })
        instance.casimirs = std::make_shared<const Tape>(record(
            dimension, object.casimir_count(),
            [&](const Recorded& t, In<Recorded> z, Out<Recorded> values) { object.casimirs(t, z, values); }));
      return instance;
    });
  }
};

}  // namespace pfaff
