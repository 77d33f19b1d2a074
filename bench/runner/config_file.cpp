// Reading the config.toml of a run, which is all that is needed to run it again.
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/runner/toml_keys.hpp>

namespace pfaff {

RunSettings read_config(const std::string& path) {
  const toml::table root = parse_toml(path);
  Keys keys(root, path);
  if (const std::string schema = keys.required("schema"); schema != "1")
    throw InputError(path + ": key 'schema': expected 1, got " + schema);
  RunSettings settings;
  settings.system = keys.required("system");
  settings.integrator = keys.required("integrator");
  settings.formulation = keys.text("formulation", "");
  settings.precision = parse_precision(keys.text("precision", "double"));
  settings.t0 = keys.text("t0", "0");
  settings.time = keys.required("time");
  settings.step = keys.text("step", "");
  settings.tolerance = keys.text("tolerance", "");
  if (const std::string every = keys.text("every", ""); !every.empty())
    settings.every = parse_every(every, path + ": key 'every'");
  settings.allow_inconsistent = keys.text("allow_inconsistent", "no") == "yes";
  settings.initial = keys.list("initial");
  settings.set = keys.assignments("set");
  keys.finish();
  return settings;
}

}  // namespace pfaff
