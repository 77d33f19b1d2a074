#include <pfaff/integrators/tables/map_program.hpp>

#include <algorithm>
#include <array>
#include <map>

#include <pfaff/core/text/lexer.hpp>

namespace pfaff {

namespace {
using text::Expression;
using text::Node;
using text::Token;
using Kind = MapOperation::Kind;

// The formulas of systems, each a function of the time and of a part of the state.
struct MapFunction {
  text::Function function;
  Kind kind;
  MapExtent extent;
};
constexpr std::array map_functions{
    MapFunction{{"field", 2}, Kind::field, MapExtent::whole},
    MapFunction{{"force", 2}, Kind::force, MapExtent::half},
    MapFunction{{"velocity", 2}, Kind::velocity, MapExtent::half},
};

// The functions that a map may call, whose state has these names.
std::vector<text::Function> functions_of(MapState state) {
  std::vector<text::Function> list;
  for (const MapFunction& f : map_functions)
    if (state != MapState::coordinates && (f.extent == MapExtent::whole) == (state == MapState::whole))
      list.push_back(f.function);
  return list;
}

const char* words(MapExtent extent) {
  switch (extent) {
    case MapExtent::one:
      return "one number";
    case MapExtent::half:
      return "half of the state";
    case MapExtent::whole:
      break;
  }
  return "the state";
}

// NAME = EXPRESSION, taken apart.
struct MapAssignment {
  std::string name;
  text::Source place;  // of the name
  text::Source right;  // what is behind the sign
};

MapAssignment taken_apart(const text::Item& item) {
  const std::string& written = text::text_of(item, "step");
  const std::size_t sign = written.find('=');
  if (sign == std::string::npos)
    text::refuse(item.source, 0, "expected an assignment, such as \"z = z + h*field(t, z)\"");
  MapAssignment a{{}, item.source, item.source};
  const std::size_t first = written.find_first_not_of(" \t\r\n"),
                    last = written.find_last_not_of(" \t\r\n", sign - 1);
  if (first < sign && sign > 0) a.name = written.substr(first, last - first + 1);
  if (!text::is_identifier(a.name))
    text::refuse(item.source, 0, "expected one name before '=', as in \"z = z + h*field(t, z)\"");
  a.right.text = written.substr(sign + 1);
  for (const char c : written.substr(0, sign + 1)) {
    ++a.right.column;
    if (c == '\n') ++a.right.line, a.right.column = 1;
  }
  return a;
}

class Translation {
 public:
  Translation(MapProgram program, text::TakenNames& names)
      : program_(std::move(program)), names_(names), functions_(functions_of(program_.state)) {}

  void add(const text::Item& item) {
    const MapAssignment a = taken_apart(item);
    const Expression right(a.right, functions_);
    calls_.clear();
    prepare(right, right.root());
    const std::size_t known = register_named(a.name);
    const MapExtent extent = extent_of(right, right.root());
    if (known == none) {
      names_.take(a.place, a.name, "value");
      const MapOperation operation = evaluation(Kind::assign, right, right.root());
      program_.registers.push_back({a.name, extent});
      append(operation, program_.registers.size() - 1);
      return;
    }
    if (!program_.is_state(known))
      text::refuse(a.place, 0,
                   "'" + a.name + "' has a value already; expected a new name, or one of the state");
    const MapExtent expected = program_.registers[known].extent;
    if (extent != expected && extent != MapExtent::one)
      text::refuse(a.right, 0, "'" + a.name + "' is " + words(expected) + ", and this is " + words(extent));
    const bool adds = begins_with(right, a.name);
    append(evaluation(adds ? Kind::add : Kind::assign, right, right.root()), known);
    moved_ = true;
  }

  MapProgram take(const text::Item& list) && {
    if (!moved_)
      text::refuse(list, "step: expected an assignment to the state, such as \"z = z + h*field(t, z)\"");
    return std::move(program_);
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[noreturn]] static void fail(const Expression& of, std::size_t node, const std::string& message) {
    text::refuse(of.source(), of.node(node).offset, message);
  }
  [[nodiscard]] std::size_t register_named(std::string_view name) const {
    for (std::size_t k = 0; k < program_.registers.size(); ++k)
      if (program_.registers[k].name == name) return k;
    return none;
  }
  void append(MapOperation operation, std::size_t target) {
    operation.target = target;
    program_.operations.push_back(std::move(operation));
  }

  // True for NAME + ... and NAME - ...
  static bool begins_with(const Expression& of, const std::string& name) {
    const Node& top = of.node(of.root());
    if (top.kind != Node::Kind::sum) return false;
    const Node& first = of.node(top.operands.front());
    return first.kind == Node::Kind::name && first.name == name;
  }

  // How many numbers a part of an expression is; names that are unknown are left to its evaluation.
  MapExtent extent_of(const Expression& of, std::size_t number) {
    const Node& node = of.node(number);
    if (const auto call = calls_.find(number); call != calls_.end())
      return program_.registers[call->second].extent;
    if (node.kind == Node::Kind::name) {
      const std::size_t known = register_named(node.name);
      return known == none ? MapExtent::one : program_.registers[known].extent;
    }
    MapExtent extent = MapExtent::one;
    for (const std::size_t operand : node.operands) {
      const MapExtent other = extent_of(of, operand);
      if (other == MapExtent::one) continue;
      if (node.kind == Node::Kind::range)
        fail(of, operand, node.name + ": expected a number for every index");
      extent = other;
    }
    return extent;
  }

  // Makes operations of the calls in a part of an expression, the inner ones first.
  void prepare(const Expression& of, std::size_t number) {
    const Node& node = of.node(number);
    if (node.kind == Node::Kind::element)
      fail(of, number, "a map is written for every component at once; expected '" + node.name + "' alone");
    if (node.kind == Node::Kind::range) ++ranges_;
    for (const std::size_t operand : node.operands) prepare(of, operand);
    if (node.kind == Node::Kind::range) --ranges_;
    if (node.kind != Node::Kind::call) return;
    if (ranges_ > 0) fail(of, number, "'" + node.name + "' is not called inside a sum");
    constexpr std::size_t most_registers = 2000;
    if (program_.registers.size() > most_registers) fail(of, number, "the map has too many operations");
    const auto* const called =
        std::find_if(map_functions.begin(), map_functions.end(),
                     [&](const MapFunction& f) { return f.function.name == node.name; });
    MapOperation operation{.kind = called->kind};
    const std::array expected{MapExtent::one, called->extent};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const MapExtent given = extent_of(of, node.operands[k]);
      if (given != expected[k]) {
        (void)evaluation(Kind::assign, of, node.operands[k]);  // which complains about unknown names
        fail(
            of, node.operands[k],
            node.name + ": expected " + (k == 0 ? "the time" : words(expected[k])) + ", got " + words(given));
      }
      operation.reads.push_back(register_of(of, node.operands[k], given));
    }
    program_.registers.push_back({{}, called->extent});
    calls_[number] = program_.registers.size() - 1;
    append(std::move(operation), program_.registers.size() - 1);
  }
  // The register with the value of a part of an expression, a new one unless it is a name or a call.
  std::size_t register_of(const Expression& of, std::size_t number, MapExtent extent) {
    if (const auto call = calls_.find(number); call != calls_.end()) return call->second;
    if (of.node(number).kind == Node::Kind::name)
      if (const std::size_t known = register_named(of.node(number).name); known != none) return known;
    MapOperation operation = evaluation(Kind::assign, of, number);
    program_.registers.push_back({{}, extent});
    append(std::move(operation), program_.registers.size() - 1);
    return program_.registers.size() - 1;
  }

  // A part of an expression on a tape whose inputs are the registers that it reads; of what is added to the
  // state, all terms but the first, which is the state itself.
  MapOperation evaluation(Kind kind, const Expression& of, std::size_t number) const {
    Recorder recorder(static_cast<int>(program_.registers.size()));
    const std::vector<Recorded> inputs = recorder.inputs();
    text::Scope scope;
    for (std::size_t k = 0; k < inputs.size(); ++k)
      if (!program_.registers[k].name.empty()) scope.define(program_.registers[k].name, inputs[k]);
    scope.give_meaning([&](std::size_t node) { return inputs[calls_.at(node)]; });
    Recorded value(0);
    if (kind == Kind::add) {
      const Node& sum = of.node(number);
      for (std::size_t k = 1; k < sum.operands.size(); ++k) {
        const Recorded term = scope.value(of, sum.operands[k]);
        value = sum.inverted[k] ? value - term : value + term;
      }
    } else {
      value = scope.value(of, number);
    }
    Tape tape = recorder.finish({&value, 1});
    MapOperation operation{.kind = kind};
    for (Instruction& i : tape.code) {
      if (i.operation != Operation::input) continue;
      operation.reads.push_back(static_cast<std::size_t>(i.a));
      i.a = static_cast<int>(operation.reads.size()) - 1;
    }
    tape.inputs = static_cast<int>(operation.reads.size());
    operation.tape = std::make_shared<const Tape>(std::move(tape));
    return operation;
  }

  MapProgram program_;
  text::TakenNames& names_;
  std::vector<text::Function> functions_;
  std::map<std::size_t, std::size_t> calls_;  // of the expression at hand: node, register
  int ranges_ = 0;                            // that the node at hand is inside
  bool moved_ = false;
};

}  // namespace

MapState state_of_assignments(const text::Item& list) {
  for (const text::Item& item : list.items) {
    std::string written = text::text_of(item, "step");
    std::replace(written.begin(), written.end(), '=', '+');  // no sign of expressions
    const text::Source source{written, item.source.file, item.source.line, item.source.column};
    text::Lexer lexer(source);
    for (Token token = lexer.next(); token.kind != Token::Kind::end; token = lexer.next())
      for (const char* name : {"q", "p", "force", "velocity"})
        if (token.text == name) return MapState::canonical;
  }
  return MapState::whole;
}

MapProgram translate_map(const text::Item& list, MapState state, const std::vector<std::string>& constants,
                         const std::vector<std::string>& coordinates, text::TakenNames& names) {
  MapProgram program;
  program.state = state;
  program.registers = {MapRegister{"t"}, MapRegister{"h"}};
  for (const std::string& name : constants) program.registers.push_back({name});
  program.constants = constants.size();
  program.first_of_state = program.registers.size();
  switch (state) {
    case MapState::whole:
      program.registers.push_back({"z", MapExtent::whole});
      break;
    case MapState::canonical:
      program.registers.push_back({"q", MapExtent::half});
      program.registers.push_back({"p", MapExtent::half});
      break;
    case MapState::coordinates:
      for (const std::string& name : coordinates) program.registers.push_back({name});
      break;
  }
  program.state_registers = program.registers.size() - program.first_of_state;
  constexpr std::size_t most_assignments = 1000;
  if (list.items.size() > most_assignments)
    text::refuse(list, "step: expected at most " + std::to_string(most_assignments) + " assignments");
  Translation translation(std::move(program), names);
  for (const text::Item& item : list.items) translation.add(item);
  return std::move(translation).take(list);
}

}  // namespace pfaff
