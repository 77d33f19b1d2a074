#include <pfaff/verify/falsification/falsify.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>

#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/parallel.hpp>
#include <pfaff/verify/falsification/drawn_parameters.hpp>
#include <pfaff/verify/falsification/trial.hpp>

namespace pfaff {

namespace {

using Clock = std::chrono::steady_clock;

// Sets of parameters that are drawn for each method.
constexpr int draws = 2;
// The sizes of recipes and the steps that successive systems of a kind take.
constexpr int sizes = 3;
const Real& step_of_round(std::uint64_t round) {
  static const std::array steps{Real::fraction(1, 4), Real::fraction(1, 10), Real::fraction(1, 2)};
  return steps[(round / sizes) % steps.size()];
}
// Every third system of a size is tried with several steps in a row, which show what a method makes of its
// past.
int count_of(std::uint64_t round) { return (round / sizes) % 3 == 2 ? 8 : 1; }
// No special time: driven systems are then not at one of their symmetries.
const Real& trial_time() {
  static const Real time = Real::fraction(37, 100);
  return time;
}

// One claim, the kinds of systems that it speaks of, and how far the search has come.
struct Search {
  FalsificationResult result;
  std::vector<SystemKind> kinds;
  std::uint64_t next = 0;
  [[nodiscard]] bool open() const { return !kinds.empty() && !result.counterexample; }
};

// One system of every kind and size, on which it is seen what a claim speaks of.
struct Sample {
  SystemKind kind;
  std::size_t dimension;
  std::shared_ptr<const Model> model;
};
const std::vector<Sample>& samples() {
  static const std::vector<Sample> all = [] {
    std::vector<Sample> list;
    for (int size = 0; size < sizes; ++size)
      for (const SystemKind kind : system_kinds) {
        const Recipe recipe = random_recipe(kind, 1, size);
        list.push_back({kind, recipe.dimension, model_of(system_of(recipe))});
      }
    return list;
  }();
  return all;
}

// The kinds whose systems the claim speaks of, those with the fewest variables first.
std::vector<SystemKind> kinds_for(const ClaimUnderTest& test) {
  std::vector<const Sample*> fitting;
  for (const Sample& sample : samples()) {
    const bool known = std::any_of(fitting.begin(), fitting.end(),
                                   [&](const Sample* other) { return other->kind == sample.kind; });
    if (!known && model_under_test(test, sample.model) != nullptr) fitting.push_back(&sample);
  }
  std::stable_sort(fitting.begin(), fitting.end(),
                   [](const Sample* a, const Sample* b) { return a->dimension < b->dimension; });
  std::vector<SystemKind> kinds;
  for (const Sample* sample : fitting) kinds.push_back(sample->kind);
  return kinds;
}

// Tries the next system of a search; a counterexample is shrunk at once.
void try_next(Search& search, std::uint64_t seed) {
  const std::uint64_t round = search.next / search.kinds.size();
  const SystemKind kind = search.kinds[search.next % search.kinds.size()];
  ++search.next;
  const Recipe recipe =
      random_recipe(kind, seed + 1000 * round, static_cast<int>(round % static_cast<std::uint64_t>(sizes)));
  if (model_under_test(search.result.test, model_of(system_of(recipe))) == nullptr) return;
  ++search.result.tried;
  auto found = counterexample_in(search.result.test, recipe,
                                 {nullptr, {}, trial_time(), step_of_round(round), count_of(round)});
  if (found) search.result.counterexample = shrink(search.result.test, std::move(*found));
}

}  // namespace

std::vector<ClaimUnderTest> claims_under_test(const std::shared_ptr<const MethodInstance>& method,
                                              const Assignments& parameters, std::optional<Claim> claim,
                                              bool not_made_too) {
  std::vector<ClaimUnderTest> tests;
  // What a method claims may depend on the system: all that it claims on some system is put to the test.
  for (const ClaimRow& row : claim_table) {
    spend(0, 0);
    if (claim && *claim != row.claim) continue;
    const ClaimUnderTest made{method, parameters, row.claim, true};
    const bool makes = !kinds_for(made).empty();
    if (makes || (claim && not_made_too)) tests.push_back({method, parameters, row.claim, makes});
  }
  return tests;
}

std::vector<ClaimUnderTest> claims_under_test(const MethodPlugin& plugin, const Assignments& parameters,
                                              std::optional<Claim> claim, std::uint64_t seed) {
  std::vector<ClaimUnderTest> tests;
  const auto add = [&](const Assignments& assignments, bool drawn) {
    for (ClaimUnderTest& test : claims_under_test(plugin.make(assignments), assignments, claim, !drawn))
      tests.push_back(std::move(test));
  };
  if (!parameters.empty()) {
    add(parameters, false);
    return tests;
  }
  const std::vector<Assignments> instances = plugin.instances(false);
  for (const Assignments& assignments : instances) add(assignments, false);
  for (const Assignments& assignments : drawn_parameters(plugin, instances, seed, draws))
    add(assignments, true);
  return tests;
}

Claim claim_named(const std::string& name) {
  std::vector<std::string> names;
  for (const ClaimRow& row : claim_table) {
    if (row.name == name) return row.claim;
    names.emplace_back(row.name);
  }
  throw InputError(unknown_name("claim", name, names));
}

namespace {
// What a search has done so far.
std::string done_so_far(const std::vector<Search>& searches) {
  int tried = 0;
  std::size_t falsified = 0;
  for (const Search& search : searches) {
    tried += search.result.tried;
    falsified += search.result.counterexample ? 1 : 0;
  }
  return std::to_string(searches.size()) + " claims were tried on " + std::to_string(tried) +
         " random systems, and " + std::to_string(falsified) + " falsified";
}

// Fills in the results.
void search_all(std::vector<Search>& searches, std::vector<ClaimUnderTest> tests,
                const FalsificationSettings& settings,
                const std::function<void(const std::string& what, double fraction)>& progress) {
  const auto begin = Clock::now();
  const auto spent = [&] {
    return std::chrono::duration<double>(Clock::now() - begin).count() / settings.budget;
  };
  in_parallel(tests.size(), [&](std::size_t k) {
    searches[k].result.test = std::move(tests[k]);
    // Computed again, since a test may come from elsewhere.
    searches[k].kinds = kinds_for(searches[k].result.test);
  });
  // The first system is tried on every claim, whatever the budget.
  for (bool first = true; first || spent() < 1; first = false) {
    std::atomic<bool> open = false;
    in_parallel(searches.size(), [&](std::size_t k) {
      Search& search = searches[k];
      if (!search.open() || search.next >= settings.systems || (!first && spent() >= 1)) return;
      open = true;
      if (progress)
        progress(search.result.test.method->descriptor().name + ": " +
                     std::string(to_string(search.result.test.claim)),
                 std::min(spent(), 1.0));
      try_next(search, settings.seed);
    });
    if (!open) break;
  }
}
}  // namespace

std::vector<FalsificationResult> falsify(
    std::vector<ClaimUnderTest> tests, const FalsificationSettings& settings,
    const std::function<void(const std::string& what, double fraction)>& progress) {
  std::vector<Search> searches(tests.size());
  try {
    search_all(searches, std::move(tests), settings, progress);
  } catch (const BudgetSpent& spent) {
    end_interrupted(spent, done_so_far(searches));
  }
  std::vector<FalsificationResult> results;
  for (Search& search : searches) results.push_back(std::move(search.result));
  return results;
}

}  // namespace pfaff
