#include <pfaff/core/method_alias.hpp>

#include <pfaff/core/forwarding_instance.hpp>

namespace pfaff::detail {

namespace {

const std::string* value_of_key(const Assignments& assignments, std::string_view key) {
  for (const auto& [name, value] : assignments)
    if (name == key) return &value;
  return nullptr;
}

std::string path_start(const std::string& path) { return path.substr(0, path.find('.')); }
std::string path_rest(const std::string& path) { return path.substr(path.find('.') + 1); }

// What is set at a path such as base.compensated.
std::string value_at(const Assignments& assignments, const std::string& path) {
  if (const std::string* value = value_of_key(assignments, path)) return *value;
  const std::string* outer = value_of_key(assignments, path_start(path));
  if (outer == nullptr) throw InputError(unknown_name("parameter", path, {}));
  return value_at(parse_plugin_value(*outer, path).settings, path_rest(path));
}

// The parameter at a path, where the plug-ins on the way are those of `presets`.
Parameter parameter_at(const std::vector<Parameter>& parameters, const Assignments& presets,
                       const std::string& path, const std::string& owner) {
  std::vector<std::string> names;
  for (const Parameter& p : parameters) {
    names.push_back(p.name);
    if (p.name == path) return p;
    if (!p.takes(path)) continue;
    const std::string* chosen = value_of_key(presets, p.name);
    if (chosen == nullptr) break;
    const PluginValue value = parse_plugin_value(*chosen, owner);
    return parameter_at(p.plugins.parameters(value.name), value.settings, path_rest(path), owner);
  }
  throw InputError(unknown_name("parameter", path, names) + " (of " + owner + ")");
}

std::string text_of(const Assignments& presets) {
  std::string text;
  for (const auto& [key, value] : presets)
    text.append(text.empty() ? "" : ", ").append(key).append("=").append(value);
  return text;
}

MethodDescriptor descriptor_of(const MethodPlugin& method, const std::string& name,
                               const Assignments& presets) {
  MethodDescriptor d = method.descriptor();
  d.name = name;
  d.title = method.name() + " with " + text_of(presets);
  d.description = "Another name for " + method.name() + " with " + text_of(presets) + ". " + d.description;
  return d;
}

// An instance of the method under the alias's name and with the alias's parameters.
class AliasInstance final : public ForwardingInstance<AliasInstance> {
 public:
  AliasInstance(const AliasPlugin& alias, const Assignments& shortened,
                std::unique_ptr<MethodInstance> instance)
      : ForwardingInstance(std::move(instance)), alias_(alias), shortened_(shortened) {}

  [[nodiscard]] const MethodDescriptor& descriptor() const override { return alias_.descriptor(); }
  [[nodiscard]] Assignments parameters() const override {
    const Assignments all = method().parameters();
    Assignments own;
    for (const Parameter& p : alias_.parameters()) {
      const std::string* path = value_of_key(shortened_, p.name);
      own.emplace_back(p.name, value_at(all, path == nullptr ? p.name : *path));
    }
    return own;
  }

 private:
  const AliasPlugin& alias_;
  const Assignments& shortened_;  // the alias's, which lives as long as its plug-in
};

}  // namespace

AliasPlugin::AliasPlugin(const MethodPlugin& method, const std::string& name, Assignments presets,
                         Assignments shortened, const std::source_location& where)
    : MethodPlugin(descriptor_of(method, name, presets), {}, typeid(AliasPlugin), where),
      method_(method),
      presets_(std::move(presets)),
      shortened_(std::move(shortened)) {
  integrators().add_alias(this);
}

const std::vector<Parameter>& AliasPlugin::parameters() const {
  std::call_once(made_, [this] {
    std::vector<Parameter> own;
    for (const Parameter& p : method_.parameters())
      if (value_of_key(presets_, p.name) == nullptr) own.push_back(p);
    for (const auto& [key, path] : shortened_) {
      own.push_back(parameter_at(method_.parameters(), presets_, path, "alias " + name()));
      own.back().name = key;
    }
    parameters_ = std::move(own);
  });
  return parameters_;
}

std::unique_ptr<MethodInstance> AliasPlugin::make(const Assignments& assignments) const {
  Assignments all = presets_;
  std::vector<std::string> names;
  for (const Parameter& p : parameters()) names.push_back(p.name);
  for (const auto& [key, value] : assignments) {
    const auto known = std::find_if(parameters().begin(), parameters().end(),
                                    [&key = key](const Parameter& p) { return p.takes(key); });
    if (known == parameters().end())
      throw InputError(unknown_name("parameter", key, names) + " (of integrator " + name() + ")");
    const std::string* path = value_of_key(shortened_, known->name);
    all.emplace_back(path == nullptr ? key : *path + key.substr(known->name.size()), value);
  }
  return std::make_unique<AliasInstance>(*this, shortened_, method_.make(all));
}

std::vector<Assignments> AliasPlugin::instances(bool full) const {
  std::vector<Assignments> own;
  for (const Assignments& instance : method_.instances(full)) {
    const bool agrees = std::all_of(presets_.begin(), presets_.end(), [&](const auto& preset) {
      const std::string* value = value_of_key(instance, preset.first);
      return value != nullptr && *value == preset.second;
    });
    if (!agrees) continue;
    own.emplace_back();
    for (const auto& setting : instance)
      if (value_of_key(presets_, setting.first) == nullptr) own.back().push_back(setting);
  }
  return own.empty() ? std::vector<Assignments>{{}} : own;
}

}  // namespace pfaff::detail
