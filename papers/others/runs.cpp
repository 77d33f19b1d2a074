#include <algorithm>
#include <filesystem>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/papers/others/rows.hpp>

namespace pfaff::others {

std::string example(const std::string& name) {
  return shipped_path(std::filesystem::path("examples") / name).string();
}

ResolvedRun resolved(const Asked& asked) {
  RunSettings settings;
  settings.system = asked.system;
  settings.integrator = asked.integrator;
  settings.set = asked.set;
  settings.step = asked.step;
  settings.time = asked.time;
  settings.initial = asked.initial;
  return resolve(settings);
}

Numbers solution_at_end(const ResolvedRun& run) {
  return reference_of(run)->at(run.t0.quad() + run.time.quad());
}

Numbers state_at_end(const std::string& system, const std::string& integrator, const std::string& tolerance,
                     const std::string& time) {
  RunSettings settings;
  settings.system = system;
  settings.integrator = integrator;
  settings.tolerance = tolerance;
  settings.time = time;
  const ResolvedRun run = resolve(settings);
  Integration<double> integration(start_of<double>(run));
  integration.to((run.t0 + run.time).value()).expect_reached();
  return {integration.state().begin(), integration.state().end()};
}

template <class T>
void follow(const ResolvedRun& run, const std::function<void(const std::vector<T>&)>& each) {
  Integration<T> integration(start_of<T>(run));
  const auto look = [&] { each({integration.state().begin(), integration.state().end()}); };
  look();
  for (std::int64_t step = 0; step < run.steps; ++step) {
    integration.steps(1).expect_reached();
    look();
  }
}

template <class T>
EnergyError energy_error(const ResolvedRun& run) {
  const auto invariants = make_evaluator<T>(run.model, Formula::invariants);
  std::vector<T> values(run.model->invariants().size());
  EnergyError error;
  bool first = true;
  T start(0);
  follow<T>(run, [&](const std::vector<T>& z) {
    invariants.call(invariants.context, T(0), z.data(), values.data());
    if (first) start = values.front();
    first = false;
    error.last = Quad(values.front() - start);
    error.largest = std::max(error.largest, std::abs(static_cast<double>(error.last)));
  });
  return error;
}

template void follow<double>(const ResolvedRun&, const std::function<void(const std::vector<double>&)>&);
template void follow<Quad>(const ResolvedRun&, const std::function<void(const std::vector<Quad>&)>&);
template EnergyError energy_error<double>(const ResolvedRun&);
template EnergyError energy_error<Quad>(const ResolvedRun&);

}  // namespace pfaff::others
