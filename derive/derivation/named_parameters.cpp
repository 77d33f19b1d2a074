#include <pfaff/derive/derivation/named_parameters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <tuple>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/derive/derivation/scaled.hpp>

namespace pfaff {

namespace {

/// A parameter that may be a symbol: its value, and others near it, each with a prime factor of its own.
struct Candidate {
  const Parameter* parameter;
  Real value;
  std::array<std::int64_t, 3> prime;
  std::array<Real, 3> sample;
};

bool is_prime(std::int64_t n) {
  for (std::int64_t k = 2; k * k <= n; ++k)
    if (n % k == 0) return false;
  return n > 1;
}

/// Whether a constant of the equations has a prime as a factor, as 9.81 has 109.
bool is_factor(std::int64_t prime, const std::vector<Real>& constants) {
  return std::any_of(constants.begin(), constants.end(), [prime](const Real& x) {
    return x.is_fraction() && (x.numerator() % prime == 0 || x.denominator() % prime == 0) && !x.is(0);
  });
}

/// A prime times a power of two near `value`. It is no factor of the constants of the equations, by which it
/// would be lost among these; `taken` are the primes that are in use.
std::optional<std::pair<std::int64_t, Real>> sample_near(const Parameter& parameter, const Real& value,
                                                         const std::vector<Real>& constants,
                                                         std::vector<std::int64_t>& taken) {
  constexpr int least = 128;
  const double size = std::abs(value.value());
  const int shift = 7 - static_cast<int>(std::floor(std::log2(size)));
  if (std::abs(shift) > 30) return std::nullopt;
  const double scaled = std::ldexp(size, shift);  // in 128 .. 256
  for (int step = 0; step < 200; ++step) {
    const std::int64_t prime =
        static_cast<std::int64_t>(scaled) + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
    if (prime < least / 2 || !is_prime(prime) || is_factor(prime, constants) ||
        std::find(taken.begin(), taken.end(), prime) != taken.end())
      continue;
    const Real magnitude =
        shift < 0 ? Real::fraction(prime << -shift, 1) : Real::fraction(prime, std::int64_t{1} << shift);
    const Real sample = value < Real(0) ? -magnitude : magnitude;
    if (sample.value() < parameter.minimum || sample.value() > parameter.maximum) continue;
    taken.push_back(prime);
    return std::pair{prime, sample};
  }
  return std::nullopt;
}

std::vector<Candidate> candidates_of(const SystemPlugin& system, const Model& model,
                                     const std::vector<Real>& constants) {
  std::vector<Candidate> found;
  std::vector<std::int64_t> taken;
  for (const Parameter& parameter : system.parameters()) {
    if (parameter.kind != Parameter::Kind::real) continue;
    for (const auto& [name, text] : model.parameters()) {
      const std::optional<Real> value = name == parameter.name ? Real::parse(text) : std::nullopt;
      if (!value || value->is(0)) continue;
      Candidate candidate{&parameter, *value, {}, {}};
      bool possible = true;
      for (std::size_t k = 0; k < candidate.sample.size() && possible; ++k) {
        const auto sample = sample_near(parameter, *value, constants, taken);
        possible = sample.has_value();
        if (sample) std::tie(candidate.prime[k], candidate.sample[k]) = *sample;
      }
      if (possible) found.push_back(candidate);
    }
  }
  return found;
}

/// r times powers of the candidates.
struct Monomial {
  Real factor;
  std::vector<int> exponents;
};

Real power_of(const Real& x, int exponent) {
  Real product = 1;
  for (int k = 0; k < std::abs(exponent); ++k) product = product * x;
  return exponent < 0 ? 1 / product : product;
}

int multiplicity(std::int64_t number, std::int64_t prime) {
  int count = 0;
  for (number = std::abs(number); number != 0 && number % prime == 0; number /= prime) ++count;
  return count;
}

/// The monomial that is `constant` at the samples number `which`; none where the constant is no fraction.
std::optional<Monomial> monomial_of(const Real& constant, const std::vector<Candidate>& candidates,
                                    std::size_t which) {
  if (!constant.is_fraction() || constant.is(0)) return std::nullopt;
  Monomial m{constant, {}};
  for (const Candidate& c : candidates) {
    m.exponents.push_back(multiplicity(constant.numerator(), c.prime[which]) -
                          multiplicity(constant.denominator(), c.prime[which]));
    m.factor = m.factor / power_of(c.sample[which], m.exponents.back());
  }
  if (!m.factor.is_fraction()) return std::nullopt;
  return m;
}

bool same_instruction(const Instruction& a, const Instruction& b) {
  return a.operation == b.operation && a.a == b.a && a.b == b.b && a.c == b.c;
}
bool same_form(const Tape& a, const Tape& b) {
  return a.time_begin == b.time_begin && a.state_begin == b.state_begin && a.outputs == b.outputs &&
         a.constants.size() == b.constants.size() && a.solves.empty() && b.solves.empty() &&
         std::equal(a.code.begin(), a.code.end(), b.code.begin(), b.code.end(), same_instruction);
}

class Search {
 public:
  Search(const SystemPlugin& system, const Assignments& settings, const Deriver& deriver)
      : system_(system), settings_(settings), deriver_(deriver) {}

  /// The equations with all candidates as symbols; nothing where one of those from number `first` on cannot
  /// be.
  std::optional<Equations> symbolic(const std::vector<Candidate>& candidates, std::size_t first) const {
    std::optional<Equations> found = symbolic_near_values(candidates);
    for (std::size_t k = first; found && k < candidates.size(); ++k)
      if (!holds_far_away(*found, candidates, k)) found.reset();
    return found;
  }

 private:
  std::optional<Equations> symbolic_near_values(const std::vector<Candidate>& candidates) const {
    std::array<std::optional<Equations>, 3> at;
    for (std::size_t which = 0; which < at.size(); ++which) {
      at[which] = with(candidates, which);
      if (!at[which] || !same_form(at[which]->tape, at[0]->tape)) return std::nullopt;
    }
    const Tape& tape = at[0]->tape;
    std::vector<Monomial> monomials;
    for (std::size_t k = 0; k < tape.constants.size(); ++k) {
      std::array<std::optional<Monomial>, 3> m;
      bool varies = false;
      for (std::size_t which = 0; which < m.size(); ++which) {
        const Real& constant = at[which]->tape.constants[k];
        m[which] = monomial_of(constant, candidates, which);
        varies = varies || !(constant == tape.constants[k]);
      }
      if (!varies) {
        monomials.push_back({tape.constants[k], std::vector<int>(candidates.size(), 0)});
        continue;
      }
      for (const auto& other : m)
        if (!other || !(other->factor == m[0]->factor) || other->exponents != m[0]->exponents)
          return std::nullopt;
      monomials.push_back(*m[0]);
    }
    // Exponents of powers are numbers.
    for (const Instruction& i : tape.code)
      if (i.operation == Operation::power) {
        const std::vector<int>& e = monomials[static_cast<std::size_t>(i.b)].exponents;
        if (std::any_of(e.begin(), e.end(), [](int k) { return k != 0; })) return std::nullopt;
      }
    Equations equations = *at[0];
    equations.tape = replaced(tape, candidates.size(), monomials);
    for (const Candidate& c : candidates) {
      equations.parameters.push_back({c.parameter->name, c.parameter->unit});
      equations.parameter_values.push_back(c.value);
    }
    return equations;
  }

  // Whether the equations are those of the system, too, where the parameter has the other sign or another
  // size: it may enter through min, max, abs or a choice between formulas. What the system refuses says
  // nothing.
  [[nodiscard]] bool holds_far_away(const Equations& equations, const std::vector<Candidate>& candidates,
                                    std::size_t which) const {
    const Candidate& c = candidates[which];
    for (const Real& share : {Real(-1), Real(64), Real::fraction(1, 64)}) {
      const Real value = share * c.value;
      if (value.value() < c.parameter->minimum || value.value() > c.parameter->maximum) continue;
      Assignments settings = settings_;
      settings.emplace_back(c.parameter->name, to_string(value));
      try {
        const std::shared_ptr<const Model> model = system_.make(settings);
        std::vector<Quad> z;
        for (const Real& x : model->initial())
          z.push_back(x.quad() + Quad(static_cast<double>(z.size() + 1) / 16));
        z.resize(static_cast<std::size_t>(equations.tape.inputs) - candidates.size(), Quad(1));
        const std::vector<Quad> expected = values_at(deriver_(*model).tape, z);
        for (const Candidate& other : candidates) z.push_back((&other == &c ? value : other.value).quad());
        if (!agree(values_at(equations.tape, z), expected)) return false;
      } catch (const InputError&) {
        continue;
      }
    }
    return true;
  }
  static std::vector<Quad> values_at(const Tape& tape, const std::vector<Quad>& z) {
    std::vector<Quad> values(tape.outputs.size());
    Replay<Quad> replay({std::shared_ptr<const Tape>(), &tape});
    replay(Real::fraction(1, 3).quad(), z.data(), values.data());
    return values;
  }
  static bool agree(const std::vector<Quad>& a, const std::vector<Quad>& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      if (isfinite(a[k]) && isfinite(b[k]) && abs(a[k] - b[k]) > Quad(1e-20) * (abs(a[k]) + abs(b[k])))
        return false;
    return true;
  }

  // The equations where the candidates have their samples number `which`.
  [[nodiscard]] std::optional<Equations> with(const std::vector<Candidate>& candidates,
                                              std::size_t which) const {
    Assignments settings;
    const auto chosen = [&](const std::string& name) {
      return std::any_of(candidates.begin(), candidates.end(),
                         [&](const Candidate& c) { return c.parameter->name == name; });
    };
    for (const auto& setting : settings_)
      if (!chosen(setting.first)) settings.push_back(setting);
    for (const Candidate& c : candidates)
      settings.emplace_back(c.parameter->name, to_string(c.sample[which]));
    try {
      return deriver_(*system_.make(settings));
    } catch (const InputError&) {  // a system may refuse combinations of values
      return std::nullopt;
    }
  }

  // The tape with monomials of new inputs, after all others, in the place of its constants.
  static Tape replaced(const Tape& tape, std::size_t count, const std::vector<Monomial>& monomials) {
    const auto first = static_cast<std::size_t>(tape.inputs);
    Tape open = tape;  // reads its constants as inputs
    open.inputs += static_cast<int>(tape.constants.size());
    open.time_begin = open.state_begin = 0;
    for (Instruction& i : open.code)
      if (i.operation == Operation::constant) i = {Operation::input, tape.inputs + i.a, 0, 0};
    Recorder recorder(static_cast<int>(first + count));
    std::vector<Recorded> inputs = recorder.inputs();
    std::vector<Recorded> z(inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(first));
    for (const Monomial& m : monomials) {
      Recorded over(m.factor), under(1);
      for (std::size_t k = 0; k < count; ++k)
        for (int times = 0; times < std::abs(m.exponents[k]); ++times)
          (m.exponents[k] > 0 ? over : under) *= inputs[first + k];
      z.push_back(under.is(1) ? over : over / under);
    }
    std::vector<Recorded> results(tape.outputs.size());
    Replay<Recorded> replay({std::shared_ptr<const Tape>(), &open});
    replay(recorder.time(), z.data(), results.data());
    return simplified(recorder.finish(results));
  }

  const SystemPlugin& system_;
  const Assignments& settings_;
  const Deriver& deriver_;
};

}  // namespace

Equations with_named_parameters(const SystemPlugin& system, const Assignments& settings,
                                const Deriver& deriver) {
  const std::shared_ptr<const Model> model = system.make(settings);
  Equations equations = deriver(*model);
  if (!equations.parameters.empty()) return equations;
  const Search search(system, settings, deriver);
  std::vector<Candidate> chosen = candidates_of(system, *model, equations.tape.constants);
  if (chosen.empty()) return equations;
  if (auto found = search.symbolic(chosen, 0)) return keep_used(std::move(*found));
  // One by one, so that one that cannot be a symbol keeps no other from being one.
  std::vector<Candidate> kept;
  std::optional<Equations> best;
  for (const Candidate& candidate : chosen) {
    kept.push_back(candidate);
    if (auto found = search.symbolic(kept, kept.size() - 1)) {
      best = std::move(found);
    } else {
      kept.pop_back();
    }
  }
  return best ? keep_used(std::move(*best)) : equations;
}

}  // namespace pfaff
