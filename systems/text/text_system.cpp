#include <pfaff/systems/text/text_system.hpp>

#include <pfaff/systems/text/model.hpp>

namespace pfaff {

using text::TextDeclaration;

TextSystem::TextSystem(SystemDescriptor descriptor, std::vector<Parameter> parameters,
                       TextDeclaration declaration, text::FileContents files)
    : SystemPlugin(std::move(descriptor), std::move(parameters), typeid(TextSystem),
                   std::source_location::current()),
      declaration_(std::move(declaration)),
      files_(std::move(files)) {}

std::unique_ptr<const TextSystem> TextSystem::read(const std::string& path) {
  const text::Document document = text::read_document(path);
  TextDeclaration declaration = text::read_declaration(document);
  const ModelSource source = text::model_source(declaration, text::default_values(declaration.parameters));
  text::FileContents files{{text::absolute_path(path), document.contents}};
  for (const auto& bracket : {declaration.bracket, declaration.symmetric_bracket})
    if (const auto* of_file = bracket ? dynamic_cast<const TextBracket*>(bracket->chosen.plugin) : nullptr)
      files.push_back(of_file->files().front());
  SystemDescriptor descriptor{.name = declaration.name,
                              .title = declaration.title,
                              .reference = declaration.reference,
                              .description = declaration.description,
                              .coordinates = source.coordinates,
                              .initial = source.initial,
                              .invariants = source.invariants,
                              .time_unit = declaration.time_unit};
  std::vector<Parameter> parameters = text::plugin_parameters(declaration.parameters);
  return std::unique_ptr<const TextSystem>(
      new TextSystem(std::move(descriptor), std::move(parameters), std::move(declaration), std::move(files)));
}

std::shared_ptr<const Model> TextSystem::make(const Assignments& assignments) const {
  return on_behalf_of("system " + name(), [&] {
    std::vector<Real> values = text::default_values(declaration_.parameters);
    assign_all(parameters(), &values, assignments, "system " + name());
    return std::make_shared<const Model>(text::model_source(declaration_, values));
  });
}

std::vector<Assignments> TextSystem::instances(bool /*full*/) const { return {{}}; }

std::vector<std::pair<const Plugin*, Assignments>> TextSystem::rests_on() const {
  std::vector<std::pair<const Plugin*, Assignments>> named;
  for (const auto* bracket : {&declaration_.bracket, &declaration_.symmetric_bracket})
    if (*bracket && (*bracket)->chosen.plugin != nullptr &&
        dynamic_cast<const TextBracket*>((*bracket)->chosen.plugin) == nullptr)
      named.emplace_back((*bracket)->chosen.plugin, (*bracket)->chosen.settings);
  return named;
}

const SystemPlugin& system_named(const std::string& name) {
  if (!text::is_text_file(name)) return systems().get(name, "system");
  static text::PluginFiles<TextSystem> files;
  return files.get(name, TextSystem::read);
}

}  // namespace pfaff
