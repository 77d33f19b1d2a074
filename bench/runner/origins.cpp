#include <pfaff/bench/runner/origins.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <typeinfo>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/runner/files.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/native/compiler.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/core/process/loaded_objects.hpp>
#include <pfaff/core/registry/shipped_plugins.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
constexpr const char* libm_values = "values of libm";

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

void add(Assignments& list, const std::string& name, const std::string& hash) {
  const auto place = std::lower_bound(list.begin(), list.end(), std::pair(name, std::string()));
  if (place == list.end() || place->first != name) list.emplace(place, name, hash);
}

const std::string* hash_of(const Assignments& list, const std::string& name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.first == name; });
  return found == list.end() ? nullptr : &found->second;
}

// The paths of Pfaff's own libraries that every run is made by, found by an object that each of them holds.
const std::vector<std::string>& own_libraries() {
  static const int of_bench = 0;
  static const std::vector<std::string> paths{object_holding(&systems()).path,
                                              object_holding(&of_bench).path};
  return paths;
}
bool is_own(const LoadedObject& object) {
  return std::find(own_libraries().begin(), own_libraries().end(), object.path) != own_libraries().end();
}

bool is_shipped(const LoadedObject& object) {
  static const std::string shipped = shipped_plugins_path();
  return object.path == shipped;
}

// The object whose code a plug-in is. One that was made when its file was read stands in none; its type does.
LoadedObject object_of(const Plugin& plugin) {
  const bool of_file = dynamic_cast<const MethodTable*>(&plugin) != nullptr ||
                       dynamic_cast<const TextSystem*>(&plugin) != nullptr;
  const void* const address = of_file ? static_cast<const void*>(&typeid(plugin)) : &plugin;
  // To look through all objects takes as long as a short run, and none is ever unloaded.
  static std::mutex mutex;
  static std::map<const void*, LoadedObject> known;
  const std::lock_guard lock(mutex);
  const auto place = known.find(address);
  return place != known.end() ? place->second : known.emplace(address, object_holding(address)).first->second;
}

const Plugin* plugin_of(const std::string& kind, const std::string& name) {
  if (kind == "system") return systems().find(name);
  if (kind == "integrator") return integrators().find(name);
  if (kind == "formulation") return formulations().find(name);
  if (kind == "bracket") return brackets().find(name);
  if (kind == "measure") return measures().find(name);
  return nullptr;
}

const Parameter* parameter_of(const std::vector<Parameter>& parameters, const std::string& name) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}
}  // namespace

Assignments with_absolute_paths(const std::vector<Parameter>& parameters, Assignments assignments) {
  for (auto& [key, value] : assignments) {
    const Parameter* p = parameter_of(parameters, key);
    if (p == nullptr || p->kind != Parameter::Kind::file || value.empty()) continue;
    try {
      (void)nlohmann::json(value).dump();
    } catch (const nlohmann::json::type_error&) {
      throw InputError("parameter '" + key +
                       "': expected a path in UTF-8, because the files of a run hold it");
    }
    value = fs::absolute(value).lexically_normal().string();
  }
  return assignments;
}

Assignments files_of(const std::vector<Parameter>& parameters, const Assignments& values) {
  Assignments files;
  for (const auto& [key, value] : values) {
    const Parameter* p = parameter_of(parameters, key);
    if (p == nullptr || value.empty()) continue;
    if (p->kind == Parameter::Kind::file) add(files, value, sha1_of(read_file(value)));
    if (p->kind != Parameter::Kind::plugin) continue;
    const PluginValue inner = parse_plugin_value(value, key);
    for (const auto& [path, hash] : files_of(p->plugins.parameters(inner.name), inner.settings))
      add(files, path, hash);
  }
  return files;
}

void add_file(Origins& origins, const std::string& path, const std::string& hash) {
  add(origins.files, path, hash);
}

void add_compiler(Origins& origins) { add(origins.libraries, "native", native::compiler_identity()); }

void add_origins(const Plugin& plugin, const Assignments& values, Origins& origins) {
  for (const auto& [path, hash] : files_of(plugin.parameters(), values)) add(origins.files, path, hash);
  if (const auto* table = dynamic_cast<const MethodTable*>(&plugin)) {
    for (const auto& [path, contents] : table->files()) add(origins.files, path, sha1_of(contents));
    for (const auto& [base, settings] : table->rests_on()) add_origins(*base, settings, origins);
  }
  const LoadedObject object = object_of(plugin);
  if (is_shipped(object))
    add(origins.libraries, file_name(object.path), object.build);
  else if (!is_own(object))
    add(origins.plugins, object.path, object.build);
  for (const auto& [key, value] : values)
    if (const Parameter* p = parameter_of(plugin.parameters(), key);
        p != nullptr && p->kind == Parameter::Kind::plugin) {
      const PluginValue inner = parse_plugin_value(value, key);
      if (const Plugin* chosen = plugin_of(p->plugins.kind, inner.name))
        add_origins(*chosen, inner.settings, origins);
    }
}

void add_library_of(const Plugin* namesake, Origins& origins) {
  if (namesake == nullptr) return;
  if (const LoadedObject object = object_of(*namesake); is_shipped(object))
    add(origins.libraries, file_name(object.path), object.build);
}

namespace {
// A number that tells apart what the functions of formulas give at fixed points. Builds of the C library have
// several variants of them, of which the machine and settings such as GLIBC_TUNABLES choose one. Two variants
// give different last digits at about one point in 1500 for sin, cos, exp and pow.
std::string values_of_libm() {
  // Read again at every use, so that it is the library that computes and not the compiler.
  double (*volatile const sine)(double) = std::sin;
  double (*volatile const cosine)(double) = std::cos;
  double (*volatile const exponential)(double) = std::exp;
  double (*volatile const logarithm)(double) = std::log;
  double (*volatile const power)(double, double) = std::pow;
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a, by words
  const auto add_value = [&](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211U; };
  constexpr int points = 8192;
  for (int k = 1; k <= points; ++k) {
    const double x = k * 7e-4;
    for (const double value : {sine(x), cosine(x), exponential(x), logarithm(x), power(x, 1.7)})
      add_value(value);
  }
  return "fnv-" + formatted("%016llx", static_cast<unsigned long long>(hash));
}
}  // namespace

const Assignments& libraries() {
  static const Assignments list = [] {
    Assignments found;
    for (const LoadedObject& object : loaded_objects()) {
      const std::string name = file_name(object.path);
      if (is_own(object) || name.starts_with("libm.so") || name.starts_with("libquadmath.so"))
        add(found, name, object.build);
    }
    add(found, libm_values, values_of_libm());
    return found;
  }();
  return list;
}

std::vector<std::string> differences(const Origins& before, const Origins& now) {
  std::vector<std::string> phrases;
  const auto compare = [&](const Assignments& old, const Assignments& present, const std::string& changed) {
    if (old.empty()) return;
    for (const auto& [name, hash] : old)
      if (const std::string* found = hash_of(present, name); found == nullptr) {
        phrases.push_back(name + " is no longer a part of it");
      } else if (*found != hash) {
        phrases.push_back(name + (name == libm_values ? " are others" : changed));
      }
    for (const auto& [name, hash] : present)
      if (hash_of(old, name) == nullptr) phrases.push_back(name + " has become a part of it");
  };
  // A plug-in may stand elsewhere now; its build tells whether it is the same.
  const auto by_file_name = [](const Assignments& paths) {
    Assignments names;
    for (const auto& [path, build] : paths) add(names, file_name(path), build);
    return names;
  };
  compare(before.files, now.files, " has changed");
  compare(by_file_name(before.plugins), by_file_name(now.plugins), " is another build");
  compare(before.libraries, now.libraries, " is another build");
  return phrases;
}

std::string in_one_line(const std::vector<std::string>& phrases) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t k = 0; k < std::min(phrases.size(), most); ++k) text += (k == 0 ? "" : ", ") + phrases[k];
  if (phrases.size() > most) text += " and " + std::to_string(phrases.size() - most) + " more";
  return text;
}

void require_plugins(const Origins& origins, const std::string& where) {
  const std::vector<LoadedObject> objects = loaded_objects();
  for (const auto& [path, build] : origins.plugins)
    if (std::none_of(objects.begin(), objects.end(), [&id = build, &file = path](const LoadedObject& object) {
          return object.build == id || file_name(object.path) == file_name(file);
        }))
      throw InputError(where + ": the plug-in '" + path + "' is not loaded, and a file does not load code; " +
                       "expected --plugin " + path + ", if you trust it, or where it is now");
}

}  // namespace pfaff
