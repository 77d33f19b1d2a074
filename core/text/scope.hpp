// Scope: what the names of expressions stand for, and the evaluation of expressions with it.
//
// Values are of the recording scalar. With inputs of a recorder among them, evaluating an expression records
// it; with constants alone its value is a constant again, exactly as far as fractions reach. Names may also
// stand for expressions of other names ("let"), which are evaluated once, when they are first read. A scope
// that has thrown an error is of no further use.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/core/text/expression.hpp>

namespace pfaff::text {

class Scope {
 public:
  /// Knows pi alone.
  Scope();

  /// A name for a number, for several, read as name[1], name[2], ..., or for an expression. A name that is
  /// there already is replaced.
  void define(const std::string& name, const Recorded& value);
  void define(const std::string& name, std::vector<Recorded> elements);
  void define(const std::string& name, Expression definition);
  void define(const std::string& name, std::vector<Expression> definitions);
  /// A name that is known and may not be read here; whoever does is told the reason.
  void withhold(const std::string& name, const std::string& reason);

  /// The meaning of the functions that expressions were parsed with beside those that all have: the value of
  /// a node that calls one of them.
  using Meaning = std::function<Recorded(std::size_t node)>;
  void give_meaning(Meaning meaning) { meaning_ = std::move(meaning); }

  /// The value of an expression. TextError, with the place, for names that are unknown (the nearest one is
  /// named) or withheld, definitions that contain themselves, indices out of range, divisions by what is zero
  /// whatever the values are, and constants that are not finite.
  Recorded evaluate(const Expression& expression) { return value(expression, expression.root()); }
  /// The value of one of its nodes.
  Recorded value(const Expression& of, std::size_t node);
  /// The same for an item of a list, where vector(...) and the bare name of several numbers stand for all of
  /// them: appends the values to `values`.
  void append(const Expression& expression, std::vector<Recorded>& values);
  /// The value of an expression that must be a constant. TextError where it depends on what is recorded.
  Real constant(const Expression& expression);
  /// The value of an expression that must be a whole number below 2^30 in magnitude.
  int whole_number(const Expression& expression);

  /// Bounds the number of operations of all evaluations together (TextError beyond), so that no text makes
  /// the program run without end.
  void limit_operations(long most) { operations_left_ = most; }

 private:
  struct Entry {
    enum class State { value, elements, unread, being_read, withheld };
    State state = State::value;
    Recorded value{};
    std::vector<Recorded> elements{};
    std::vector<Expression> definitions{};
    bool is_list = false;  // of definitions: stands for several numbers
    std::string reason{};
  };
  struct Index {
    std::string_view name;
    Recorded value;
  };
  class Call;

  [[noreturn]] static void fail(const Expression& of, std::size_t node, const std::string& message);
  Recorded sum(const Expression& of, const Node& node);
  Recorded product(const Expression& of, const Node& node);
  Recorded power(const Expression& of, std::size_t node, const Recorded& base, const Recorded& exponent);
  Recorded function(const Expression& of, std::size_t node);
  Recorded chosen(const Expression& of, std::size_t node, const Recorded& first, const Recorded& second);
  Recorded named(const Expression& of, std::size_t node);
  Recorded element(const Expression& of, std::size_t node);
  void append_node(const Expression& of, std::size_t node, std::vector<Recorded>& values);
  /// Calls visit() with the index of the range set to each of its values in turn.
  template <class Visit>
  void for_each_index(const Expression& of, std::size_t node, Visit&& visit);
  int whole_number(const Expression& of, std::size_t node, const std::string& what);
  /// What the name stands for, evaluated if need be.
  const Entry& entry(const Expression& of, std::size_t node);

  std::map<std::string, Entry, std::less<>> entries_;
  Meaning meaning_;
  std::vector<Index> indices_;  // of the sums that are being evaluated, inner ones last
  std::string reading_;         // the chain of definitions that are being evaluated, for messages
  int depth_ = 0;
  long operations_left_ = 20'000'000;
};

/// The value of an expression of constants alone, such as "(1 - 1/sqrt(3))/2".
Real constant(const Source& source);

}  // namespace pfaff::text
