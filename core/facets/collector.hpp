// Collects the formulas that a system's struct writes into the source of a model.
//
// Every formula is taken in the same way, as its row says (core/facets/formula_rows.hpp): it is recorded, or
// made a program where the system is batched; what is also kept compiled for doubles is in
// formulas_in_double.hpp. Only what follows from several formulas together, such as H = T + V, is collected
// by hand.
#pragma once

#include <algorithm>
#include <memory>

#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/core/facets/formulas_in_double.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/system_formulas.hpp>

namespace pfaff::detail {

/// True for systems whose formulas are compiled for every scalar and recorded only when a tape is asked for
/// (`static constexpr bool batched = true`): those of many bodies.
template <class S>
constexpr bool is_batched() {
  if constexpr (requires { S::batched; }) return S::batched;
  return false;
}

/// A formula as the function object f(system, t, arguments, results).
template <Formula F>
struct FormulaObject {
  template <class S, class T>
  static constexpr bool written = writes<S, F, T>;
  template <class S, class T>
  void operator()(const S& system, const T& t, In<T> x, Out<T> out) const {
    write<F>(system, t, x, out);
  }
};
/// H = T + V as one.
struct EnergyObject {
  template <class S, class T>
  static constexpr bool written = writes<S, Formula::kinetic, T>&& writes<S, Formula::potential, T>;
  template <class S, class T>
  void operator()(const S& system, const T& t, In<T> z, Out<T> out) const {
    const std::size_t half = z.size() / 2;
    out[0] = system.kinetic(t, z.subspan(half)) + system.potential(t, z.first(half));
  }
};

/// A formula f(system, t, arguments, results) as a program. Where a system has prepared<T>(), an object with
/// the same formulas that keeps what does not change in the scalar T, every evaluator has one of its own; in
/// packs too, where fits_lanes() of the system says that it may.
template <class S, class F>
struct BatchedFormula {
  std::shared_ptr<const S> system;
  F formula;
  FormulaSize size;
  template <class T>
  static constexpr bool prepared = requires(const S& s) {
    requires F::template written<decltype(s.template prepared<T>()), T>;
  };
  static constexpr bool in_lanes = prepared<Pack<8>>;
  [[nodiscard]] bool fits_lanes() const { return system->fits_lanes(); }
  [[nodiscard]] int inputs() const { return size.inputs; }
  [[nodiscard]] int outputs() const { return size.outputs; }
  template <class T>
  [[nodiscard]] auto make() const {
    if constexpr (prepared<T>)
      return [own = system->template prepared<T>(), f = formula](const T& t, In<T> x, Out<T> out) {
        f(own, t, x, out);
      };
    else
      return [self = system, f = formula](const T& t, In<T> x, Out<T> out) { f(*self, t, x, out); };
  }
};

/// An author's formula to be recorded, and the object to call it with.
struct RecordedFormula {
  void (*call)(const void* system, const Recorded& t, In<Recorded> x, Out<Recorded> out);
  const void* system;
};
/// Records a formula into `source`; InputError, naming the system, where it writes more or fewer results than
/// its row says.
void record_into(ModelSource& source, Formula formula, FormulaSize size, const RecordedFormula& written);
/// Records the initial state, which start(system, z) writes, in the same way.
void record_initial(ModelSource& source, void (*start)(const void* system, Out<Recorded> z),
                    const void* system);
/// InputError where the descriptor lists results of this formula, which the author did not write.
void require_no_list(const ModelSource& source, Formula formula);

/// Collects the formulas of one author's object.
template <class S>
class Collector {
 public:
  Collector(std::shared_ptr<const S> system, ModelSource& source)
      : system_(std::move(system)), source_(source) {
    source_.system = system_;
  }

  void collect() {
    check_formulas<S>();
    using enum Formula;
    const S& s = *system_;
    sizes_.n = source_.dimension;
    sizes_.invariants = static_cast<int>(source_.invariants.size());
    if constexpr (writes<S, casimirs>) sizes_.casimirs = s.bracket().casimir_count();
#define PFAFF_COUNT(name, member, names, ...) \
  if constexpr (counts_##name<S>) {           \
    sizes_.name = count_of_##name(s);         \
    source_.names = names_of_##name(s);       \
  }
#define PFAFF_FORMULA(name, ...) take<name>();
#define PFAFF_BRACKET(name, ...) take<name>();
#include <pfaff/core/facets/formula_rows.hpp>

    constexpr FormulaMembers has = energy_members<S>();
    if constexpr (has.conformal()) source_.damping = s.damping();
    source_.canonical = has.canonical();
    if constexpr (has.energies() && is_batched<S>())
      program(hamiltonian, {source_.dimension, 1}, EnergyObject());
    if constexpr (WritesConstraintEvaluator<S>)
      source_.holonomic = std::make_shared<const HolonomicFactoryOf<S>>(system_);
    // A part count of zero means that with these parameters there are no parts to be solved exactly.
    if constexpr (WritesPartFlow<S>)
      if (sizes_.parts > 0) {
        source_.flows = std::make_shared<const ExactFlowsFactoryOf<S>>(system_);
        if constexpr (WritesSmallPart<S>) source_.small_part = S::small_part;
      }
    const FormulasInDouble in_double = formulas_in_double<S>();
    source_.compiled = in_double.code;
    source_.chart_field_series = in_double.chart_field_series;
    if constexpr (WritesInitial<S>)
      record_initial(
          source_,
          [](const void* object, Out<Recorded> z) {
            static_cast<const S*>(object)->template initial<Recorded>(z);
          },
          system_.get());
  }

  /// What the two units that compile S leave each other.
  static void leave_code() {
    if constexpr (is_batched<S>()) {
      using enum Formula;
#define PFAFF_COUNT(...)
#define PFAFF_FORMULA(name, ...) \
  if constexpr (writes<S, name>) Program<BatchedFormula<S, FormulaObject<name>>>::leave_code();
#define PFAFF_BRACKET(name, ...) PFAFF_FORMULA(name)
#include <pfaff/core/facets/formula_rows.hpp>
      if constexpr (energy_members<S>().energies()) Program<BatchedFormula<S, EnergyObject>>::leave_code();
    }
    if constexpr (WritesConstraintEvaluator<S>) leave_code_of<HolonomicFactoryOf<S>>();
    if constexpr (WritesPartFlow<S>) leave_code_of<ExactFlowsFactoryOf<S>>();
    if constexpr (std::is_same_v<ThisUnit, InDouble>) leave<S, double>(&formulas_in_double<S>);
  }

 private:
  // Records one formula or makes a program of it.
  template <Formula F>
  void take() {
    if constexpr (writes<S, F>) {
      const FormulaSize size = size_of<F>(sizes_);
      if (size.outputs == 0 && row_of(F).origin == Origin::bracket) return;  // no Casimirs
      if constexpr (is_batched<S>()) {
        program(F, size, FormulaObject<F>());
      } else {
        record_into(source_, F, size,
                    {[](const void* object, const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                       write<F>(*static_cast<const S*>(object), t, x, out);
                     },
                     system_.get()});
      }
    } else if constexpr (row_of(F).traits.listed) {
      require_no_list(source_, F);
    }
  }
  template <class F>
  void program(Formula formula, FormulaSize size, F f) {
    source_.programs[index(formula)] =
        std::make_shared<const Program<BatchedFormula<S, F>>>(BatchedFormula<S, F>{system_, f, size});
  }

  std::shared_ptr<const S> system_;
  ModelSource& source_;
  Sizes sizes_;
};

}  // namespace pfaff::detail
