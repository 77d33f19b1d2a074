// Expressions as text: what is written in a file in place of a C++ formula.
//
//   + - * / ^ and unary minus, with ^ first and from the right: -x^2 is -(x^2), 2^3^2 is 2^9
//   sqrt exp log sin cos tan asin acos atan sinh cosh tanh erf abs sign of one argument, pow(x, y),
//   atan2(y, x), min(x, y), max(x, y)
//   select(x < y, a, b), with one of < > <= >= in the condition
//   name, name[index] counted from 1
//   sum(i, first, last, of i) and vector(i, first, last, of i); the latter stands for several values of a
//   list
//
// Decimals are exact ("0.1" is 1/10 in every precision). An expression is parsed once, and then evaluated
// with values for its names (core/text/scope.hpp).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/numbers/real.hpp>
#include <pfaff/core/text/source.hpp>

namespace pfaff::text {

/// One operation of an expression. Operands are nodes of the same expression, by their numbers.
struct Node {
  enum class Kind {
    number,      // value
    name,        // name
    element,     // name[operand]
    negate,      // -operand
    sum,         // operands, each added or subtracted, from left to right
    product,     // operands, each multiplied or divided by, from left to right
    power,       // operand ^ operand
    function,    // name(operands)
    comparison,  // operand name operand, the condition of select: name is <, >, <= or >=
    call,        // name(operands) of a function that the scope gives a meaning
    range        // name is "sum" or "vector", variable is the index: first, last, body
  };
  Kind kind = Kind::number;
  std::size_t offset = 0;  // of its place in the text
  Real value{};
  std::string name{}, variable{};
  std::vector<std::size_t> operands{};
  std::vector<bool> inverted{};  // of sums and products: subtracted, divided by
};

/// A function, and how many arguments it has.
struct Function {
  std::string_view name;
  std::size_t arguments;
};

/// A parsed expression, cheap to copy.
class Expression {
 public:
  /// Parses a text. TextError where it is none. `more` are functions beside those above, which a scope is
  /// told the meaning of (Scope::give_meaning).
  explicit Expression(Source source, std::span<const Function> more = {});

  [[nodiscard]] const Source& source() const { return tree_->source; }
  [[nodiscard]] const Node& node(std::size_t number) const { return tree_->nodes[number]; }
  [[nodiscard]] std::size_t root() const { return tree_->root; }
  /// True where it stands for several values of a list: vector(...).
  [[nodiscard]] bool is_vector() const;
  /// The names that it reads, each once, without the indices of its own sums.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  friend class Parser;
  struct Tree {
    Source source;
    std::vector<Node> nodes;
    std::size_t root = 0;
  };
  std::shared_ptr<const Tree> tree_;
};

/// Names that expressions have a meaning for, and that nothing else may be called: functions, sum, vector, t
/// and pi.
const std::vector<std::string>& reserved_names();

}  // namespace pfaff::text
