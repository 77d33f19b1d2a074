#include <pfaff/core/facets/model.hpp>

#include <stdexcept>

#include <pfaff/core/facets/derived_charts.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

std::string to_string(FacetSet set) {
  std::string text;
  for (unsigned k = 0; k < static_cast<unsigned>(Facet::count); ++k)
    if (set.has(static_cast<Facet>(k)))
      text += (text.empty() ? "" : ", ") + std::string(to_string(static_cast<Facet>(k)));
  return text;
}

namespace {
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

void copy(const std::vector<Recorded>& from, Results to) {
  for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[k];
}
std::shared_ptr<const Tape> shared(Tape tape) { return std::make_shared<const Tape>(std::move(tape)); }

std::vector<Recorded> gradient_of(const Tape& scalar, const Recorded& t, Arguments z) {
  const std::vector<Recorded> one{Recorded(1)};
  return gradient(scalar, t, z, one);
}

// Pi dH + G dS with an entropy S, Pi dH - G dH without.
Tape metriplectic_field(const Model& model) {
  const auto energy = model.tape(Formula::hamiltonian_gradient),
             poisson = model.tape(Formula::poisson_tensor), symmetric = model.tape(Formula::symmetric_tensor);
  const auto entropy = model.given(Formula::entropy) ? model.tape(Formula::entropy) : nullptr;
  const auto n = static_cast<std::size_t>(model.dimension());
  return record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
    const auto slope = evaluate(*energy, t, z), pi = evaluate(*poisson, t, z), g = evaluate(*symmetric, t, z);
    auto friction = slope;
    for (Recorded& x : friction) x = -x;
    if (entropy != nullptr) friction = gradient_of(*entropy, t, z);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        out[i] = out[i] + pi[i * n + j] * slope[j] + g[i * n + j] * friction[j];
  });
}
}  // namespace

Tape damped_field(const Model& model) {
  const auto velocity = model.tape(Formula::velocity), force = model.tape(Formula::force);
  const auto half = static_cast<std::size_t>(velocity->inputs);
  return record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments z, Results out) {
    const auto rate = evaluate(*velocity, t, z.subspan(half)), slope = evaluate(*force, t, z.first(half));
    for (std::size_t k = 0; k < half; ++k) {
      out[k] = rate[k];
      out[half + k] = slope[k] - model.damping() * z[half + k];
    }
  });
}

FacetSet Model::content_of_formulas() const {
  FacetSet content;
  const auto has = [&](Formula f) { return given(f); };
  const auto offer = [&](Facet f) { content = content.with(f); };
  const bool energies = has(Formula::kinetic) && has(Formula::potential);
  const bool conformal = energies && source_.damping.has_value(), separable = energies && !conformal;
  const bool hamiltonian = separable || has(Formula::hamiltonian);
  const bool birkhoffian = has(Formula::birkhoffian) && has(Formula::one_form);
  if (hamiltonian) offer(Facet::hamiltonian);
  if (separable) offer(Facet::separable);
  if (conformal) offer(Facet::conformal);
  const bool structure = birkhoffian || (has(Formula::structure) && has(Formula::covector));
  if (structure) offer(Facet::structure);
  if (birkhoffian) offer(Facet::birkhoffian);
  if (has(Formula::field) || hamiltonian || conformal || structure) offer(Facet::vector_field);
  if ((has(Formula::chart) && has(Formula::chart_inverse)) || (source_.canonical && hamiltonian))
    offer(Facet::darboux_chart);
  if (has(Formula::alpha) && (structure || source_.canonical)) offer(Facet::generating_map);
  if (hamiltonian && has(Formula::symmetric_tensor)) offer(Facet::metriplectic);
  if (hamiltonian && source_.canonical && has(Formula::holonomic)) offer(Facet::holonomic);
  if (hamiltonian && (has(Formula::holonomic) || has(Formula::constraints))) offer(Facet::constraints);
  if (!source_.invariants.empty()) offer(Facet::invariants);
  if (has(Formula::exact_solution)) offer(Facet::exact_solution);
  return content;
}

Model::Model(ModelSource source) : source_(std::move(source)) {
  content_ = content_of_formulas();
  if (content_.has(Facet::structure) && !content_.has(Facet::darboux_chart)) {
    pivots_ = chart_pivots();
    if (!pivots_.empty()) content_ = content_.with(Facet::darboux_chart);
  }
  facets_ = content_;
  const auto keep = [&](std::initializer_list<Facet> kept) {
    facets_ = {};
    for (const Facet f : kept)
      if (content_.has(f)) facets_ = facets_.with(f);
  };
  // Energy and bracket make the motion only where there is nothing else.
  if (content_.has(Facet::metriplectic))
    keep({Facet::vector_field, Facet::metriplectic, Facet::invariants, Facet::exact_solution});
  if (content_.has(Facet::constraints))
    keep({Facet::holonomic, Facet::constraints, Facet::invariants, Facet::exact_solution});
  if (!source_.formulation.empty()) facets_ = facets_.with(Facet::vector_field);
}

bool Model::autonomous() const {
  if (source_.autonomous) return *source_.autonomous;
  if (content_.has(Facet::constraints) && !tape(Formula::constraints)->autonomous()) return false;
  return tape(Formula::field)->autonomous();
}

bool Model::frictionless() const {
  if (!given(Formula::friction)) return true;
  const Tape& lambda = *tape(Formula::friction);
  for (const int slot : lambda.outputs) {
    const Instruction& i = lambda.code[static_cast<std::size_t>(slot)];
    if (i.operation != Operation::constant || !lambda.constants[static_cast<std::size_t>(i.a)].is(0))
      return false;
  }
  return true;
}

std::vector<std::string> Model::constraint_names() const {
  if (!content_.has(Facet::holonomic)) return source_.constraint_names;
  std::vector<std::string> names;
  for (const std::string& name : source_.constraint_names) {
    names.push_back(name);
    names.push_back(name + "~");
  }
  return names;
}

const HolonomicFactory& Model::holonomic_factory() const {
  if (!content_.has(Facet::holonomic))
    throw std::logic_error("system " + name() + " has no holonomic constraints");
  if (source_.holonomic != nullptr) return *source_.holonomic;
  const std::lock_guard lock(mutex_);
  if (holonomic_ == nullptr)
    holonomic_ = std::make_shared<const HolonomicFactoryOf<TapedConstraintSource>>(
        std::make_shared<const TapedConstraintSource>(
            TapedConstraintSource{std::make_shared<const HolonomicTapes>(record_holonomic(*this))}));
  return *holonomic_;
}

PivotPairs Model::chart_pivots() const {
  const auto structure = tape(Formula::structure);
  if (!structure->state_independent()) return {};
  std::vector<double> k(structure->outputs.size());
  const std::vector<double> z(static_cast<std::size_t>(dimension()));  // not read
  Replay<double> replay(structure);
  replay(0, z.data(), k.data());
  return choose_pivot_pairs(k, z.size());
}

std::string Model::advice(FacetSet needs) const {
  if (needs.has(Facet::generating_map) && !facets_.has(Facet::generating_map))
    return facets_.has(Facet::structure) || source_.canonical ? "; write alpha(t, t0, new_z, old_z, w_hat, w)"
                                                              : "";
  if (!needs.has(Facet::darboux_chart) || facets_.has(Facet::darboux_chart)) return {};
  if (!facets_.has(Facet::structure)) return {};
  return tape(Formula::structure)->state_independent()
             ? "; its structure K is degenerate at t = 0"
             : "; its structure K depends on the state: write chart and chart_inverse";
}

std::shared_ptr<const Tape> Model::tape(Formula formula) const {
  const std::lock_guard lock(mutex_);
  auto& slot = tapes_[index(formula)];
  if (slot == nullptr && program(formula) != nullptr) slot = shared(program(formula)->record());
  if (slot == nullptr) slot = given(formula) ? source_.given[index(formula)] : derived(formula);
  if (slot == nullptr) throw std::logic_error("system " + name() + " does not give this formula");
  return slot;
}

std::shared_ptr<const Tape> Model::derived(Formula formula) const {
  const int n = source_.dimension;
  const auto size = static_cast<std::size_t>(n);
  const bool birkhoffian = content_.has(Facet::birkhoffian), structured = content_.has(Facet::structure);
  const bool chart_given = given(Formula::chart);
  const auto identity = [&] {
    return shared(record(n, n, [](const Recorded&, Arguments z, Results out) {
      for (std::size_t k = 0; k < z.size(); ++k) out[k] = z[k];
    }));
  };
  switch (formula) {
    case Formula::hamiltonian: {
      if (!content_.has(Facet::separable)) return nullptr;
      const auto kinetic = tape(Formula::kinetic), potential = tape(Formula::potential);
      return shared(record(n, 1, [&](const Recorded& t, Arguments z, Results out) {
        out[0] =
            evaluate(*kinetic, t, z.subspan(size / 2))[0] + evaluate(*potential, t, z.first(size / 2))[0];
      }));
    }
    case Formula::hamiltonian_gradient: {
      if (!content_.has(Facet::hamiltonian)) return nullptr;
      const auto energy = tape(Formula::hamiltonian);
      return shared(record(
          n, n, [&](const Recorded& t, Arguments z, Results out) { copy(gradient_of(*energy, t, z), out); }));
    }
    case Formula::velocity:
    case Formula::force: {
      if (!content_.has(Facet::separable) && !content_.has(Facet::conformal)) return nullptr;
      const bool force = formula == Formula::force;
      const auto energy = tape(force ? Formula::potential : Formula::kinetic);
      return shared(record(n / 2, n / 2, [&](const Recorded& t, Arguments x, Results out) {
        const auto slope = gradient_of(*energy, t, x);
        for (std::size_t k = 0; k < slope.size(); ++k) out[k] = force ? -slope[k] : slope[k];
      }));
    }
    case Formula::field: {
      if (content_.has(Facet::separable) &&
          !content_.has(Facet::metriplectic)) {  // from the author's force and velocity where there are any
        const auto velocity = tape(Formula::velocity), force = tape(Formula::force);
        return shared(record(n, n, [&](const Recorded& t, Arguments z, Results out) {
          copy(evaluate(*velocity, t, z.subspan(size / 2)), out.first(size / 2));
          copy(evaluate(*force, t, z.first(size / 2)), out.subspan(size / 2));
        }));
      }
      if (content_.has(Facet::metriplectic)) return shared(metriplectic_field(*this));
      if (content_.has(Facet::hamiltonian)) {
        const auto energy = tape(Formula::hamiltonian);
        const auto tensor = source_.canonical ? nullptr : tape(Formula::poisson_tensor);
        return shared(record(n, n, [&](const Recorded& t, Arguments z, Results out) {
          const auto slope = gradient_of(*energy, t, z);
          if (tensor == nullptr) return canonical_sharp(slope, out);
          const auto pi = evaluate(*tensor, t, z);
          for (std::size_t i = 0; i < size; ++i) {
            out[i] = Recorded(0);
            for (std::size_t j = 0; j < size; ++j) out[i] = out[i] + pi[i * size + j] * slope[j];
          }
        }));
      }
      if (!structured) return content_.has(Facet::conformal) ? shared(damped_field(*this)) : nullptr;
      const auto structure = tape(Formula::structure), covector = tape(Formula::covector);
      return shared(record(n, n, [&](const Recorded& t, Arguments z, Results out) {
        auto right = evaluate(*covector, t, z);
        for (Recorded& x : right) x = -x;
        copy(solve(evaluate(*structure, t, z), right), out);
      }));
    }
    case Formula::field_jacobian:
      return shared(jacobian_tape(*tape(Formula::field)));
    case Formula::structure: {
      if (!birkhoffian && !source_.canonical) return nullptr;
      const auto form = birkhoffian ? tape(Formula::one_form) : nullptr;
      return shared(record(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
        if (form == nullptr) {  // F = (p, 0) up to a gradient: K = [[0, -1], [1, 0]]
          for (std::size_t k = 0; k < size / 2; ++k) {
            out[k * size + size / 2 + k] = Recorded(-1);
            out[(size / 2 + k) * size + k] = Recorded(1);
          }
          return;
        }
        const auto slope = jacobian(*form, t, z);  // slope[j][i] = d_i F_j
        for (std::size_t i = 0; i < size; ++i)
          for (std::size_t j = 0; j < size; ++j)
            out[i * size + j] = slope[j * size + i] - slope[i * size + j];
      }));
    }
    case Formula::covector: {
      if (!birkhoffian) return nullptr;
      const auto function = tape(Formula::birkhoffian), form = tape(Formula::one_form);
      return shared(record(n, n, [&](const Recorded& t, Arguments z, Results out) {
        const auto slope = gradient_of(*function, t, z);
        const auto form_t = time_derivative(*form, t, z);
        for (std::size_t k = 0; k < size; ++k) out[k] = -(slope[k] + form_t[k]);
      }));
    }
    case Formula::poisson_tensor: {
      if (source_.canonical)
        return shared(record(n, n * n, [&](const Recorded&, Arguments, Results out) {
          for (std::size_t k = 0; k < size / 2; ++k) {
            out[k * size + size / 2 + k] = Recorded(1);
            out[(size / 2 + k) * size + k] = Recorded(-1);
          }
        }));
      if (!structured) return nullptr;
      const auto structure = tape(Formula::structure);
      return shared(record(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
        const auto k = evaluate(*structure, t, z);
        for (std::size_t column = 0; column < size; ++column) {
          std::vector<Recorded> unit(size);
          unit[column] = Recorded(1);
          const auto x = solve(k, unit);
          for (std::size_t row = 0; row < size; ++row) out[row * size + column] = x[row];
        }
      }));
    }
    case Formula::constraints: {
      if (!content_.has(Facet::holonomic)) return nullptr;
      const auto phi = tape(Formula::holonomic), slopes = tape(Formula::hamiltonian_gradient);
      const auto count = static_cast<int>(phi->outputs.size());
      return shared(record(n, 2 * count, [&](const Recorded& t, Arguments z, Results out) {
        const auto q = z.first(size / 2);
        const auto values = evaluate(*phi, t, q), slope = evaluate(*slopes, t, z);
        const auto rates =
            directional_derivative(*phi, t, Recorded(1), q, Arguments(slope).subspan(size / 2));
        for (std::size_t k = 0; k < values.size(); ++k) {
          out[2 * k] = values[k];
          out[2 * k + 1] = rates[k];
        }
      }));
    }
    case Formula::constraint_gradients:
      if (!content_.has(Facet::constraints)) return nullptr;
      return shared(jacobian_tape(*tape(Formula::constraints)));
    case Formula::chart:
      if (!pivots_.empty()) return shared(linear_chart(*tape(Formula::structure), pivots_));
      return content_.has(Facet::darboux_chart) && !chart_given ? identity() : nullptr;
    case Formula::chart_inverse:
      if (!pivots_.empty()) return shared(linear_chart_inverse(*tape(Formula::structure), pivots_));
      return content_.has(Facet::darboux_chart) && !chart_given ? identity() : nullptr;
    case Formula::chart_field: {
      if (!content_.has(Facet::darboux_chart)) return nullptr;
      if (!chart_given && pivots_.empty()) return tape(Formula::field);  // the chart is the identity
      if (given(Formula::chart_hamiltonian)) {
        const auto energy = tape(Formula::chart_hamiltonian);
        return shared(record(n, n, [&](const Recorded& t, Arguments y, Results out) {
          canonical_sharp(gradient_of(*energy, t, y), out);
        }));
      }
      if (!birkhoffian)
        return shared(pulled_back_equations(*tape(Formula::structure), *tape(Formula::covector),
                                            *tape(Formula::chart_inverse)));
      return shared(pulled_back_field(*tape(Formula::one_form), *tape(Formula::birkhoffian),
                                      *tape(Formula::chart_inverse)));
    }
    case Formula::chart_field_jacobian:
      return shared(jacobian_tape(*tape(Formula::chart_field)));
    default:
      return nullptr;
  }
}

}  // namespace pfaff
