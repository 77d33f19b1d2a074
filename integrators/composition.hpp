// Symmetric compositions of a symmetric method of order 2:
//
//   step(h) = S(gamma_s h) ... S(gamma_2 h) S(gamma_1 h),   gamma_i = gamma_{s+1-i}
//
// (hairer-lubich-wanner2006 II.4, V.3). A composition keeps whatever its base keeps for steps of either sign:
// over Stoermer-Verlet it is symplectic and explicit, over the midpoint rule in Darboux coordinates
// K(z,t)-symplectic. Families of weights: yoshida1990 (few stages, large errors), suzuki1990 (many stages,
// smaller ones), kahan-li1997 (the best known of orders 6 and 8).
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/composition_weights.hpp>

namespace pfaff {

/// Steps of Base with the lengths weights[i] h. What the base has rounded off, its workspace's `carry`, or
/// all that it hands over (hand_over(next)), is handed from sub-step to sub-step; bases that extrapolate from
/// past steps (their workspaces can restart()) keep a history for each sub-step.
template <class Base>
struct Composition : Base {
  std::vector<Quad> weights{Quad(1)};

  std::span<Quad> coefficients() { return weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    using BaseWork = pfaff::Work<Base, P>;
    static constexpr bool with_history = requires(BaseWork & w) { w.restart(); };

    std::vector<BaseWork> base;    // one for each sub-step, or one for all
    std::vector<T> length, start;  // of sub-steps, in units of h
    State<P> before;

    Work(const Composition& method, const P& p) : before(p.make_state()) {
      Quad sum(0);
      for (const Quad& gamma : method.weights) {
        length.push_back(T(Real(gamma)));
        start.push_back(T(Real(sum)));
        sum += gamma;
      }
      const std::size_t count = with_history ? length.size() : 1;
      base.reserve(count);
      for (std::size_t i = 0; i < count; ++i) base.emplace_back(method, p);
    }
    void restart() {
      for (BaseWork& w : base) w.restart();
    }
  };

  template <class P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    std::copy(z.begin(), z.end(), w.before.begin());
    for (std::size_t i = 0; i < w.length.size(); ++i) {
      auto& base = w.base[i % w.base.size()];
      const Status status = Base::step(p, t + w.start[i] * h, w.length[i] * h, z, base);
      if (status != Status::converged) {
        std::copy(w.before.begin(), w.before.end(), z.begin());
        if constexpr (Work<P>::with_history) w.restart();
        return status;
      }
      if constexpr (Work<P>::with_history) {
        auto& next = w.base[(i + 1) % w.base.size()];
        if constexpr (requires { base.hand_over(next); }) {
          base.hand_over(next);
        } else {
          std::swap(base.carry, next.carry);
        }
      }
    }
    return Status::converged;
  }
};

/// A composition whose weights are those of a family of the order asked for. Family has `orders`, their
/// names, `verified` and `verified_in_full`, how many of them have their claims verified, and weights(order).
template <class Family, class Scheme>
struct Composed : Scheme {
  std::string composed_order = Family::orders.front();

  static std::vector<Parameter> parameters() {
    return {parameter(&Composed::composed_order, "order", Family::orders, "order of the composition"),
            parameter<Composed>(static_cast<bool Composed::*>(&Composed::compensated), "compensated",
                                "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    for (std::size_t k = 0; k < (full ? Family::verified_in_full : Family::verified); ++k)
      list.push_back({{"order", Family::orders[k]}});
    return list;
  }
  void validate() { this->weights = Family::weights(std::stoi(composed_order)); }
  [[nodiscard]] int order(const Model& /*model*/) const { return std::stoi(composed_order); }
};

struct YoshidaFamily {
  static inline const std::vector<std::string> orders{"4", "6", "8", "10", "12"};
  static constexpr std::size_t verified = 3, verified_in_full = 4;
  static std::vector<Quad> weights(int order) { return yoshida_weights(order); }
};
struct SuzukiFamily {
  static inline const std::vector<std::string> orders{"4", "6", "8", "10", "12"};
  static constexpr std::size_t verified = 2, verified_in_full = 3;
  static std::vector<Quad> weights(int order) { return suzuki_weights(order); }
};
struct KahanLiFamily {
  static inline const std::vector<std::string> orders{"6", "8"};
  static constexpr std::size_t verified = 2, verified_in_full = 2;
  static std::vector<Quad> weights(int order) { return kahan_li_weights(order); }
};

}  // namespace pfaff
