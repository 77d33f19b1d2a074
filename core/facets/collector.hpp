// Collects the formulas that a system's struct writes into the source of a model.
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>

#include <pfaff/core/facets/compiled_series.hpp>
#include <pfaff/core/facets/generating_map.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/system_formulas.hpp>
#include <pfaff/core/registry/errors.hpp>
#include <pfaff/core/tape/counted_outputs.hpp>

namespace pfaff::detail {

using RecordedIn = In<Recorded>;
using RecordedOut = Out<Recorded>;

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

/// The formula f(system, t, arguments, results) as a program.
template <class S, class F>
struct BatchedFormula {
  std::shared_ptr<const S> system;
  F formula;
  int read, written;
  [[nodiscard]] int inputs() const { return read; }
  [[nodiscard]] int outputs() const { return written; }
  template <class T>
  [[nodiscard]] auto make() const {
    return [self = system, f = formula](const T& t, In<T> x, Out<T> out) { f(*self, t, x, out); };
  }
};

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
    using R = Recorded;
    const S& s = *system_;
    const int n = source_.dimension;
    if constexpr (WritesField<S>) {
      give(Formula::field, "field(t, z, rate)", n, n,
           [&](const R& t, RecordedIn z, RecordedOut o) { s.field(t, z, o); });
      compile(Formula::field, [](const void* p, const double& t, const double* z, double* o) {
        const S& self = *static_cast<const S*>(p);
        const auto m = static_cast<std::size_t>(dimension_of(self));
        self.field(t, In<double>(z, m), Out<double>(o, m));
      });
    }
    if constexpr (WritesKinetic<S> && WritesPotential<S>) {
      constexpr bool damped = WritesDamping<S>;
      if constexpr (damped) source_.damping = s.damping();
      source_.canonical = !damped;
      offer(Formula::kinetic, "kinetic(t, p)", n / 2, 1,
            [](const S& self, const auto& t, auto p, auto out) { out[0] = self.kinetic(t, p); });
      offer(Formula::potential, "potential(t, q)", n / 2, 1,
            [](const S& self, const auto& t, auto q, auto out) { out[0] = self.potential(t, q); });
      if constexpr (is_batched<S>())
        offer(Formula::hamiltonian, "kinetic and potential", n, 1,
              [](const S& self, const auto& t, auto z, auto out) {
                const std::size_t half = z.size() / 2;
                out[0] = self.kinetic(t, z.subspan(half)) + self.potential(t, z.first(half));
              });
      if constexpr (WritesForce<S>) {
        give(Formula::force, "force(t, q, f)", n / 2, n / 2,
             [&](const R& t, RecordedIn q, RecordedOut o) { s.force(t, q, o); });
        compile(Formula::force, [](const void* object, const double& t, const double* q, double* o) {
          const S& self = *static_cast<const S*>(object);
          const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
          self.force(t, In<double>(q, m), Out<double>(o, m));
        });
      }
      if constexpr (WritesVelocity<S>) {
        give(Formula::velocity, "velocity(t, p, v)", n / 2, n / 2,
             [&](const R& t, RecordedIn p, RecordedOut o) { s.velocity(t, p, o); });
        compile(Formula::velocity, [](const void* object, const double& t, const double* p, double* o) {
          const S& self = *static_cast<const S*>(object);
          const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
          self.velocity(t, In<double>(p, m), Out<double>(o, m));
        });
        if constexpr (!damped && WritesForce<S>)
          compile(Formula::field, [](const void* object, const double& t, const double* z, double* o) {
            const S& self = *static_cast<const S*>(object);
            const auto m = static_cast<std::size_t>(dimension_of(self) / 2);
            self.velocity(t, In<double>(z + m, m), Out<double>(o, m));
            self.force(t, In<double>(z, m), Out<double>(o + m, m));
          });
      }
    }
    if constexpr (WritesHamiltonian<S>) {
      give(Formula::hamiltonian, n, [&](const R& t, RecordedIn z) { return s.hamiltonian(t, z); });
      if constexpr (WritesBracket<S>) {
        give_tensor(Formula::poisson_tensor, "bracket()", s.bracket());
      } else {
        source_.canonical = true;
      }
    }
    if constexpr (WritesSymmetricBracket<S>)
      give_tensor(Formula::symmetric_tensor, "symmetric_bracket()", s.symmetric_bracket());
    if constexpr (WritesEntropy<S>)
      give(Formula::entropy, n, [&](const R& t, RecordedIn z) { return s.entropy(t, z); });
    collect_constraints();
    if constexpr (WritesBirkhoffian<S> && WritesOneForm<S>) {
      give(Formula::birkhoffian, n, [&](const R& t, RecordedIn z) { return s.birkhoffian(t, z); });
      give(Formula::one_form, "one_form(t, z, F)", n, n,
           [&](const R& t, RecordedIn z, RecordedOut o) { s.one_form(t, z, o); });
    }
    if constexpr (WritesStructure<S> && WritesCovector<S>) {
      give(Formula::structure, "structure(t, z, K)", n, n * n,
           [&](const R& t, RecordedIn z, RecordedOut o) { s.structure(t, z, o); });
      give(Formula::covector, "covector(t, z, D)", n, n,
           [&](const R& t, RecordedIn z, RecordedOut o) { s.covector(t, z, o); });
    }
    if constexpr (WritesChart<S> && WritesChartInverse<S>) {
      give(Formula::chart, "chart(t, z, y)", n, n,
           [&](const R& t, RecordedIn z, RecordedOut o) { s.chart(t, z, o); });
      give(Formula::chart_inverse, "chart_inverse(t, y, z)", n, n,
           [&](const R& t, RecordedIn y, RecordedOut o) { s.chart_inverse(t, y, o); });
      compile(Formula::chart, [](const void* object, const double& t, const double* z, double* y) {
        const S& self = *static_cast<const S*>(object);
        const auto m = static_cast<std::size_t>(dimension_of(self));
        self.chart(t, In<double>(z, m), Out<double>(y, m));
      });
      compile(Formula::chart_inverse, [](const void* object, const double& t, const double* y, double* z) {
        const S& self = *static_cast<const S*>(object);
        const auto m = static_cast<std::size_t>(dimension_of(self));
        self.chart_inverse(t, In<double>(y, m), Out<double>(z, m));
      });
    }
    if (source_.canonical && source_.given[index(Formula::chart)] == nullptr) compile_identity_chart();
    if constexpr (WritesChartHamiltonian<S>)
      give(Formula::chart_hamiltonian, n,
           [&](const R& t, RecordedIn y) { return s.chart_hamiltonian(t, y); });
    if constexpr (WritesChartField<S>)
      give(Formula::chart_field, "chart_field(t, y, rate)", n, n,
           [&](const R& t, RecordedIn y, RecordedOut o) { s.chart_field(t, y, o); });
    if constexpr (CompilesChartField<S>)
      if (WritesChartField<S> || source_.given[index(Formula::chart)] == nullptr) compile_chart_field();
    if constexpr (WritesAlpha<S>)
      give(Formula::alpha, "alpha(t, t0, new_z, old_z, w_hat, w)", 2 * n + 1, 2 * n,
           [&](const R& t, RecordedIn x, RecordedOut o) { call_alpha(s, t, x, o); });
    if constexpr (WritesInvariants<S>) {
      offer(Formula::invariants, "invariants(t, z, values)", n, static_cast<int>(source_.invariants.size()),
            [](const S& self, const auto& t, auto z, auto out) { self.invariants(t, z, out); });
    } else if (!source_.invariants.empty()) {
      throw InputError("system " + source_.name + ": the descriptor lists the invariant " +
                       source_.invariants.front().name + "; expected invariants(t, z, values)");
    }
    if constexpr (WritesExactSolution<S>)
      give(Formula::exact_solution, "exact_solution(elapsed, t0, z0, z)", n + 1, n,
           [&](const R& elapsed, RecordedIn z, RecordedOut o) {
             s.exact_solution(elapsed, z[z.size() - 1], z.first(z.size() - 1), o);
           });
    if constexpr (WritesInitial<S>) {
      CountedOutputs start(n);
      s.template initial<R>(start.span());
      require_written("initial(z)", start, n, false);
      source_.initial.clear();
      for (const R& x : start.span()) source_.initial.push_back(x.constant());
    }
  }

 private:
  void collect_constraints() {
    const S& s = *system_;
    const int n = source_.dimension;
    if constexpr (WritesConstraintCount<S>) {
      int count = 0;
      if constexpr (requires { s.constraint_count(); }) {
        count = s.constraint_count();
      } else {
        count = S::constraint_count;
      }
      if constexpr (requires { s.constraint_names(); }) {
        source_.constraint_names = s.constraint_names();
      } else {
        for (int k = 1; k <= count; ++k) source_.constraint_names.push_back("phi" + std::to_string(k));
      }
      if constexpr (WritesHolonomic<S>) {
        offer(Formula::holonomic, "holonomic(t, q, phi)", n / 2, count,
              [](const S& self, const auto& t, auto q, auto out) { self.holonomic(t, q, out); });
        if constexpr (WritesConstraintEvaluator<S>)
          source_.holonomic = std::make_shared<const HolonomicFactoryOf<S>>(system_);
        if constexpr (WritesFriction<S>)
          offer(Formula::friction, "friction(t, z, lambda)", n, n / 2,
                [](const S& self, const auto& t, auto z, auto out) { self.friction(t, z, out); });
      } else {
        give(Formula::constraints, "constraints(t, z, phi)", n, count,
             [&](const Recorded& t, RecordedIn z, RecordedOut o) { s.constraints(t, z, o); });
        if constexpr (WritesConstraintGradients<S>)
          give(Formula::constraint_gradients, "constraint_gradients(t, z, rows)", n, count * n,
               [&](const Recorded& t, RecordedIn z, RecordedOut o) { s.constraint_gradients(t, z, o); });
      }
    }
  }
  // Records the matrix of a bracket, column by column.
  template <class B>
  void give_tensor(Formula formula, const char* called, const B& bracket) {
    using R = Recorded;
    const int n = source_.dimension;
    give(formula, called, n, n * n, [&](const R& t, RecordedIn z, RecordedOut o) {
      const std::size_t size = z.size();
      std::vector<R> covector(size), column(size);
      for (std::size_t j = 0; j < size; ++j) {
        covector.assign(size, R(0));
        covector[j] = R(1);
        bracket.sharp(t, z, RecordedIn(covector), RecordedOut(column));
        for (std::size_t i = 0; i < size; ++i) o[i * size + j] = column[i];
      }
    });
  }
  // A formula f(system, t, arguments, results): recorded, or a program where the system is batched.
  template <class F>
  void offer(Formula formula, const char* called, int inputs, int outputs, F f) {
    if constexpr (is_batched<S>()) {
      source_.programs[index(formula)] = std::make_shared<const Program<BatchedFormula<S, F>>>(
          BatchedFormula<S, F>{system_, f, inputs, outputs});
    } else {
      give(formula, called, inputs, outputs,
           [&](const Recorded& t, RecordedIn x, RecordedOut out) { f(*system_, t, x, out); });
    }
  }
  // Records a formula of one result.
  template <class F>
  void give(Formula formula, int inputs, F&& f) {
    source_.given[index(formula)] = std::make_shared<const Tape>(
        record(inputs, 1, [&](const Recorded& t, RecordedIn x, RecordedOut out) { out[0] = f(t, x); }));
  }
  // Records a formula of `outputs` results, named as in the list above.
  template <class F>
  void give(Formula formula, const char* called, int inputs, int outputs, F&& f) {
    source_.given[index(formula)] = std::make_shared<const Tape>(
        record(inputs, outputs, [&](const Recorded& t, RecordedIn x, RecordedOut out) {
          CountedOutputs results(outputs);
          f(t, x, results.span());
          require_written(called, results, outputs, !may_skip_zeros(formula));
          std::copy(results.span().begin(), results.span().end(), out.begin());
        }));
  }
  // Zeros need not be written in a one-form, a structure, a covector or an initial state.
  static constexpr bool may_skip_zeros(Formula formula) {
    return formula == Formula::one_form || formula == Formula::structure || formula == Formula::covector ||
           formula == Formula::friction || formula == Formula::constraint_gradients;
  }
  void require_written(const char* called, const CountedOutputs& results, int expected, bool all) const {
    const auto count = static_cast<std::size_t>(expected);
    std::string wrong;
    if (results.written() > count) {
      wrong = "writes " + std::to_string(results.written()) + " results";
    } else if (const std::size_t k = results.first_unwritten(); all && k < count) {
      wrong = "does not write result " + std::to_string(k + 1);
    } else {
      return;
    }
    throw InputError(
        "system " + source_.name + ": " + called + " " + wrong + "; expected " + std::to_string(expected) +
        (std::string_view(called).starts_with("invariants") ? ", as many as the descriptor lists" : ""));
  }
  // Canonical coordinates are Darboux's.
  void compile_identity_chart() {
    const CompiledFormula copy = [](const void* object, const double& /*t*/, const double* from, double* to) {
      std::copy_n(from, static_cast<std::size_t>(dimension_of(*static_cast<const S*>(object))), to);
    };
    compile(Formula::chart, copy);
    compile(Formula::chart_inverse, copy);
  }
  void compile_chart_field() requires CompilesChartField<S> {
    source_.chart_field_series = &compiled_series<S>();
    compile(Formula::chart_field, [](const void* object, const double& t, const double* y, double* rate) {
      constexpr auto size = static_cast<std::size_t>(S::dimension);
      chart_field_of<S, double>(*static_cast<const S*>(object), t, In<double>(y, size),
                                Out<double>(rate, size));
    });
    if constexpr (S::dimension <= 6)  // columns of duals: beyond, the tape is as fast
      compile(Formula::chart_field_jacobian,
              [](const void* object, const double& t, const double* y, double* matrix) {
                constexpr auto size = static_cast<std::size_t>(S::dimension);
                using D = Dual<double, S::dimension>;
                std::array<D, size> point, rate;
                for (std::size_t k = 0; k < size; ++k) point[k] = D::variable(y[k], static_cast<int>(k));
                chart_field_of<S, D>(*static_cast<const S*>(object), D(t), point, rate);
                for (std::size_t i = 0; i < size; ++i)
                  for (std::size_t j = 0; j < size; ++j) matrix[i * size + j] = rate[i].derivative[j];
              });
  }
  void compile(Formula formula, CompiledFormula f) { source_.compiled[index(formula)] = f; }

  std::shared_ptr<const S> system_;
  ModelSource& source_;
};

}  // namespace pfaff::detail
