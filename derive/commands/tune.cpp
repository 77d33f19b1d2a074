// The command tune: a splitting, processed or not, whose shadow terms are small on one system, as a table of
// coefficients.
#include <filesystem>
#include <iostream>
#include <optional>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/interruption.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/derive/commands/commands.hpp>
#include <pfaff/derive/tuning/tuned_splitting.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {

namespace {

namespace fs = std::filesystem;

// The shadow terms of a registered splitting or one of a file, on the system.
double error_of(const std::string& method, const SplittingLogarithm& logarithm, const ShadowTerms& terms) {
  const auto theory = order_theory(integrator_asked_for(method).name(), {});
  if (!theory || theory->kind != "words" || theory->sums.size() != theory->coefficients.size())
    throw InputError("--beside " + method + ": expected a splitting by its table of coefficients");
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k < theory->coefficients.size(); ++k)
    flows.push_back({static_cast<std::size_t>(theory->sums[k]), theory->coefficients[k]});
  return terms.of(logarithm.of(flows).brackets);
}

// Whether `pfaff verify` finds nothing wrong with the method of that file.
bool verified(const std::string& file, const Common& common) {
  ProgressLine line(common.quiet);
  bool ok = true;
  VerificationSettings settings;
  settings.names = {file};
  for (const Check& check : verify(settings, [&](const std::string&what, std::size_t done, std::size_t all) {
         line.show(what, static_cast<double>(done) / static_cast<double>(all));
       }))
    ok = ok && good(check);
  return ok;
}

// Palindromes of order 6 are made for the system's own kind of kinetic energy.
Parts parts_for(const Model& model, const TuningSettings& settings) {
  constexpr int first_with_fewer_conditions = 6;
  return settings.processor == 0 && settings.order >= first_with_fewer_conditions &&
                 quadratic_in_momenta(model)
             ? Parts::quadratic_kinetic
             : Parts::general;
}

}  // namespace

int tune_command(const TuningOptions& options, const Common& common) {
  if (!(options.step > 0))
    throw InputError("--step: expected the step that the method is tuned for, above 0");
  const Interruption interruption;
  const std::string name = options.name.empty() ? "tuned-splitting" : options.name;
  if (!is_kebab_case(name))
    throw InputError("--name '" + name + "': expected kebab-case, such as 'tuned-pendulum'");
  if (!options.out.empty() && fs::path(options.out).extension() != ".toml")
    throw InputError("--out '" + options.out + "': expected a file that ends in .toml");
  if (!options.out.empty()) check_new_file(options.out, "--out");
  const SystemPlugin& system = system_asked_for(options.system);
  const auto model = system.make(options.set);
  TuningSettings settings = options.tuning;
  settings.parts = parts_for(*model, settings);
  check(settings);
  constexpr int states = 200;
  const bool processed = settings.processor > 0;
  const SplittingLogarithm logarithm(settings.order, processed ? Degrees::all : Degrees::odd, settings.parts);
  const ShadowTerms terms(*model, logarithm, options.step, states_along_the_motion(model, states));
  std::vector<std::pair<std::string, double>> others;
  for (const std::string& method : options.beside)
    others.emplace_back(method, error_of(method, logarithm, terms));

  TunedSplitting tuned;
  {
    ProgressLine line(common.quiet);
    tuned = tuned_splitting(logarithm, terms, settings,
                            [&](double fraction) { line.show("starts of the search", fraction); });
  }
  const std::string table_text = splitting_table(tuned, name, options.tuning.order, system.name());
  std::optional<bool> ok;
  std::string not_written;  // why; the table of a long search is then printed nevertheless
  if (!options.out.empty()) try {
      write_new_file(options.out, table_text);
      ok = verified(options.out, common);
    } catch (const RunError& error) {
      not_written = error.what();
    }
  if (common.json) {
    nlohmann::json beside = nlohmann::json::array();
    for (const auto& [method, error] : others)
      beside.push_back({{"method", method}, {"shadow_error", error}});
    std::cout << json_text(
        {{"schema", 1},
         {"ok", ok.value_or(not_written.empty())},
         {"system", system.name()},
         {"order", options.tuning.order},
         {"stages", options.tuning.stages},
         {"step", options.step},
         {"shadow_error", tuned.error},
         {"processor", options.tuning.processor},
         {"kernel_error", processed ? nlohmann::json(tuned.error_of_kernel) : nlohmann::json(nullptr)},
         {"beside", beside},
         {"verified", ok ? nlohmann::json(*ok) : nlohmann::json(nullptr)},
         {"table", table_text}});
  } else if (common.quiet) {
    if (!not_written.empty()) std::cout << table_text;
  } else {
    std::cout << table_text << '\n';
    TableRows rows{{"splitting", "shadow terms"}, {name, scientific(tuned.error)}};
    if (processed) rows.push_back({"what no processor removes of it", scientific(tuned.error_of_kernel)});
    for (const auto& [method, error] : others) rows.push_back({method, scientific(error)});
    std::cout << table(rows)
              << paragraph(
                     "(shadow terms: the size of the two leading orders of what the splitting adds to the "
                     "motion, relative to it, at this step along the motion)");
    if (ok)
      std::cout << options.out << (*ok ? ": verified\n" : ": NOT OK, see pfaff verify " + options.out + "\n");
  }
  if (!not_written.empty()) throw RunError(not_written + "; the table is in the output");
  return ok.value_or(true) ? 0 : 1;
}

}  // namespace pfaff
