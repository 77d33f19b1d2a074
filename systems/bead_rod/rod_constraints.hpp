// The constraints of rods, phi_k = (|D_k|^2 - l_k^2)/2 with D_k = r_a - r_b, as loops over rods and over
// pairs of rods that share a bead (nguyen-turski (4.4), Table 1, for any graph).
//
//   phi~_k = D_k.V_k,  V_k = v_a - v_b,        h_k = |V_k|^2 + D_k.(f_a/m_a - f_b/m_b)
//   S_kk = |D_k|^2 (1/m_a + 1/m_b),            S_kl = s s' D_k.D_l/m of the bead that k and l share
//   S^D the same with lambda/m^2 for 1/m,      B: rows D_k,   T = dphi~/dq: rows V_k/m
//
// s is +1 at the first end of a rod and -1 at the second; an anchor has 1/m = 0 and does not move. |D_k|^2 is
// that of the present positions, also off the constraint surface. Everything is O(N).
#pragma once

#include <memory>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/systems/bead_rod/folded_rods.hpp>
#include <pfaff/systems/bead_rod/potentials.hpp>
#include <pfaff/systems/bead_rod/rod_maps.hpp>

namespace pfaff {

template <class T, int D>
class RodConstraints final : public HolonomicConstraints<T>, public DescribedByRods {
 public:
  RodConstraints(std::shared_ptr<const BeadRodDescription> description, std::shared_ptr<const RodGraph> graph)
      : description_(std::move(description)),
        graph_(std::move(graph)),
        maps_(*description_),
        potentials_(description_, *graph_),
        s_(graph_->pattern()),
        degrees_(maps_.degrees()),
        forces_(description_->points() * D, T(0)),
        accelerations_(forces_),
        inverse_masses_of_rod_(description_->rods.size()),
        length_square_(inverse_masses_of_rod_),
        residuals_(inverse_masses_of_rod_),
        hidden_(inverse_masses_of_rod_),
        hidden_rates_(inverse_masses_of_rod_),
        multipliers_(inverse_masses_of_rod_),
        directions_(description_->rods.size()),
        turnings_(directions_) {
    const BeadRodDescription& d = *description_;
    for (std::size_t k = 0; k < d.rods.size(); ++k) {
      const Rod& rod = d.rods[k];
      length_square_[k] = T(rod.length) * T(rod.length);
      inverse_masses_of_rod_[k] = maps_.inverse_mass(rod.first) + maps_.inverse_mass(rod.second);
    }
    for (const RodCoupling& c : graph_->couplings()) {
      const T w = maps_.inverse_mass(c.bead);
      coupling_.push_back(c.same_side ? w : -w);
    }
    skew_.resize(coupling_.size());
    if (!d.friction.empty()) {
      for (const Real& lambda : d.friction) friction_.insert(friction_.end(), D, T(lambda));
      friction_s_ = std::make_unique<StructuredLDLT<T>>(graph_->pattern());
    }
    if constexpr (folds) {
      folded_ = Folded(d, *graph_);
      if (folded_.holds_all() && potentials_.constant()) {
        set_forces({});
        folded_.set_forces(forces_);
      }
    }
  }

  [[nodiscard]] const BeadRodDescription& description() const override { return *description_; }
  [[nodiscard]] std::size_t count() const override { return maps_.count(); }
  [[nodiscard]] std::size_t degrees() const override { return degrees_; }
  [[nodiscard]] const SymmetricPattern& pattern() const override { return *graph_->pattern(); }

  void values(const T& /*t*/, In<T> q, Out<T> phi) override {
    maps_.each_direction(
        q, [&](std::size_t k, const Arm& e) { phi[k] = (dot(e, e) - length_square_[k]) / T(2); });
  }
  void hidden_values(const T& /*t*/, In<T> q, In<T> p, Out<T> hidden) override {
    maps_.each_turning(q, p,
                       [&](std::size_t k, const Arm& e, const Arm& turning) { hidden[k] = dot(e, turning); });
  }
  void velocity(const T& /*t*/, In<T> /*q*/, In<T> p, Out<T> v) override { maps_.velocity(p, v); }
  void force(const T& /*t*/, In<T> q, In<T> /*p*/, Out<T> f) override { potentials_.forces(q, f); }

  Status linearise(const T& /*t*/, In<T> q, In<T> /*p*/) override {
    maps_.each_direction(q, [&](std::size_t k, const Arm& e) {
      directions_[k] = e;
      s_.diagonal()[k] = dot(e, e) * inverse_masses_of_rod_[k];
    });
    return factor_s();
  }
  void apply(In<T> u, Out<T> r) const override { maps_.template rows_times<false>(directions_, u, r); }
  void apply_transpose(In<T> x, Out<T> f) const override {
    maps_.template columns_times<false>(directions_, x, f);
  }
  void solve(In<T> r, Out<T> x) const override { s_.solve(r.data(), x.data()); }
  void solve(In<T> r1, Out<T> x1, In<T> r2, Out<T> x2) const override {
    s_.solve(r1.data(), x1.data(), r2.data(), x2.data());
  }
  void hidden_by_momentum(In<T> u, Out<T> r) const override {
    maps_.template rows_times<true>(directions_, u, r);
  }
  void hidden_by_momentum_transpose(In<T> x, Out<T> v) const override {
    maps_.template columns_times<true>(directions_, x, v);
  }

  Status place(const T& /*t*/, In<T> q, In<T> p) override {
    const Status status = prepare<false>(q, p);
    for (std::size_t k = 0; k < count(); ++k)
      residuals_[k] = (dot(directions_[k], directions_[k]) - length_square_[k]) / T(2);
    return status;
  }
  [[nodiscard]] std::span<const T> residuals() const override { return residuals_; }
  [[nodiscard]] std::span<const T> hidden() const override { return hidden_; }
  [[nodiscard]] std::span<const T> hidden_rates() const override { return hidden_rates_; }
  [[nodiscard]] std::span<const T> velocities() const override { return maps_.velocities(); }
  [[nodiscard]] std::span<const T> forces() const override {
    return std::span<const T>(forces_).first(degrees_);
  }
  void hidden_by_position(In<T> u, Out<T> r) const override {
    maps_.template rows_times<false>(turnings_, u, r);
  }
  void hidden_by_position_transpose(In<T> x, Out<T> f) const override {
    maps_.template columns_times<false>(turnings_, x, f);
  }

  [[nodiscard]] ConstrainedRates<T>* rates(Reactions reactions) override {
    if (reactions == Reactions::hamiltonian) return &hamiltonian_;
    return reactions == Reactions::ideal ? &ideal_ : nullptr;
  }
  // Folded rings do not tell how they respond.
  [[nodiscard]] IdealRates<T>* ideal_rates() override { return folded_.responds() ? &ideal_ : nullptr; }

  [[nodiscard]] std::span<const T> friction() const override { return friction_; }
  Status factor_friction() override {
    if (friction_s_ == nullptr) return Status::converged;
    const auto weight = [&](std::size_t point) {
      if (point * D >= degrees_) return T(0);
      return friction_[point * D] * (maps_.inverse_mass(point) * maps_.inverse_mass(point));
    };
    for (std::size_t k = 0; k < count(); ++k) {
      const auto [a, b] = maps_.ends(k);
      friction_s_->diagonal()[k] = dot(directions_[k], directions_[k]) * (weight(a) + weight(b));
    }
    const auto& couplings = graph_->couplings();
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      const T product =
          weight(couplings[c].bead) * dot(directions_[couplings[c].k], directions_[couplings[c].l]);
      friction_s_->couplings()[c] = couplings[c].same_side ? product : -product;
    }
    return friction_s_->factor_semidefinite();
  }
  void solve_friction(In<T> r, Out<T> x) const override {
    if (friction_s_ == nullptr) {
      for (std::size_t k = 0; k < count(); ++k) x[k] = T(0);
    } else {
      friction_s_->solve(r.data(), x.data());
    }
  }

 private:
  using Arm = typename RodMaps<T, D>::Arm;
  static T dot(const Arm& a, const Arm& b) { return RodMaps<T, D>::dot(a, b); }

  // Dirac's equations, nguyen-turski (4.2), and Lagrange's, (A.5), in two passes over the rods.
  struct HamiltonianRates final : ConstrainedRates<T> {
    explicit HamiltonianRates(RodConstraints& of) : rods(of) {}
    Status operator()(const T& /*t*/, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) override {
      return rods.hamiltonian_rates(q, p, q_rate, p_rate);
    }
    RodConstraints& rods;
  };
  struct Multipliers final : IdealRates<T> {
    explicit Multipliers(RodConstraints& of) : rods(of) {}
    Status operator()(const T& /*t*/, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) override {
      return rods.rates_by_multipliers(q, p, q_rate, p_rate);
    }
    void respond(In<T> f, Out<T> rest) override { rods.respond(f, rest); }
    RodConstraints& rods;
  };

  Status hamiltonian_rates(In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) {
    if constexpr (folds)
      if (folded_.holds_all()) return folded_rates(&Folded::dirac, q, p, q_rate, p_rate);
    const Status status = prepare<true>(q, p);
    s_.solve(hidden_.data(), multipliers_.data());  // mu
    const auto& couplings = graph_->couplings();
    for (std::size_t c = 0; c < skew_.size(); ++c) {  // h - A mu
      const auto k = couplings[c].k, l = couplings[c].l;
      hidden_rates_[k] = hidden_rates_[k] - skew_[c] * multipliers_[l];
      hidden_rates_[l] = hidden_rates_[l] + skew_[c] * multipliers_[k];
    }
    s_.solve(hidden_rates_.data(), hidden_rates_.data());
    std::copy(p.begin(), p.end(), q_rate.begin());
    std::copy_n(forces_.begin(), degrees_, p_rate.begin());
    for (std::size_t k = 0; k < count(); ++k) {
      const Arm& e = directions_[k];
      const Arm& u = turnings_[k];
      const T mu = multipliers_[k], x = hidden_rates_[k];
      const std::size_t a = maps_.ends(k).first * D, b = maps_.ends(k).second * D;
      Arm pull, push;
      for (std::size_t i = 0; i < D; ++i) {
        pull[i] = mu * e[i];
        push[i] = x * e[i] - mu * u[i];
        q_rate[a + i] = q_rate[a + i] - pull[i];
        p_rate[a + i] = p_rate[a + i] - push[i];
      }
      if (b < degrees_)
        for (std::size_t i = 0; i < D; ++i) {
          q_rate[b + i] = q_rate[b + i] + pull[i];
          p_rate[b + i] = p_rate[b + i] + push[i];
        }
    }
    maps_.velocity(q_rate, q_rate);
    return status;
  }
  Status rates_by_multipliers(In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) {
    if constexpr (folds)
      if (folded_.holds_all()) return folded_rates(&Folded::multipliers, q, p, q_rate, p_rate);
    const Status status = prepare<false>(q, p);
    s_.solve(hidden_rates_.data(), hidden_rates_.data());
    std::copy_n(maps_.velocities().begin(), degrees_, q_rate.begin());
    std::copy_n(forces_.begin(), degrees_, p_rate.begin());
    for (std::size_t k = 0; k < count(); ++k) {
      const std::size_t a = maps_.ends(k).first * D, b = maps_.ends(k).second * D;
      for (std::size_t i = 0; i < D; ++i) {
        const T push = hidden_rates_[k] * directions_[k][i];
        p_rate[a + i] = p_rate[a + i] - push;
        if (b < degrees_) p_rate[b + i] = p_rate[b + i] + push;
      }
    }
    return status;
  }

  // With the factors that rates_by_multipliers has left.
  void respond(In<T> f, Out<T> rest) {
    if constexpr (folds)
      if (folded_.holds_all()) return folded_.respond(f, rest);
    hidden_by_momentum(f, multipliers_);
    s_.solve(multipliers_.data(), multipliers_.data());
    apply_transpose(multipliers_, rest);
    for (std::size_t k = 0; k < degrees_; ++k) rest[k] = f[k] - rest[k];
  }

  // Rates in doubles, where all rods are parts of paths and rings that can be folded.
  static constexpr bool folds = std::is_same_v<T, double>;
  using Folded = FoldedRods<D>;
  Status folded_rates(bool (Folded::*operation)(In<double>, In<double>, Out<double>, Out<double>), In<T> q,
                      In<T> p, Out<T> q_rate, Out<T> p_rate) {
    const Status status = set_forces(q);
    if (!potentials_.constant()) folded_.set_forces(forces_);
    const bool regular = (folded_.*operation)(q, p, q_rate, p_rate);
    return regular || status != Status::converged ? status : Status::singular;
  }
  // Forces and accelerations of the beads; where they are constant, only when there are none yet.
  Status set_forces(In<T> q) {
    if (potentials_.constant() && placed_) return Status::converged;
    placed_ = true;
    const Status status = potentials_.forces(q, Out<T>(forces_).first(degrees_));
    maps_.velocity(In<T>(forces_).first(degrees_), Out<T>(accelerations_).first(degrees_));
    return status;
  }
  // D, V, phi~ and h of every rod, the factors of S, and A where it is asked for.
  template <bool Skew>
  Status prepare(In<T> q, In<T> p) {
    const Status forces = set_forces(q);
    maps_.each_turning(q, p, [&](std::size_t k, const Arm& e, const Arm& u) {
      directions_[k] = e;
      turnings_[k] = u;
      hidden_[k] = dot(e, u);
      hidden_rates_[k] = dot(u, u) + dot(e, maps_.difference(accelerations_, k));
      s_.diagonal()[k] = dot(e, e) * inverse_masses_of_rod_[k];
    });
    const auto& couplings = graph_->couplings();
    T* const entries = s_.couplings();
    for (std::size_t c = 0; c < coupling_.size(); ++c) {
      const auto k = couplings[c].k, l = couplings[c].l;
      const Arm &e = directions_[k], &other = directions_[l];
      entries[c] = coupling_[c] * dot(e, other);
      if constexpr (Skew) skew_[c] = coupling_[c] * (dot(turnings_[k], other) - dot(e, turnings_[l]));
    }
    const Status factors = s_.factor();
    return forces == Status::converged ? factors : forces;
  }

  Status factor_s() {
    const auto& couplings = graph_->couplings();
    for (std::size_t c = 0; c < coupling_.size(); ++c)
      s_.couplings()[c] = coupling_[c] * dot(directions_[couplings[c].k], directions_[couplings[c].l]);
    return s_.factor();
  }

  std::shared_ptr<const BeadRodDescription> description_;
  std::shared_ptr<const RodGraph> graph_;
  RodMaps<T, D> maps_;
  Potentials<T, D> potentials_;
  StructuredLDLT<T> s_;
  std::unique_ptr<StructuredLDLT<T>> friction_s_;  // none without friction
  std::size_t degrees_;
  std::vector<T> forces_, accelerations_;  // of all points
  std::vector<T> inverse_masses_of_rod_, length_square_, residuals_, hidden_, hidden_rates_, multipliers_;
  std::vector<Arm> directions_, turnings_;
  bool placed_ = false;      // forces are those of some positions
  std::vector<T> skew_;      // A, as S in the order of couplings
  std::vector<T> coupling_;  // 1/m of the shared bead with the sign of the coupling
  std::vector<T> friction_;
  Folded folded_;  // without rods where rates are not made in doubles
  HamiltonianRates hamiltonian_{*this};
  Multipliers ideal_{*this};
};

}  // namespace pfaff
