#include <pfaff/brackets/text/text_bracket.hpp>

#include <filesystem>

#include <pfaff/core/facets/stated_ranges.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff {

using namespace text;

namespace {
Symmetry read_symmetry(const Item& value) {
  const std::string& written = text_of(value, "symmetry");
  for (const Symmetry s : {Symmetry::skew, Symmetry::symmetric, Symmetry::none})
    if (written == to_string(s)) return s;
  refuse(value, unknown_name("symmetry", written, {"skew", "symmetric", "none"}));
}

std::vector<Expression> read_rows(const Item& value) {
  if (value.kind != Item::Kind::list) refuse(value, "tensor: expected a list of rows");
  std::vector<Expression> rows;
  for (const Item& item : value.items)
    for (const Expression& e : expressions_of(item, "row of tensor")) rows.push_back(e);
  return rows;
}
}  // namespace

TextBracket::TextBracket(BracketDescriptor descriptor, std::vector<Parameter> parameters,
                         Declaration declaration)
    : BracketPlugin(std::move(descriptor), std::move(parameters), typeid(TextBracket),
                    std::source_location::current()),
      declaration_(std::move(declaration)) {}

std::unique_ptr<const TextBracket> TextBracket::read(const std::string& path) {
  const Document document = read_document(path);
  Table root(document.root, "a text bracket");
  Declaration d;
  d.files = {{absolute_path(path), document.contents}};
  BracketDescriptor descriptor;
  descriptor.name = root.text("name", std::filesystem::path(path).stem().string());
  if (!is_kebab_case(descriptor.name))
    refuse(document.root, "the name '" + descriptor.name + "': expected kebab-case, such as 'rigid-body'");
  descriptor.title = root.text("title", descriptor.name);
  descriptor.reference = root.text("reference");
  descriptor.description = root.text("description");
  TakenNames names;
  if (const Item* value = root.find("parameters")) d.parameters = read_parameters(*value, names);
  d.coordinates = read_coordinates(root.required("coordinates"), names);
  if (const Item* value = root.find("let")) d.definitions = read_definitions(*value, names);
  const Item& tensor = root.required("tensor");
  d.tensor = read_rows(tensor);
  d.tensor_place = tensor.source;
  descriptor.symmetry = read_symmetry(root.required("symmetry"));
  const Item* jacobi = root.find("jacobi");
  descriptor.jacobi = jacobi != nullptr && truth_of(*jacobi, "jacobi");
  if (descriptor.jacobi && descriptor.symmetry != Symmetry::skew)
    refuse(*jacobi, "jacobi: Jacobi's identity is that of a skew bracket");
  const Item* semimetric = root.find("semimetric");
  descriptor.semimetric = semimetric != nullptr && truth_of(*semimetric, "semimetric");
  if (descriptor.semimetric && descriptor.symmetry != Symmetry::symmetric)
    refuse(*semimetric, "semimetric: only a symmetric bracket is semimetric");
  if (const Item* value = root.find("casimirs")) d.casimirs = expressions_of(*value, "casimirs");
  root.finish();
  std::vector<Parameter> parameters = plugin_parameters(d.parameters);
  std::unique_ptr<const TextBracket> bracket(
      new TextBracket(std::move(descriptor), std::move(parameters), std::move(d)));
  (void)bracket->make({});  // what is wrong in a formula is said now
  return bracket;
}

BracketInstance TextBracket::make(const Assignments& assignments) const {
  std::vector<Real> values = default_values(declaration_.parameters);
  assign_all(parameters(), &values, assignments, "bracket " + name());
  return made(values);
}

BracketInstance TextBracket::made(const std::vector<Real>& values) const {
  const Declaration& d = declaration_;
  Scope constants;
  text::define(constants, d.parameters, values, d.definitions);
  std::size_t n = 0;
  for (const TextCoordinate& c : d.coordinates) n += count_of(c, constants);
  // The values of expressions at the first n inputs of a recorder.
  const auto evaluated = [&](const std::vector<Expression>& expressions, const Recorded& t,
                             const std::vector<Recorded>& inputs) {
    Scope scope = constants;
    scope.define("t", t);
    auto at = inputs.begin();
    for (const TextCoordinate& c : d.coordinates) {
      const auto count = static_cast<std::ptrdiff_t>(count_of(c, constants));
      if (c.count) {
        scope.define(c.name, std::vector<Recorded>(at, at + count));
      } else {
        scope.define(c.name, *at);
      }
      at += count;
    }
    std::vector<Recorded> results;
    for (const Expression& e : expressions) scope.append(e, results);
    return results;
  };
  const auto size = static_cast<int>(n);
  Recorder recorder(2 * size);
  const std::vector<Recorded> x = recorder.inputs();
  const std::vector<Recorded> tensor = evaluated(d.tensor, recorder.time(), x);
  if (tensor.size() != n * n)
    refuse(d.tensor_place, 0,
           "tensor: expected " + std::to_string(n) + " rows of " + std::to_string(n) + ", got " +
               std::to_string(tensor.size()) + " expressions");
  std::vector<Expression> definitions;  // those that nothing reads may be wrong too
  for (const TextDefinition& definition : d.definitions)
    definitions.emplace_back(Source{definition.name, d.files.front().first});
  (void)evaluated(definitions, recorder.time(), x);
  std::vector<Recorded> vector(n, Recorded(0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) vector[i] = vector[i] + tensor[i * n + j] * x[n + j];
  BracketInstance instance{size, {}, std::make_shared<const Tape>(recorder.finish(vector)), {}};
  std::vector<Coordinate> coordinates;
  for (const TextCoordinate& c : d.coordinates)
    coordinates.insert(coordinates.end(), count_of(c, constants), {c.name, c.unit, c.range});
  instance.ranges = stated_ranges(coordinates);
  for (std::size_t k = 0; k < values.size(); ++k)
    instance.parameters.emplace_back(d.parameters[k].name, to_string(values[k]));
  if (!d.casimirs.empty()) {
    Recorder of_state(size);
    const std::vector<Recorded> kept = evaluated(d.casimirs, of_state.time(), of_state.inputs());
    instance.casimirs = std::make_shared<const Tape>(of_state.finish(kept));
  }
  return instance;
}

bool is_text_bracket(const std::string& path) {
  const Document document = read_document(path);
  return Table(document.root, "a text bracket").find("tensor") != nullptr;
}

const BracketPlugin& bracket_named(const std::string& name) {
  if (!is_text_file(name)) return brackets().get(name, "bracket");
  static PluginFiles<TextBracket> files;
  return files.get(name, TextBracket::read);
}

std::string tensor_refused(const BracketInstance& bracket, std::size_t dimension) {
  if (static_cast<std::size_t>(bracket.dimension) != dimension)
    return "it has dimension " + std::to_string(bracket.dimension) + "; expected " +
           std::to_string(dimension) + ", the number of coordinates";
  constexpr int most = 2000;  // coordinates; the tensor is recorded entry by entry
  if (bracket.dimension <= most) return {};
  return "expected at most " + std::to_string(most) + " coordinates beside a bracket by name, got " +
         std::to_string(bracket.dimension);
}

std::shared_ptr<const Tape> recorded_tensor(const BracketInstance& bracket) {
  const auto n = static_cast<std::size_t>(bracket.dimension);
  return std::make_shared<const Tape>(record(bracket.dimension, bracket.dimension * bracket.dimension,
                                             [&](const Recorded& t, In<Recorded> z, Out<Recorded> out) {
                                               for (std::size_t j = 0; j < n; ++j) {
                                                 std::vector<Recorded> point(z.begin(), z.end());
                                                 point.resize(2 * n, Recorded(0));
                                                 point[n + j] = Recorded(1);
                                                 const std::vector<Recorded> column =
                                                     evaluate(*bracket.sharp, t, point);
                                                 for (std::size_t i = 0; i < n; ++i)
                                                   out[i * n + j] = column[i];
                                               }
                                             }));
}

ChosenBracket chosen_bracket(const std::string& text, const std::string& of) {
  if (is_text_file(text)) {
    const BracketPlugin& plugin = bracket_named(beside(text, of));
    return {&plugin, {}, plugin.make({})};
  }
  const PluginValue value = parse_plugin_value(text, "bracket");
  const BracketPlugin& plugin = brackets().get(value.name, "bracket");
  return {&plugin, value.settings, plugin.make(value.settings)};
}

}  // namespace pfaff
