#include "targets.hpp"

#include <stdexcept>

#include <pfaff/app/state_file.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/config_file.hpp>
#include <pfaff/bench/runner/record.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff::fuzz {

namespace {
void require_one_line(const InputError& error) {
  const std::string text = error.what();
  if (text.empty() || text.find('\n') != std::string::npos)
    throw std::logic_error("a message that is not one line: '" + text + "'");
}

// What has been reached when `later` is done, which may refuse.
template <class Later>
Reached then(Later&& later) {
  try {
    later();
  } catch (const InputError& error) {
    require_one_line(error);
    return Reached::parsed;
  }
  return Reached::resolved;
}

void take_few_steps(const ResolvedRun& run) {
  if (run.adaptive() || run.steps > 8 || run.model->dimension() > 24) return;
  (void)execute(run, nullptr);
}

// The number of runs of an experiment, from which its resolution takes its time.
std::size_t runs_of(const Experiment& experiment) {
  std::size_t runs = 0;
  for (const ExperimentCase& c : experiment.cases)
    for (const ExperimentMethod& m : experiment.methods)
      runs += (!m.tolerances.empty() ? m.tolerances.size()
               : c.automatic         ? 1
                                     : c.steps.size()) *
              static_cast<std::size_t>(c.seeds + 1);
  return runs;
}

Reached read_and_resolve_state(const std::string& file) {
  RunSettings settings;
  app::read_state(file, settings);
  settings.system = settings.initial.size() == 4 ? "kepler" : "damped-oscillator";
  return then([&] { (void)resolve_state(settings); });
}
Reached read_and_resolve_configuration(const std::string& file) {
  const RunSettings settings = read_config(file).settings;
  return then([&] { take_few_steps(resolve(settings)); });
}
Reached read_and_resolve_experiment(const std::string& file) {
  const Experiment experiment = read_experiment(file, false);
  (void)read_experiment(file, true);
  if (runs_of(experiment) > 16) return Reached::parsed;
  return then([&] { (void)expand(experiment); });
}
Reached read_and_resolve_model(const std::string& file) {
  RunSettings settings;
  settings.system = "bead-rod";
  settings.set = {{"model", file}};
  const auto model = systems().get("bead-rod", "system").make(settings.set);
  settings.integrator = "rk4";
  settings.step = "0.01";
  settings.time = "0.02";
  settings.project_initial = model->restricted();
  return then([&] { take_few_steps(resolve(settings)); });
}
// A system is made and, where it moves, evaluated once.
Reached read_and_resolve_text(const std::string& file) {
  const auto system = TextSystem::read(file);
  return then([&] {
    const auto model = system->make({});
    if (!model->moves() || model->dimension() > 24) return;
    const auto field = make_evaluator<double>(model, Formula::field);
    std::vector<double> z(static_cast<std::size_t>(model->dimension()), 0.5), rate(z.size());
    field.call(field.context, 0.25, z.data(), rate.data());
  });
}
// A bracket is made again and evaluated once.
Reached read_and_resolve_bracket(const std::string& file) {
  const auto bracket = TextBracket::read(file);
  return then([&] {
    const BracketInstance made = bracket->make({});
    std::vector<double> z(2 * static_cast<std::size_t>(made.dimension), 0.5), vector(z.size());
    Replay<double>(made.sharp)(0.25, z.data(), vector.data());
  });
}
// A method takes two steps of systems that it fits. That its order conditions hold is asked when the file is
// read by all but the parser.
Reached read_and_resolve_table(const std::string& file) {
  { const TableDocument parsed(file); }
  return then([&] {
    const auto table = read_method_table(file);  // outlives its method
    const auto method = table->make({});
    for (const char* name : {"pendulum", "damped-pendulum"}) {
      const auto model = systems().get(name, "system").make({});
      if (!method->refuses(*model).empty()) continue;
      std::vector<double> z{0.5, 0.25};
      std::int64_t completed = 0;
      (void)method->stepper(model, 0.0)->advance(0, 0, 0.1, 2, z, completed);
    }
  });
}
}  // namespace

Reached read_and_resolve(Language language, const std::filesystem::path& file) {
  try {
    switch (language) {
      case Language::state:
        return read_and_resolve_state(file.string());
      case Language::configuration:
        return read_and_resolve_configuration(file.string());
      case Language::experiment:
        return read_and_resolve_experiment(file.string());
      case Language::model:
        return read_and_resolve_model(file.string());
      case Language::text:
        return read_and_resolve_text(file.string());
      case Language::bracket:
        return read_and_resolve_bracket(file.string());
      case Language::table:
        return read_and_resolve_table(file.string());
    }
  } catch (const InputError& error) {
    require_one_line(error);
  }
  return Reached::refused;
}

}  // namespace pfaff::fuzz
