#include <pfaff/bench/runner/stated_identities.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
constexpr int most_coordinates = 64;
constexpr double most_off = 1e-6;

// The results first .. first + count - 1 of the written formula minus those of the derived one.
std::shared_ptr<const Tape> tape_of_difference(const Tape& written, const Tape& derived, std::size_t first,
                                               std::size_t count) {
  return expression(written.inputs, static_cast<int>(count),
                    [&](const Recorded& t, Arguments z, Results out) {
                      const auto a = evaluate(written, t, z), b = evaluate(derived, t, z);
                      for (std::size_t k = 0; k < count; ++k) out[k] = a[first + k] - b[first + k];
                    });
}

// "chart_field" as "chart field".
std::string spoken(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

using Rounded = WithRounding<double>;

// The results of a tape at a state, whose first coordinates are those that it reads, with their bounds.
std::vector<Rounded> results_of(const std::shared_ptr<const Tape>& tape, const Real& t,
                                const std::vector<Real>& z) {
  std::vector<Rounded> out(tape->outputs.size()), state;
  for (const Real& x : z) state.emplace_back(x);
  state.resize(std::max(state.size(), static_cast<std::size_t>(tape->inputs)));
  Replay<Rounded> replay(tape);
  replay(Rounded(t), state.data(), out.data());
  return out;
}

// The largest result over the sum of the sizes of its terms; 0 where one has no value.
double relative_to_terms(const std::vector<Rounded>& results) {
  double worst = 0;
  for (const Rounded& x : results) {
    if (!std::isfinite(x.value) || !std::isfinite(x.error)) return 0;
    worst = std::max(worst, relative_to_rounding(x));
  }
  return worst;
}

bool singular(const std::vector<Rounded>& matrix, std::size_t n) {
  LU<Rounded> lu(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const Rounded& x = matrix[i * n + j];
      if (!std::isfinite(x.value)) return false;
      lu(i, j) = x;
    }
  if (!lu.factor()) return true;
  for (std::size_t i = 0; i < n; ++i)
    if (!lu(i, i).significant()) return true;
  return false;
}

std::vector<StatedIdentity> identities_of(const Model& model) {
  std::vector<StatedIdentity> all = written_formulas(model);
  if (model.facets().has(Facet::structure))
    all.push_back({"K is skew", symmetric_part(*model.tape(Formula::structure), model.dimension())});
  if (model.given(Formula::poisson_tensor))
    all.push_back(
        {"bracket is skew", symmetric_part(*model.tape(Formula::poisson_tensor), model.dimension())});
  return all;
}

// A state within a twentieth of each coordinate of another one.
std::vector<Real> state_beside(const std::vector<Real>& z) {
  double size = 0;
  for (const Real& x : z) size = std::max(size, std::abs(x.value()));
  if (size == 0) size = 1;
  std::vector<Real> moved;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double own = std::abs(z[k].value()), by = (own == 0 ? size : own) / static_cast<double>(20 + k);
    moved.push_back(z[k] + Real(Quad(k % 2 == 0 ? by : -by)));
  }
  return moved;
}

// What a run looks at before it begins: the results of a tape at a state, and at one beside it a little
// later.
struct NearStart {
  std::vector<Rounded> here, beside;
};
NearStart near_start(const std::shared_ptr<const Tape>& tape, const Real& t, const std::vector<Real>& z) {
  return {results_of(tape, t, z), results_of(tape, t + Real::fraction(1, 20), state_beside(z))};
}

// The invariants that are conserved at every state. With constraints they are where these hold, which a state
// near the initial one is not.
std::vector<std::size_t> conserved_everywhere(const Model& model) {
  std::vector<std::size_t> conserved;
  if (model.restricted() || !model.moves()) return conserved;
  for (std::size_t k = 0; k < model.invariants().size(); ++k)
    if (model.invariants()[k].behaviour == Behaviour::conserved) conserved.push_back(k);
  return conserved;
}
}  // namespace

std::shared_ptr<const Tape> symmetric_part(const Tape& tensor, int n) {
  const auto size = static_cast<std::size_t>(n);
  return expression(n, n * n, [&](const Recorded& t, Arguments z, Results out) {
    const auto pi = evaluate(tensor, t, z);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) out[i * size + j] = pi[i * size + j] + pi[j * size + i];
  });
}

std::shared_ptr<const Tape> rates_of_invariants(const Model& model, const std::vector<std::size_t>& which) {
  const auto values = model.tape(Formula::invariants), field = model.tape(Formula::field);
  const auto count = static_cast<int>(which.size());
  return expression(model.dimension(), count, [&](const Recorded& t, Arguments z, Results out) {
    const auto x = evaluate(*field, t, z);
    const auto rates = directional_derivative(*values, t, Recorded(1), z, x);
    for (std::size_t k = 0; k < which.size(); ++k) out[k] = rates[which[k]];
  });
}

std::vector<StatedIdentity> written_formulas(const Model& model) {
  std::vector<StatedIdentity> all;
  for (const FormulaRow& row : formula_table) {
    if (!row.traits.unique || !model.given(row.formula)) continue;
    // For a system with constraints the formulas alone make the field without reactions, which is not that of
    // its motion.
    if (row.formula == Formula::field && model.restricted()) continue;
    // Zero where they are left out, which is a default: nothing says what they should be.
    if (row.formula == Formula::velocity_offsets) continue;
    const auto derived = model.derived(row.formula);
    if (derived == nullptr) continue;
    const auto written = model.tape(row.formula);
    const auto compare = [&](const std::string& what, std::size_t first, std::size_t count) {
      all.push_back(
          {"written " + what + " is the derived one", tape_of_difference(*written, *derived, first, count)});
    };
    if (row.formula == Formula::constraint_gradients) {
      const std::vector<std::string> names = model.constraint_names();
      const auto size = static_cast<std::size_t>(model.dimension());
      for (std::size_t i = 0; i < names.size(); ++i) compare("gradient of " + names[i], i * size, size);
    } else {
      compare(spoken(row.name), 0, written->outputs.size());
    }
  }
  return all;
}

namespace {
// What a model states, as expressions.
struct Stated {
  std::vector<StatedIdentity> identities;
  std::vector<std::size_t> conserved;  // invariants,
  std::shared_ptr<const Tape> rates;   // and theirs; null where there are none
};

// Recording them takes as long as many a run, so that those of the models that were looked at last are kept.
std::shared_ptr<const Stated> stated_by(const std::shared_ptr<const Model>& model) {
  struct Kept {
    std::weak_ptr<const Model> model;
    std::shared_ptr<const Stated> stated;
  };
  constexpr std::size_t most = 8;
  static std::mutex mutex;
  static std::deque<Kept> kept;
  {
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [](const Kept& one) { return one.model.expired(); });
    for (const Kept& one : kept)
      if (one.model.lock() == model) return one.stated;
  }
  const std::vector<std::size_t> conserved = conserved_everywhere(*model);
  auto stated = std::make_shared<const Stated>(
      Stated{identities_of(*model), conserved,
             conserved.empty() ? nullptr : rates_of_invariants(*model, conserved)});
  const std::lock_guard lock(mutex);
  kept.push_front({model, stated});
  if (kept.size() > most) kept.pop_back();
  return stated;
}
}  // namespace

void check_stated_identities(const std::shared_ptr<const Model>& of, const Real& t,
                             const std::vector<Real>& z) {
  const Model& model = *of;
  if (model.dimension() > most_coordinates) return;
  if (model.facets().has(Facet::structure)) {
    const auto structure = model.tape(Formula::structure);
    if (singular(results_of(structure, t, z), static_cast<std::size_t>(model.dimension())))
      throw InputError("system " + model.name() +
                       ": K is singular at the initial state; expected a regular matrix");
  }
  for (const StatedIdentity& stated : stated_by(of)->identities) {
    const NearStart residuals = near_start(stated.residual, t, z);
    const double first = relative_to_terms(residuals.here), second = relative_to_terms(residuals.beside);
    if (std::max(first, second) <= most_off) continue;
    throw InputError("system " + model.name() + ": false " +
                     (first > most_off ? "at the initial state" : "at a state near the initial one") + ": " +
                     stated.words + " (off by " + formatted("%.2g", std::max(first, second)) +
                     " of its terms); `pfaff verify` looks at all that a system states");
  }
}

std::string not_conserved(const std::shared_ptr<const Model>& of, const Real& t, const std::vector<Real>& z) {
  const Model& model = *of;
  if (model.dimension() > most_coordinates) return {};
  const auto stated = stated_by(of);
  const std::vector<std::size_t>& conserved = stated->conserved;
  if (conserved.empty()) return {};
  const NearStart rates = near_start(stated->rates, t, z);
  std::string names;
  int count = 0;
  double worst = 0;
  for (std::size_t k = 0; k < conserved.size(); ++k) {
    const double off = std::max(relative_to_terms({rates.here[k]}), relative_to_terms({rates.beside[k]}));
    if (off <= most_off) continue;
    names += (count++ == 0 ? "" : ", ") + model.invariants()[conserved[k]].name;
    worst = std::max(worst, off);
  }
  if (count == 0) return {};
  const std::string size =
      std::isfinite(worst) ? formatted("%.2g of its terms", worst) : "a single term, and not zero";
  return "system " + model.name() + ": " + names +
         (count == 1 ? " is said to be conserved, but the motion changes it (its rate is "
                     : " are said to be conserved, but the motion changes them (a rate is ") +
         size +
         "), so that the drift is not the method's alone; "
         "expected the behaviour free, decreasing or increasing";
}

}  // namespace pfaff
