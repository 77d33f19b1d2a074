// The formulas of a system that are kept compiled for doubles: what its author writes of the rows that ask
// for it (core/facets/formula_rows.hpp), and what follows from several of them together.
#pragma once

#include <algorithm>
#include <array>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/scalar_units.hpp>
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

struct FormulasInDouble {
  std::array<CompiledCode, formula_count> code{};
  const CompiledSeries* chart_field_series = nullptr;
};

/// Collects what is compiled of one author's struct.
template <class S>
class CollectorInDouble {
 public:
  static FormulasInDouble collect() {
    using enum Formula;
    CollectorInDouble c;
#define PFAFF_COUNT(...)
#define PFAFF_FORMULA(name, ...) c.template take<name>();
#define PFAFF_BRACKET(name, ...) c.template take<name>();
#include <pfaff/core/facets/formula_rows.hpp>
    // The field of the energy alone, which is not the motion where a second bracket or applied forces take
    // part.
    if constexpr (energy_members<S>().separable() && !writes<S, symmetric_tensor> &&
                  !writes<S, applied_force> && writes<S, force> && writes<S, velocity>)
      c.template compile<writes<S, force, Pack<8>> && writes<S, velocity, Pack<8>>>(
          field, []<class T>(const S& self, const T& t, const T* z, T* o) {
            const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
            self.velocity(t, In<T>(z + m, m), Out<T>(o, m));
            self.force(t, In<T>(z, m), Out<T>(o + m, m));
          });
    if constexpr (energy_members<S>().canonical() && !writes<S, chart>) c.compile_identity_chart();
    if constexpr (CompilesChartField<S> && (writes<S, chart_field> || !writes<S, chart>))
      c.compile_chart_field();
    return c.made_;
  }

 private:
  template <Formula F>
  void take() {
    if constexpr (writes<S, F> && row_of(F).traits.compiled)
      compile<row_of(F).traits.in_lanes && writes<S, F, Pack<8>>>(
          F, []<class T>(const S& self, const T& t, const T* x, T* out) {
            const FormulaSize m = size_of<F>(Sizes{.n = dimension_of(self)});
            write<F>(self, t, In<T>(x, static_cast<std::size_t>(m.inputs)),
                     Out<T>(out, static_cast<std::size_t>(m.outputs)));
          });
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
    made_.chart_field_series = &compiled_series<S>();
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
    CompiledCode& code = made_.code[index(formula)];
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

  FormulasInDouble made_;
};

/// What is compiled of S, by this unit or by the one that makes code in double.
template <class S>
FormulasInDouble formulas_in_double() {
  if constexpr (ThisUnit::makes<double>) {
    return CollectorInDouble<S>::collect();
  } else {
    return reinterpret_cast<FormulasInDouble (*)()>(code_left(typeid(S), typeid(double)))();  // NOLINT
  }
}

}  // namespace pfaff::detail
