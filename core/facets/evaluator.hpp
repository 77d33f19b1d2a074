// Evaluator and FormulaProgram: formulas ready to be evaluated with one scalar.
//
// Most formulas are recorded once and replayed with every scalar. A program is for those that are better
// compiled for each of them: formulas of systems with any number of bodies, whose tapes would be long and
// whose loops are batched, and fields that iterate over structured linear algebra. It is recorded only when
// its tape is asked for.
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff {

/// A formula ready to be evaluated with scalar T: one indirect call, whether compiled or replayed.
template <class T>
struct Evaluator {
  void (*call)(const void* context, const T& t, const T* arguments, T* results) = nullptr;
  const void* context = nullptr;
  std::shared_ptr<const void> owner;  // of what `context` points to
};

/// A formula compiled for the scalars of methods; every evaluator it makes has buffers of its own.
class FormulaProgram : public Maker<Evaluator, StepScalars> {
 public:
  template <class T>
  [[nodiscard]] Evaluator<T> evaluator(T /*scalar*/) const {
    return make_for(std::type_identity<T>());
  }
  /// The formula at eight points side by side, each with the bits that it has alone; `call` is null where it
  /// is not compiled for them.
  [[nodiscard]] virtual Evaluator<Pack<8>> in_lanes() const = 0;
  /// The same formula as a tape.
  [[nodiscard]] virtual Tape record() const = 0;
};

namespace detail {

/// What the programs made of F are.
template <class F>
class ProgramCode {
 public:
  explicit ProgramCode(F formula) : formula_(std::make_shared<const F>(std::move(formula))) {}
  // Each evaluator is used by one thread, so writing to its buffers through a const context is safe.
  template <class T>
  [[nodiscard]] Evaluator<T> made() const {
    auto bound = std::make_shared<Bound<T>>(formula_);
    const void* context = bound.get();
    return {[](const void* c, const T& t, const T* arguments, T* results) {
              auto& b = *static_cast<Bound<T>*>(const_cast<void*>(c));  // NOLINT
              b.object(t, In<T>(arguments, b.inputs), Out<T>(results, b.outputs));
            },
            context, std::move(bound)};
  }
  [[nodiscard]] Tape recorded() const {
    return pfaff::record(formula_->inputs(), formula_->outputs(),
                         [&](const Recorded& t, In<Recorded> x, Out<Recorded> out) {
                           formula_->template make<Recorded>()(t, x, out);
                         });
  }

  [[nodiscard]] bool fits_lanes() const { return formula_->fits_lanes(); }

 private:
  template <class T>
  struct Bound {
    explicit Bound(std::shared_ptr<const F> f)
        : formula(std::move(f)),
          inputs(static_cast<std::size_t>(formula->inputs())),
          outputs(static_cast<std::size_t>(formula->outputs())),
          object(formula->template make<T>()) {}
    std::shared_ptr<const F> formula;
    std::size_t inputs, outputs;
    decltype(std::declval<const F&>().template make<T>()) object;
  };
  std::shared_ptr<const F> formula_;
};

}  // namespace detail

/// A program made of F, which says how many numbers it reads and writes (inputs(), outputs()) and makes for
/// every scalar T, the recording one included, an object with buffers of its own: make<T>(), to be called as
/// object(t, In<T> arguments, Out<T> results). Where F::in_lanes is true it makes one for packs too, unless
/// fits_lanes() is false.
template <class F>
class Program final : public detail::MakerInUnits<Program<F>, FormulaProgram>, public detail::ProgramCode<F> {
 public:
  using detail::ProgramCode<F>::ProgramCode;
  [[nodiscard]] Tape record() const override {
    if constexpr (detail::ThisUnit::makes<Recorded>) {
      return this->recorded();
    } else {
      using Code = Tape (*)(const Program&);
      const auto code = detail::code_left(typeid(Program), typeid(Recorded));
      return reinterpret_cast<Code>(code)(*this);  // NOLINT
    }
  }
  [[nodiscard]] Evaluator<Pack<8>> in_lanes() const override {
    if constexpr (requires { requires F::in_lanes; }) {
      if (!this->fits_lanes()) return {};
      if constexpr (detail::ThisUnit::makes<double>) {
        return this->template made<Pack<8>>();
      } else {
        using Code = Evaluator<Pack<8>> (*)(const Program&);
        return reinterpret_cast<Code>(detail::code_left(typeid(Program), typeid(Pack<8>)))(*this);  // NOLINT
      }
    } else {
      return {};
    }
  }
  /// What the two units that compile F leave each other.
  static void leave_code() {
    detail::leave_code_of<Program>();
    if constexpr (std::is_same_v<detail::ThisUnit, detail::InDouble> && requires { requires F::in_lanes; })
      detail::leave<Program, Pack<8>>(
          +[](const Program& self) -> Evaluator<Pack<8>> { return self.template made<Pack<8>>(); });
    if constexpr (std::is_same_v<detail::ThisUnit, detail::InOthers>)
      detail::leave<Program, Recorded>(+[](const Program& self) -> Tape { return self.recorded(); });
  }
};

}  // namespace pfaff
