#include <pfaff/core/text/scope.hpp>

#include <algorithm>
#include <limits>

#include <pfaff/core/text/functions.hpp>

namespace pfaff::text {

namespace {
const Real& pi() {
  static const Real value = *Real::parse("3.14159265358979323846264338327950288419716939937510582");
  return value;
}

// A power of a constant with a whole exponent, by products: fractions stay fractions.
Real whole_power(const Real& base, std::int64_t exponent) {
  Real result(1), square = base;
  for (auto left = std::abs(exponent); left > 0; left /= 2) {
    if (left % 2 == 1) result = result * square;
    if (left > 1) square = square * square;
  }
  return exponent < 0 ? Real(1) / result : result;
}
bool is_small_whole(const Real& x) {
  constexpr std::int64_t most = 64;
  return x.is_fraction() && x.denominator() == 1 && x.numerator() <= most && x.numerator() >= -most;
}

// Of a node that is always zero the names that are, as a mass may be: " where m = 0"; empty without any.
std::string where_zero(Scope& scope, const Expression& of, std::size_t number) {
  const Node& node = of.node(number);
  if (node.kind == Node::Kind::name)
    return structurally_zero(scope.value(of, number)) ? " where " + node.name + " = 0" : std::string();
  for (const std::size_t operand : node.operands)
    if (std::string zero = where_zero(scope, of, operand); !zero.empty()) return zero;
  return {};
}
}  // namespace

// Counts how deep evaluations are inside one another, and how many there were.
class Scope::Call {
 public:
  Call(Scope& scope, const Expression& of, std::size_t node) : scope_(scope) {
    constexpr int deepest = 600;
    if (scope.depth_ >= deepest)
      fail(of, node, "definitions and parentheses are too deep inside one another");
    if (--scope.operations_left_ < 0) fail(of, node, "the formula has too many operations");
    ++scope.depth_;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;
  ~Call() { --scope_.depth_; }

 private:
  Scope& scope_;
};

Scope::Scope() { define("pi", Recorded(pi())); }

void Scope::define(const std::string& name, const Recorded& value) {
  entries_[name] = Entry{.state = Entry::State::value, .value = value};
}
void Scope::define(const std::string& name, std::vector<Recorded> elements) {
  entries_[name] = Entry{.state = Entry::State::elements, .elements = std::move(elements)};
}
void Scope::define(const std::string& name, Expression definition) {
  const bool is_list = definition.is_vector();
  entries_[name] =
      Entry{.state = Entry::State::unread, .definitions = {std::move(definition)}, .is_list = is_list};
}
void Scope::define(const std::string& name, std::vector<Expression> definitions) {
  entries_[name] =
      Entry{.state = Entry::State::unread, .definitions = std::move(definitions), .is_list = true};
}
void Scope::withhold(const std::string& name, const std::string& reason) {
  entries_[name] = Entry{.state = Entry::State::withheld, .reason = reason};
}

void Scope::fail(const Expression& of, std::size_t node, const std::string& message) {
  refuse(of.source(), of.node(node).offset, message);
}

void Scope::append(const Expression& expression, std::vector<Recorded>& values) {
  append_node(expression, expression.root(), values);
}

void Scope::append_node(const Expression& of, std::size_t number, std::vector<Recorded>& values) {
  const Call call(*this, of, number);
  const Node& node = of.node(number);
  if (node.kind == Node::Kind::range && node.name == "vector") {
    for_each_index(of, number, [&] { append_node(of, node.operands[2], values); });
    return;
  }
  if (node.kind == Node::Kind::function && node.name == "select") {
    std::vector<Recorded> first, second;
    append_node(of, node.operands[1], first);
    append_node(of, node.operands[2], second);
    if (first.size() != second.size())
      fail(of, number,
           "select: its branches stand for " + std::to_string(first.size()) + " and " +
               std::to_string(second.size()) + " values; expected as many in both");
    for (std::size_t k = 0; k < first.size(); ++k) values.push_back(chosen(of, number, first[k], second[k]));
    return;
  }
  const bool index =
      std::any_of(indices_.begin(), indices_.end(), [&](const Index& i) { return i.name == node.name; });
  if (node.kind == Node::Kind::name && !index && node.name != "t") {
    const Entry& named = entry(of, number);
    if (named.state == Entry::State::elements) {
      operations_left_ -= static_cast<long>(named.elements.size());
      if (operations_left_ < 0) fail(of, number, "the formula has too many operations");
      values.insert(values.end(), named.elements.begin(), named.elements.end());
      return;
    }
  }
  values.push_back(value(of, number));
}

Real Scope::constant(const Expression& expression) {
  const Recorded x = evaluate(expression);
  if (!x.is_constant())
    fail(expression, expression.root(), "expected a constant, which depends on neither time nor state");
  return x.constant();
}
int Scope::whole_number(const Expression& expression) {
  return whole_number(expression, expression.root(), "expected a whole number");
}

int Scope::whole_number(const Expression& of, std::size_t node, const std::string& what) {
  const Recorded x = value(of, node);
  if (!x.is_constant()) fail(of, node, what + ", got what depends on time or state");
  const Real& number = x.constant();
  constexpr std::int64_t most = std::numeric_limits<int>::max() / 2;
  if (!number.is_fraction() || number.denominator() != 1 || number.numerator() > most ||
      number.numerator() < -most)
    fail(of, node, what + ", got " + to_string(number));
  return static_cast<int>(number.numerator());
}

Recorded Scope::value(const Expression& of, std::size_t number) {
  const Call call(*this, of, number);
  const Node& node = of.node(number);
  switch (node.kind) {
    case Node::Kind::number:
      return Recorded(node.value);
    case Node::Kind::name:
      return named(of, number);
    case Node::Kind::element:
      return element(of, number);
    case Node::Kind::negate:
      return -value(of, node.operands[0]);
    case Node::Kind::sum:
      return sum(of, node);
    case Node::Kind::product:
      return product(of, node);
    case Node::Kind::power: {
      const Recorded base = value(of, node.operands[0]);
      return power(of, number, base, value(of, node.operands[1]));
    }
    case Node::Kind::function:
      return function(of, number);
    case Node::Kind::call:
      return meaning_(number);
    case Node::Kind::comparison:  // read by select
    case Node::Kind::range:
      break;
  }
  if (node.name == "vector") fail(of, number, "vector(...) stands for several values; expected one number");
  Recorded total(0);
  for_each_index(of, number, [&] { total = total + value(of, node.operands[2]); });
  return total;
}

Recorded Scope::sum(const Expression& of, const Node& node) {
  Recorded total = value(of, node.operands[0]);
  for (std::size_t k = 1; k < node.operands.size(); ++k) {
    const Recorded term = value(of, node.operands[k]);
    total = node.inverted[k] ? total - term : total + term;
    // x - x
    if (structurally_zero(total) && !term.is_constant()) total = nothing_of(term);
  }
  return total;
}

Recorded Scope::product(const Expression& of, const Node& node) {
  Recorded total = value(of, node.operands[0]);
  for (std::size_t k = 1; k < node.operands.size(); ++k) {
    const Recorded factor = value(of, node.operands[k]);
    if (node.inverted[k] && structurally_zero(factor))
      fail(of, node.operands[k], "division by what is always zero" + where_zero(*this, of, node.operands[k]));
    if (structurally_zero(total)) {
      total = nothing_of(node.inverted[k] ? Recorded(1) / factor : factor);
    } else if (structurally_zero(factor)) {
      total = nothing_of(total);
    } else {
      total = node.inverted[k] ? total / factor : total * factor;
    }
    if (total.is_constant() && !isfinite(total.constant().quad()))
      fail(of, node.operands[k], "this constant is not finite");
  }
  return total;
}

Recorded Scope::power(const Expression& of, std::size_t node, const Recorded& base,
                      const Recorded& exponent) {
  if (base.is_constant() && exponent.is_constant()) {
    const Real &x = base.constant(), &y = exponent.constant();
    if (x.is(0) && y < Real(0)) fail(of, node, "division by what is always zero");
    const Real result = is_small_whole(y) ? whole_power(x, y.numerator()) : pow(x, y);
    if (!isfinite(result.quad())) fail(of, node, "this constant is not finite");
    return Recorded(result);
  }
  if (structurally_zero(base)) fail(of, node, "a power of what is always zero");
  if (exponent.is(0)) return Recorded(1) + nothing_of(base);
  if (base.is(1)) return Recorded(1) + nothing_of(exponent);
  return pow(base, exponent);
}

Recorded Scope::function(const Expression& of, std::size_t number) {
  const Node& node = of.node(number);
  if (node.name == "select")
    return chosen(of, number, value(of, node.operands[1]), value(of, node.operands[2]));
  std::vector<Recorded> arguments;
  for (const std::size_t operand : node.operands) arguments.push_back(value(of, operand));
  Recorded result = node.name == "pow" ? power(of, number, arguments[0], arguments[1])
                                       : known_function(node.name)->value(arguments);
  if (result.is_constant() && !isfinite(result.constant().quad()))
    fail(of, number, "this constant is not finite");
  return result;
}

// The first branch of select where its condition is true, else the second one.
Recorded Scope::chosen(const Expression& of, std::size_t number, const Recorded& first,
                       const Recorded& second) {
  const Node& condition = of.node(of.node(number).operands[0]);
  const Recorded x = value(of, condition.operands[0]), y = value(of, condition.operands[1]);
  const bool larger = condition.name.front() == '>', or_equal = condition.name.size() == 2;
  // x > y is the branch of a positive x - y, and x <= y the other branch of it.
  const Recorded difference = larger == or_equal ? y - x : x - y;
  return or_equal ? select(difference, second, first) : select(difference, first, second);
}

Recorded Scope::named(const Expression& of, std::size_t number) {
  const std::string& name = of.node(number).name;
  const auto index =
      std::find_if(indices_.rbegin(), indices_.rend(), [&](const Index& i) { return i.name == name; });
  if (index != indices_.rend()) return index->value;
  const Entry& found = entry(of, number);
  if (found.state == Entry::State::elements)
    fail(of, number,
         "'" + name + "' is a list of " + std::to_string(found.elements.size()) +
             (found.elements.size() == 1 ? " number" : " numbers") + "; expected one of them, " + name +
             "[index]");
  return found.value;
}

Recorded Scope::element(const Expression& of, std::size_t number) {
  const Node& node = of.node(number);
  const Entry& found = entry(of, number);
  if (found.state != Entry::State::elements)
    fail(of, number, "'" + node.name + "' is one number; expected it without an index");
  const int index = whole_number(of, node.operands[0], "expected a whole number as index");
  const auto count = static_cast<int>(found.elements.size());
  if (index < 1 || index > count)
    fail(of, node.operands[0],
         "index " + std::to_string(index) + " of '" + node.name + "' is out of range; expected 1 .. " +
             std::to_string(count));
  return found.elements[static_cast<std::size_t>(index) - 1];
}

template <class Visit>
void Scope::for_each_index(const Expression& of, std::size_t number, Visit&& visit) {
  const Node& node = of.node(number);
  const bool taken =
      entries_.contains(node.variable) ||
      std::any_of(indices_.begin(), indices_.end(), [&](const Index& i) { return i.name == node.variable; });
  if (taken)
    fail(of, number,
         "the index '" + node.variable + "' of " + node.name +
             " is the name of something else; expected another name");
  const int first = whole_number(of, node.operands[0], "expected a whole number as first index"),
            last = whole_number(of, node.operands[1], "expected a whole number as last index");
  indices_.push_back({node.variable, {}});
  for (int k = first; k <= last; ++k) {
    indices_.back().value = Recorded(k);
    visit();
  }
  indices_.pop_back();
}

const Scope::Entry& Scope::entry(const Expression& of, std::size_t number) {
  const std::string& name = of.node(number).name;
  const auto place = entries_.find(name);
  if (place == entries_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, meaning] : entries_)
      if (meaning.state != Entry::State::withheld) known.push_back(other);
    for (const Index& index : indices_) known.emplace_back(index.name);
    if (known.size() > 20 && nearest(name, known).empty()) known.resize(20);
    fail(of, number, unknown_name("name", name, known));
  }
  Entry& found = place->second;
  if (found.state == Entry::State::withheld) fail(of, number, "'" + name + "' " + found.reason);
  if (found.state == Entry::State::being_read)
    fail(of, number, "'" + name + "' is defined by itself: " + reading_ + name);
  if (found.state != Entry::State::unread) return found;
  // A definition knows nothing of the indices of sums that read it.
  std::vector<Index> outside;
  std::swap(outside, indices_);
  const std::size_t chain = reading_.size();
  reading_ += name + " -> ";
  found.state = Entry::State::being_read;
  std::vector<Recorded> values;
  if (found.is_list) {
    for (const Expression& definition : found.definitions) append(definition, values);
  } else {
    values.push_back(evaluate(found.definitions.front()));
  }
  found.elements = std::move(values);
  found.state = found.is_list ? Entry::State::elements : Entry::State::value;
  if (!found.is_list) found.value = found.elements.front();
  reading_.resize(chain);
  std::swap(outside, indices_);
  return found;
}

Real constant(const Source& source) { return Scope().constant(Expression(source)); }

}  // namespace pfaff::text
