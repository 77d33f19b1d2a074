// What the author of a system includes: the formula vocabulary and the registration object System<S>.
//
// S is a struct in an anonymous namespace with `dimension` (static constexpr int, or a member function), Real
// members for its parameters, and any of these templates over the scalar T (t: time, z: state):
//   field(t, z, rate)                        dz/dt
//   kinetic(t, p), potential(t, q)           canonical separable H = T + V; optional force(t, q, f),
//   velocity(t, p, v) hamiltonian(t, z), bracket()             H and the bracket that makes the field
//   (canonical without bracket()) birkhoffian(t, z), one_form(t, z, F)     the action form F.dz - B dt
//   chart(t, z, y), chart_inverse(t, y, z)   Darboux coordinates; optional chart_hamiltonian(t, y). Derived
//                                            where K = dF is constant or depends on t alone
//   invariants(t, z, values)                 in the order of the descriptor's list
//   exact_solution(elapsed, t0, z0, z)       the flow
//   initial(z)                               instead of the descriptor's list, when it depends on parameters
// Whatever is not written is derived; whatever could be derived but is written is checked against the
// derivation.
#pragma once

#include <memory>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/registry/plugin.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// What is said about a system, once.
struct SystemDescriptor {
  std::string name;       // kebab-case
  std::string title;      // one line with the equation of motion
  std::string reference;  // bib key and equations
  std::vector<Coordinate> coordinates{};
  std::vector<Real> initial{};
  std::vector<Invariant> invariants{};
  std::string time_unit = "s";
};

/// A registered system.
class SystemPlugin : public Plugin {
 public:
  SystemPlugin(SystemDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
               const std::source_location& where)
      : Plugin(descriptor.name, std::move(parameters), type, where), descriptor_(std::move(descriptor)) {}
  [[nodiscard]] const SystemDescriptor& descriptor() const { return descriptor_; }
  /// A model with these parameters; the rest keep their defaults. InputError for wrong assignments.
  [[nodiscard]] virtual std::shared_ptr<const Model> make(const Assignments& assignments) const = 0;

 private:
  SystemDescriptor descriptor_;
};

namespace detail {

using RecordedIn = std::span<const Recorded>;
using RecordedOut = std::span<Recorded>;

template <class S>
int dimension_of(const S& s) {
  if constexpr (requires { s.dimension(); }) {
    return s.dimension();
  } else {
    return S::dimension;
  }
}

/// Collects the formulas of one author's object.
template <class S>
class Collector {
 public:
  Collector(std::shared_ptr<const S> system, ModelSource& source)
      : system_(std::move(system)), source_(source) {
    source_.system = system_;
  }

  void collect() {
    using R = Recorded;
    const S& s = *system_;
    const int n = source_.dimension;
    if constexpr (requires(const R& t, RecordedIn z, RecordedOut o) { s.field(t, z, o); }) {
      give(Formula::field, n, n, [&](const R& t, RecordedIn z, RecordedOut o) { s.field(t, z, o); });
      compile(Formula::field, [](const void* p, const double& t, const double* z, double* o) {
        const S& self = *static_cast<const S*>(p);
        const auto m = static_cast<std::size_t>(dimension_of(self));
        self.field(t, In<double>(z, m), Out<double>(o, m));
      });
    }
    if constexpr (requires(const R& t, RecordedIn z) {
                    s.potential(t, z);
                    s.kinetic(t, z);
                  }) {
      source_.canonical = true;
      give(Formula::kinetic, n / 2, 1,
           [&](const R& t, RecordedIn p, RecordedOut o) { o[0] = s.kinetic(t, p); });
      give(Formula::potential, n / 2, 1,
           [&](const R& t, RecordedIn q, RecordedOut o) { o[0] = s.potential(t, q); });
      if constexpr (requires(const R& t, RecordedIn q, RecordedOut o) { s.force(t, q, o); }) {
        give(Formula::force, n / 2, n / 2,
             [&](const R& t, RecordedIn q, RecordedOut o) { s.force(t, q, o); });
        compile(Formula::force, [](const void* object, const double& t, const double* q, double* o) {
          const S& self = *static_cast<const S*>(object);
          const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
          self.force(t, In<double>(q, m), Out<double>(o, m));
        });
      }
      if constexpr (requires(const R& t, RecordedIn p, RecordedOut o) { s.velocity(t, p, o); }) {
        give(Formula::velocity, n / 2, n / 2,
             [&](const R& t, RecordedIn p, RecordedOut o) { s.velocity(t, p, o); });
        compile(Formula::velocity, [](const void* object, const double& t, const double* p, double* o) {
          const S& self = *static_cast<const S*>(object);
          const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
          self.velocity(t, In<double>(p, m), Out<double>(o, m));
        });
        if constexpr (requires(RecordedOut o) { s.force(R(), RecordedIn(), o); })
          compile(Formula::field, [](const void* object, const double& t, const double* z, double* o) {
            const S& self = *static_cast<const S*>(object);
            const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
            self.velocity(t, In<double>(z + m, m), Out<double>(o, m));
            self.force(t, In<double>(z, m), Out<double>(o + m, m));
          });
      }
    }
    if constexpr (requires(const R& t, RecordedIn z) { s.hamiltonian(t, z); }) {
      give(Formula::hamiltonian, n, 1,
           [&](const R& t, RecordedIn z, RecordedOut o) { o[0] = s.hamiltonian(t, z); });
      if constexpr (requires { s.bracket(); }) {
        const auto bracket = s.bracket();
        give(Formula::poisson_tensor, n, n * n, [&](const R& t, RecordedIn z, RecordedOut o) {
          const std::size_t size = z.size();
          std::vector<R> covector(size), column(size);
          for (std::size_t j = 0; j < size; ++j) {
            covector.assign(size, R(0));
            covector[j] = R(1);
            bracket.sharp(t, z, RecordedIn(covector), RecordedOut(column));
            for (std::size_t i = 0; i < size; ++i) o[i * size + j] = column[i];
          }
        });
      } else {
        source_.canonical = true;
      }
    }
    if constexpr (requires(const R& t, RecordedIn z, RecordedOut o) {
                    s.birkhoffian(t, z);
                    s.one_form(t, z, o);
                  }) {
      give(Formula::birkhoffian, n, 1,
           [&](const R& t, RecordedIn z, RecordedOut o) { o[0] = s.birkhoffian(t, z); });
      give(Formula::one_form, n, n, [&](const R& t, RecordedIn z, RecordedOut o) { s.one_form(t, z, o); });
    }
    if constexpr (requires(const R& t, RecordedIn z, RecordedOut o) {
                    s.chart(t, z, o);
                    s.chart_inverse(t, z, o);
                  }) {
      give(Formula::chart, n, n, [&](const R& t, RecordedIn z, RecordedOut o) { s.chart(t, z, o); });
      give(Formula::chart_inverse, n, n,
           [&](const R& t, RecordedIn y, RecordedOut o) { s.chart_inverse(t, y, o); });
    }
    if constexpr (requires(const R& t, RecordedIn y) { s.chart_hamiltonian(t, y); })
      give(Formula::chart_hamiltonian, n, 1,
           [&](const R& t, RecordedIn y, RecordedOut o) { o[0] = s.chart_hamiltonian(t, y); });
    if constexpr (requires(const R& t, RecordedIn z, RecordedOut o) { s.invariants(t, z, o); })
      give(Formula::invariants, n, static_cast<int>(source_.invariants.size()),
           [&](const R& t, RecordedIn z, RecordedOut o) { s.invariants(t, z, o); });
    if constexpr (requires(const R& t, RecordedIn z, RecordedOut o) { s.exact_solution(t, t, z, o); })
      give(Formula::exact_solution, n + 1, n, [&](const R& elapsed, RecordedIn z, RecordedOut o) {
        s.exact_solution(elapsed, z[z.size() - 1], z.first(z.size() - 1), o);
      });
    if constexpr (requires(RecordedOut o) { s.template initial<R>(o); }) {
      std::vector<R> start(static_cast<std::size_t>(n));
      s.template initial<R>(RecordedOut(start));
      source_.initial.clear();
      for (const R& x : start) source_.initial.push_back(x.constant());
    }
  }

 private:
  template <class F>
  void give(Formula formula, int inputs, int outputs, F&& f) {
    source_.given[index(formula)] = std::make_shared<const Tape>(record(inputs, outputs, f));
  }
  void compile(Formula formula, CompiledFormula f) { source_.compiled[index(formula)] = f; }

  std::shared_ptr<const S> system_;
  ModelSource& source_;
};

}  // namespace detail

/// A model of an author's object (what System<S>::make does, for objects made in a program).
template <class S>
std::shared_ptr<const Model> make_model(const SystemDescriptor& descriptor, const S& object) {
  auto system = std::make_shared<const S>(object);
  ModelSource source;
  source.name = descriptor.name;
  source.dimension = detail::dimension_of(*system);
  source.coordinates = descriptor.coordinates;
  if constexpr (requires { system->coordinates(); }) source.coordinates = system->coordinates();
  source.invariants = descriptor.invariants;
  source.initial = descriptor.initial;
  source.time_unit = descriptor.time_unit;
  source.parameters = resolved(parameters_of<S>(), system.get());
  detail::Collector<S>(system, source).collect();
  return std::make_shared<const Model>(std::move(source));
}

/// Registers S when the library that holds it is loaded.
template <class S>
class System final : public SystemPlugin {
 public:
  explicit System(SystemDescriptor descriptor,
                  const std::source_location& where = std::source_location::current())
      : SystemPlugin(std::move(descriptor), parameters_of<S>(), typeid(S), where) {
    systems().add(this);
  }
  [[nodiscard]] std::shared_ptr<const Model> make(const Assignments& assignments) const override {
    S object;
    assign_all(parameters(), &object, assignments, "system " + name());
    return make_model(descriptor(), object);
  }
};

}  // namespace pfaff
