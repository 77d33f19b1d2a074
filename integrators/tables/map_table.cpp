// Tables of the kind "map": `step`, a list of assignments that make the state at t + h of the state at t
// (map_program.hpp says how they are written). Nothing follows from the text about the order of a map or
// about what it keeps: `order` and `preserves` are the author's claims, which verification judges by
// measuring. The constants of `let` are the coefficients, and `parameters` are settings of the method.
//
// A map of one system names it, `system`, with its `coordinates`, and reads those of its parameters that
// `system_parameters` lists.
#include <algorithm>

#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/tables/map_program.hpp>
#include <pfaff/integrators/tables/method_table.hpp>

namespace {
using namespace pfaff;

/// A map, whatever it asks of a problem.
struct TextMap {
  static constexpr bool fixed_sizes = false;
  std::shared_ptr<const MapProgram> program;
  std::string system;  // the only one that it is a map of; empty: any
  std::vector<std::string> coordinates, system_parameters;
  std::vector<Quad> numbers;   // the constants of let
  std::vector<Real> settings;  // the values of its parameters

  std::span<Quad> coefficients() { return numbers; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    if (system.empty()) return "";
    if (model.name() != system) return "is a map of the system " + system + " alone";
    const auto named = [](const Coordinate& c, const std::string& name) { return c.name == name; };
    if (!coordinates.empty() && !std::equal(model.coordinates().begin(), model.coordinates().end(),
                                            coordinates.begin(), coordinates.end(), named))
      return "has other coordinates than " + system;
    for (const std::string& name : system_parameters)
      if (parameter_of(model, name) == nullptr)
        return "reads the parameter '" + name + "', which " + system + " does not have";
    return "";
  }

  /// The registers while steps are made; those of the state stand for parts of the state itself.
  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> values, inputs, carry;
    std::vector<std::size_t> begins, lengths;  // of each register, in the values or in the state
    std::vector<Replay<T>> replays;            // of the operations with a tape, in their order

    Work(const TextMap& map, const P& p) : carry(p.size(), T(0)) {
      const MapProgram& steps = *map.program;
      std::size_t size = 0, in_state = 0, most_inputs = 0;
      for (std::size_t k = 0; k < steps.registers.size(); ++k) {
        const MapExtent extent = steps.registers[k].extent;
        const std::size_t length =
            extent == MapExtent::one ? 1 : p.size() / (extent == MapExtent::half ? 2 : 1);
        std::size_t& begin = steps.is_state(k) ? in_state : size;
        begins.push_back(begin);
        lengths.push_back(length);
        begin += length;
      }
      values.assign(size, T(0));
      std::size_t constant = 2;  // behind t and h
      for (const Quad& x : map.numbers) values[constant++] = T(Real(x));
      for (const Real& x : map.settings) values[constant++] = T(x);
      for (const std::string& name : map.system_parameters)
        values[constant++] = T(*Real::parse(*parameter_of(*p.model(), name)));
      for (const MapOperation& operation : steps.operations) {
        if (operation.tape == nullptr) continue;
        replays.emplace_back(operation.tape);
        most_inputs = std::max(most_inputs, operation.reads.size());
      }
      inputs.assign(most_inputs, T(0));
    }
  };

 protected:
  static const std::string* parameter_of(const Model& model, const std::string& name) {
    for (const auto& [key, value] : model.parameters())
      if (key == name) return &value;
    return nullptr;
  }

  // Makes a step; formula(kind, t, argument, result) is one of the system's.
  template <class P, class Formula>
  Status run(const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w, Formula&& formula) const {
    using T = Scalar<P>;
    const auto at = [&](std::size_t k) {
      return (program->is_state(k) ? z.data() : w.values.data()) + w.begins[k];
    };
    w.values[0] = t;
    w.values[1] = h;
    auto replay = w.replays.begin();
    for (const MapOperation& operation : program->operations) {
      T* const target = at(operation.target);
      const std::size_t length = w.lengths[operation.target];
      if (operation.tape == nullptr) {
        const std::size_t argument = operation.reads[1];
        formula(operation.kind, *at(operation.reads[0]), In<T>(at(argument), w.lengths[argument]),
                Out<T>(target, length));
        continue;
      }
      const bool state = program->is_state(operation.target);
      for (std::size_t i = 0; i < length; ++i) {
        for (std::size_t k = 0; k < operation.reads.size(); ++k) {
          const std::size_t read = operation.reads[k];
          w.inputs[k] = at(read)[w.lengths[read] == 1 ? 0 : i];
        }
        T value(0);
        (*replay)(t, w.inputs.data(), &value);
        T& rest = w.carry[state ? w.begins[operation.target] + i : 0];
        if (operation.kind == MapOperation::Kind::add) {
          add_to(target[i], rest, value, true);
        } else {
          target[i] = value;
          if (state) rest = T(0);
        }
      }
      ++replay;
    }
    return Status::converged;
  }
};

/// A map of the whole state.
struct FieldMap : TextMap {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    return run<P>(t, h, z, w, [&p](MapOperation::Kind /*field*/, const T& time, In<T> x, Out<T> rate) {
      p.field(time, x, rate);
    });
  }
};

/// A map of positions and momenta.
struct SeparableMap : TextMap {
  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    return run<P>(t, h, z, w, [&p](MapOperation::Kind kind, const T& time, In<T> x, Out<T> rate) {
      if (kind == MapOperation::Kind::force) {
        p.force(time, x, rate);
      } else {
        p.velocity(time, x, rate);
      }
    });
  }
};

/// The method of a file, for any values of its parameters.
template <class M>
class MapTable final : public MethodTable {
 public:
  MapTable(MethodDescriptor descriptor, const TableDocument& document,
           const std::vector<text::TextParameter>& settings, M map)
      : MethodTable(std::move(descriptor), parameters_of_map(settings), typeid(M), document, OrderTheory{}),
        map_(std::move(map)) {
    detail::check_method_members<M>();
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    M map = map_;
    assign_all(parameters(), &map, assignments, "integrator " + name());
    return std::make_unique<detail::Instance<M>>(*this, std::move(map));
  }
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const override { return {{}}; }

 private:
  // Those of a text plug-in, whose object is the list of their values.
  static std::vector<Parameter> parameters_of_map(const std::vector<text::TextParameter>& settings) {
    std::vector<Parameter> list = text::plugin_parameters(settings);
    for (Parameter& p : list) {
      p.write = [write = p.write](void* map, const std::string& text) {
        write(&static_cast<M*>(map)->settings, text);
      };
      p.read = [read = p.read](const void* map) { return read(&static_cast<const M*>(map)->settings); };
    }
    return list;
  }

  M map_;
};

// The names in a list, each of which is taken.
std::vector<std::string> read_names(TableDocument& document, const char* key, const std::string& what) {
  const text::Item* list = document.find(key);
  if (list == nullptr) return {};
  if (list->kind != text::Item::Kind::list) document.refuse(key, "expected a list of names");
  std::vector<std::string> names;
  for (const text::Item& item : list->items) {
    names.push_back(text::text_of(item, key));
    document.names().take(item.source, names.back(), what);
  }
  return names;
}

// The constants of let, which are numbers.
std::vector<Quad> read_constants(TableDocument& document) {
  text::Scope scope;
  text::define(scope, {}, {}, document.definitions());
  std::vector<Quad> numbers;
  for (const text::TextDefinition& d : document.definitions()) {
    if (d.is_list) document.refuse("let", "'" + d.name + "' is a list; expected a number for every name");
    numbers.push_back(scope.constant(d.expressions.front()).quad());
  }
  return numbers;
}

void require_system(TableDocument& document, bool of_one_system) {
  for (const char* key : {"coordinates", "system_parameters"})
    if (!of_one_system && document.has(key))
      document.refuse(key,
                      "is written beside 'system', the name of the one that it belongs to, which is missing");
}

std::unique_ptr<const MethodTable> read_map_table(TableDocument& document, TableHead head) {
  TextMap map;
  map.system = document.text("system", "");
  require_system(document, !map.system.empty());
  map.numbers = read_constants(document);
  std::vector<text::TextParameter> settings;
  if (const text::Item* value = document.find("parameters"))
    settings = text::read_parameters(*value, document.names());
  map.settings = text::default_values(settings);
  map.system_parameters = read_names(document, "system_parameters", "parameter of the system");
  map.coordinates = read_names(document, "coordinates", "coordinate");
  const text::Item* step = document.find("step");
  if (step == nullptr) document.refuse("step", "is missing; expected a list of assignments");
  if (step->kind != text::Item::Kind::list) document.refuse("step", "expected a list of assignments");

  std::vector<std::string> constants;
  for (const text::TextDefinition& d : document.definitions()) constants.push_back(d.name);
  for (const text::TextParameter& p : settings) constants.push_back(p.name);
  constants.insert(constants.end(), map.system_parameters.begin(), map.system_parameters.end());
  const MapState state = map.coordinates.empty() ? state_of_assignments(*step) : MapState::coordinates;
  document.names().take(step->source, "h", "step size");
  if (state == MapState::whole) document.names().take(step->source, "z", "state");
  if (state == MapState::canonical)
    for (const char* name : {"q", "p"}) document.names().take(step->source, name, "part of the state");
  map.program = std::make_shared<const MapProgram>(
      translate_map(*step, state, constants, map.coordinates, document.names()));

  head.descriptor.preserves = {Claim::none};
  if (document.has("preserves")) {
    std::vector<Claim> every;
    for (const ClaimRow& row : claim_table) every.push_back(row.claim);
    head.descriptor.preserves = kept_claims(document, every, [](Claim /*claim*/) { return ""; });
  }
  document.finish();
  if (state == MapState::canonical)
    return std::make_unique<MapTable<SeparableMap>>(head.descriptor, document, settings,
                                                    SeparableMap{std::move(map)});
  return std::make_unique<MapTable<FieldMap>>(head.descriptor, document, settings, FieldMap{std::move(map)});
}

const TableKind<SeparableMap, FieldMap> map_kind{{"map"}, read_map_table};
}  // namespace
