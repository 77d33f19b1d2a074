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
  settings.precision = parse_precision(keys.text("precision", "double"));
  settings.t0 = keys.text("t0", "0");
  settings.time = keys.required("time");
  settings.step = keys.text("step", "");
  settings.tolerance = keys.text("tolerance", "");
  const std::string every = keys.text("every", "0");
  const auto number = Real::parse(every);
  if (!number || !number->is_fraction() || number->denominator() != 1 || number->numerator() < 0)
    throw InputError(path + ": key 'every': expected a whole number of steps, got '" + every + "'");
  settings.every = number->numerator();
  settings.initial = keys.list("initial");
  settings.set = keys.assignments("set");
  keys.finish();
  return settings;
}

}  // namespace pfaff
