#include <pfaff/derive/derivation/symbolic_formulas.hpp>

#include <pfaff/core/tape/sparse_gradients.hpp>
#include <pfaff/systems/bead_rod/system.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<Recorded>;

// (q, p, parameters) -> (H_q, H_p)
std::shared_ptr<const Tape> gradient_of(const Tape& energy, std::size_t variables) {
  return record_list(energy.inputs, [&](const Recorded& t, const Numbers& x, Numbers& out) {
    out.resize(variables);
    const SparseGradient slopes = sparse_gradients(energy, t, x, variables).front();
    for (const auto& entry : slopes) out[entry.first] = entry.second;
  });
}

// The symbols of beads on rods, in the order in which they are inputs: masses, lengths, gravity, friction.
class RodSymbols {
 public:
  RodSymbols(const BeadRodDescription& d, bool friction) : d_(d) {
    for (std::size_t i = 0; i < d.beads(); ++i) add("m" + std::to_string(i), "kg", d.masses[i]);
    lengths_ = values.size();
    for (std::size_t k = 0; k < d.rods.size(); ++k) add("l" + std::to_string(k), "m", d.rods[k].length);
    gravity_ = values.size();
    for (std::size_t x = 0; x < d.gravity.size(); ++x)
      if (!d.gravity[x].is(0)) add(std::string("g") + "xyz"[x], "m/s^2", d.gravity[x]);
    friction_ = values.size();
    // Beads without friction stay without it, because where S^D has its rank depends on them.
    if (!friction) return;
    for (std::size_t i = 0; i < d.friction.size(); ++i)
      if (!d.friction[i].is(0)) add("lambda" + std::to_string(i), "kg/s", d.friction[i]);
  }
  [[nodiscard]] bool rubs() const { return friction_ < values.size(); }

  // Each returns a function that gives the symbols of a kind by their index, where the first parameter is
  // input `first`.
  [[nodiscard]] auto masses(const Numbers& inputs, std::size_t first) const {
    return [&inputs, first](std::size_t i) -> const Recorded& { return inputs[first + i]; };
  }
  [[nodiscard]] auto lengths(const Numbers& inputs, std::size_t first) const {
    return masses(inputs, first + lengths_);
  }
  // The coefficients of all momenta.
  [[nodiscard]] Numbers friction(const Numbers& inputs, std::size_t first) const {
    Numbers lambda;
    std::size_t at = first + friction_;
    for (const Real& value : d_.friction)
      lambda.insert(lambda.end(), d_.axes(), value.is(0) ? Recorded(0) : inputs[at++]);
    return lambda;
  }
  // -sum_i m_i g.r_i
  [[nodiscard]] Recorded weight(const Numbers& inputs, std::size_t first) const {
    Recorded sum(0);
    std::size_t at = first + gravity_;
    for (std::size_t x = 0; x < d_.gravity.size(); ++x) {
      if (d_.gravity[x].is(0)) continue;
      for (std::size_t i = 0; i < d_.beads(); ++i)
        sum = sum - inputs[first + i] * inputs[at] * inputs[i * d_.axes() + x];
      ++at;
    }
    return sum;
  }

  std::vector<Symbol> names;
  std::vector<Real> values;

 private:
  void add(const std::string& name, const std::string& unit, const Real& value) {
    names.push_back({name, unit});
    values.push_back(value);
  }
  const BeadRodDescription& d_;
  std::size_t lengths_ = 0, gravity_ = 0, friction_ = 0;
};

SymbolicFormulas rod_formulas(const BeadRodDescription& d, bool friction) {
  const RodSymbols symbols(d, friction);
  const std::size_t n = d.beads() * d.axes(), count = symbols.values.size();
  BeadRodDescription weightless = d;
  weightless.gravity.clear();
  const BeadRodParts parts(std::move(weightless));
  const Tape energy = *record_list(
      static_cast<int>(2 * n + count), [&](const Recorded& /*t*/, const Numbers& x, Numbers& out) {
        const In<Recorded> z(x);
        const auto mass = symbols.masses(x, 2 * n);
        const auto twice = [&mass](std::size_t i) { return 2 * mass(i); };
        out.push_back(rod_kinetic_energy<Recorded>(d, twice, z.subspan(n, n)) +
                      (*potential_energy<Recorded>(parts))(z.first(n)) + symbols.weight(x, 2 * n));
      });
  SymbolicFormulas result;
  result.formulas.degrees = n;
  result.formulas.parameters = count;
  result.formulas.gradient = gradient_of(energy, 2 * n);
  result.formulas.values =
      record_list(static_cast<int>(n + count), [&](const Recorded& /*t*/, const Numbers& x, Numbers& out) {
        out.resize(d.rods.size());
        rod_constraint_values<Recorded>(d, symbols.lengths(x, n), In<Recorded>(x).first(n), out);
      });
  if (symbols.rubs())
    result.formulas.friction = record_list(static_cast<int>(2 * n + count),
                                           [&](const Recorded& /*t*/, const Numbers& x, Numbers& out) {
                                             append(out, symbols.friction(x, 2 * n));
                                           });
  result.parameters = symbols.names;
  result.values = symbols.values;
  return result;
}

}  // namespace

SymbolicFormulas symbolic_formulas(const Model& model, bool friction) {
  const auto constraints = model.holonomic_constraints<double>();
  if (const auto* rods = dynamic_cast<const DescribedByRods*>(constraints.get()))
    return rod_formulas(rods->description(), friction);
  SymbolicFormulas result;
  result.formulas.values = model.tape(Formula::holonomic);
  result.formulas.degrees = static_cast<std::size_t>(result.formulas.values->inputs);
  result.formulas.gradient =
      model.forced() ? slopes_of_motion(model)
                     : gradient_of(*model.tape(Formula::hamiltonian), 2 * result.formulas.degrees);
  if (friction && !model.frictionless()) result.formulas.friction = model.tape(Formula::friction);
  return result;
}

}  // namespace pfaff
