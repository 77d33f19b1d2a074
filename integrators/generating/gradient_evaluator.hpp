// The gradient of a truncated generating function in the fastest available form. It is compiled where the
// system's author compiled the field and CompiledGradient supports the scheme, and interpreted from the tape
// otherwise.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include <pfaff/integrators/generating/compiled_gradient.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>

namespace pfaff {

template <class T>
class GradientEvaluator {
  using Interpreted = GeneratingGradient<T>;
  using Any = std::conditional_t<
      std::is_same_v<T, double>,
      std::variant<Interpreted, CompiledGradient<1>, CompiledGradient<2>, CompiledGradient<4>>,
      std::variant<Interpreted>>;

 public:
  template <class P>
  GradientEvaluator(const P& p, int order, bool symmetric, int extra, const GeneratingShare& share,
                    const GaussCoefficients& gauss)
      : any_(make(p, order, symmetric, extra, share, gauss)) {}

  [[nodiscard]] std::size_t evaluations() const {
    return std::visit([](const auto& g) { return g.evaluations(); }, any_);
  }
  /// Whether the field is run as its author's code, not from the tape.
  [[nodiscard]] bool is_compiled() const { return any_.index() > 0; }
  void set_step(const T& t, const T& tau) {
    std::visit([&](auto& g) { g.set_step(t, tau); }, any_);
  }
  void operator()(const T* w, T* psi) {
    std::visit([&](auto& g) { g(w, psi); }, any_);
  }

 private:
  template <class P>
  static Any make(const P& p, int order, bool symmetric, int extra, const GeneratingShare& share,
                  const GaussCoefficients& gauss) {
    if constexpr (std::is_same_v<T, double>) {
      const GeneratingNodes nodes(order, symmetric, extra, gauss);
      const BoundSeries field = p.chart_field_series();
      if (field.series != nullptr && share.diagonal(p.size())) {
        if (CompiledGradient<1>::fits(nodes)) return CompiledGradient<1>(field, nodes, share);
        if (CompiledGradient<2>::fits(nodes)) return CompiledGradient<2>(field, nodes, share);
        if (CompiledGradient<4>::fits(nodes)) return CompiledGradient<4>(field, nodes, share);
      }
    }
    return Interpreted(p.chart_field_tape(), order, symmetric, share, gauss, extra);
  }

  Any any_;
};

}  // namespace pfaff
