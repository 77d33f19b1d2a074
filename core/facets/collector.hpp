// Collects the formulas that a system's struct writes into the source of a model.
//
// Every formula is taken in the same way, as its row says (core/facets/formula_rows.hpp): it is recorded, or
// made a program where the system is batched, and also kept compiled for doubles where the row asks for it.
// Only what follows from several formulas together, such as H = T + V, is collected by hand.
#pragma once

#include <algorithm>
#include <memory>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/system_formulas.hpp>

namespace pfaff::detail {

template <class S>
int dimension_of(const S& s) {
  if constexpr (requires { s.dimension(); }) {
    return s.dimension();
  } else {
    return S::dimension;
  }
}

/// True for systems whose formulas are compiled for every scalar and recorded only when a tape is asked for
/// (`static constexpr bool batched = true`): those of many bodies.
template <class S>
constexpr bool is_batched() {
  if constexpr (requires { S::batched; }) return S::batched;
  return false;
}

/// A formula f(system, t, arguments, results) as a program.
template <class S, class F>
struct BatchedFormula {
  std::shared_ptr<const S> system;
  F formula;
  FormulaSize size;
  [[nodiscard]] int inputs() const { return size.inputs; }
  [[nodiscard]] int outputs() const { return size.outputs; }
  template <class T>
  [[nodiscard]] auto make() const {
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

    constexpr bool energies = writes<S, kinetic> && writes<S, potential>, damped = WritesDamping<S>;
    if constexpr (energies && damped) source_.damping = s.damping();
    source_.canonical = (energies && !damped) || (writes<S, hamiltonian> && !writes<S, poisson_tensor>);
    if constexpr (energies && is_batched<S>())
      program(hamiltonian, {source_.dimension, 1}, [](const S& self, const auto& t, auto z, auto out) {
        const std::size_t half = z.size() / 2;
        out[0] = self.kinetic(t, z.subspan(half)) + self.potential(t, z.first(half));
      });
    // The field of the energy alone, which is not the motion where a second bracket takes part.
    if constexpr (energies && !damped && !writes<S, symmetric_tensor> && writes<S, force> &&
                  writes<S, velocity>)
      compile<writes<S, force, Pack<8>> && writes<S, velocity, Pack<8>>>(
          field, []<class T>(const S& self, const T& t, const T* z, T* o) {
            const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
            self.velocity(t, In<T>(z + m, m), Out<T>(o, m));
            self.force(t, In<T>(z, m), Out<T>(o + m, m));
          });
    if constexpr (WritesConstraintEvaluator<S>)
      source_.holonomic = std::make_shared<const HolonomicFactoryOf<S>>(system_);
    // A part count of zero means that with these parameters there are no parts to be solved exactly.
    if constexpr (WritesPartFlow<S>)
      if (sizes_.parts > 0) {
        source_.flows = std::make_shared<const ExactFlowsFactoryOf<S>>(system_);
        if constexpr (WritesSmallPart<S>) source_.small_part = S::small_part;
      }
    if (source_.canonical && !writes<S, chart>) compile_identity_chart();
    if constexpr (CompilesChartField<S>)
      if (writes<S, chart_field> || !writes<S, chart>) compile_chart_field();
    if constexpr (WritesInitial<S>)
      record_initial(
          source_,
          [](const void* object, Out<Recorded> z) {
            static_cast<const S*>(object)->template initial<Recorded>(z);
          },
          system_.get());
  }

 private:
  // Records one formula or makes a program of it, and keeps its double version where the row asks for it.
  template <Formula F>
  void take() {
    if constexpr (writes<S, F>) {
      const FormulaSize size = size_of<F>(sizes_);
      if (size.outputs == 0 && row_of(F).origin == Origin::bracket) return;  // no Casimirs
      if constexpr (is_batched<S>()) {
        program(F, size, [](const S& self, const auto& t, auto x, auto out) { write<F>(self, t, x, out); });
      } else {
        record_into(source_, F, size,
                    {[](const void* object, const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                       write<F>(*static_cast<const S*>(object), t, x, out);
                     },
                     system_.get()});
      }
      if constexpr (row_of(F).traits.compiled)
        compile<row_of(F).traits.in_lanes && writes<S, F, Pack<8>>>(
            F, []<class T>(const S& self, const T& t, const T* x, T* out) {
              const FormulaSize m = size_of<F>(Sizes{.n = dimension_of(self)});
              write<F>(self, t, In<T>(x, static_cast<std::size_t>(m.inputs)),
                       Out<T>(out, static_cast<std::size_t>(m.outputs)));
            });
    } else if constexpr (row_of(F).traits.listed) {
      require_no_list(source_, F);
    }
  }
  template <class F>
  void program(Formula formula, FormulaSize size, F f) {
    source_.programs[index(formula)] =
        std::make_shared<const Program<BatchedFormula<S, F>>>(BatchedFormula<S, F>{system_, f, size});
  }
  // Canonical coordinates are Darboux coordinates already: the chart copies them.
  void compile_identity_chart() {
    const auto copy = []<class T>(const S& self, const T& /*t*/, const T* from, T* to) {
      std::copy_n(from, static_cast<std::size_t>(dimension_of(self)), to);
    };
    compile<false>(Formula::chart, copy);
    compile<false>(Formula::chart_inverse, copy);
  }
  void compile_chart_field() requires CompilesChartField<S> {
    source_.chart_field_series = &compiled_series<S>();
    using Lanes = Pack<8>;
    constexpr bool in_lanes = writes<S, Formula::chart_field>
                                  ? writes<S, Formula::chart_field, Lanes>
                                  : writes<S, Formula::force, Lanes> && writes<S, Formula::velocity, Lanes>;
    compile<in_lanes>(Formula::chart_field, []<class T>(const S& self, const T& t, const T* y, T* rate) {
      constexpr auto size = static_cast<std::size_t>(S::dimension);
      chart_field_of<S, T>(self, t, In<T>(y, size), Out<T>(rate, size));
    });
    if constexpr (S::dimension <= 6)  // all columns in one pass of duals; for larger n the tape is as fast
      compile<false>(Formula::chart_field_jacobian,
                     [](const S& self, const double& t, const double* y, double* matrix) {
                       constexpr auto size = static_cast<std::size_t>(S::dimension);
                       using D = Dual<double, S::dimension>;
                       std::array<D, size> point, rate;
                       for (std::size_t k = 0; k < size; ++k)
                         point[k] = D::variable(y[k], static_cast<int>(k));
                       chart_field_of<S, D>(self, D(t), point, rate);
                       for (std::size_t i = 0; i < size; ++i)
                         for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] = rate[i].derivative[j];
                     });
  }
  // Keeps the code of call(system, t, arguments, results) for doubles and, where `InLanes`, for packs.
  template <bool InLanes, class Call>
  void compile(Formula formula, const Call& /*call*/) {
    CompiledCode& code = source_.compiled[index(formula)];
    code.one = &run<double, Call>;
    if constexpr (InLanes) {
      code.four = &run<Pack<4>, Call>;
      code.eight = &run<Pack<8>, Call>;
    }
  }
  template <class T, class Call>
  static void run(const void* system, const T& t, const T* arguments, T* results) {
    Call()(*static_cast<const S*>(system), t, arguments, results);
  }

  std::shared_ptr<const S> system_;
  ModelSource& source_;
  Sizes sizes_;
};

}  // namespace pfaff::detail
