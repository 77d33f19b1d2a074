// A recursive-descent parser of expressions. It calls itself for parentheses, arguments, exponents and signs,
// up to a depth; sums and products of any length are loops.
#include <algorithm>

#include <pfaff/core/text/expression.hpp>
#include <pfaff/core/text/functions.hpp>
#include <pfaff/core/text/lexer.hpp>

namespace pfaff::text {

namespace {

const Function* function_named(std::string_view name, std::span<const Function> list) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Function& f) { return f.name == name; });
  return found == list.end() ? nullptr : &*found;
}
const Function* function_named(std::string_view name) {
  const KnownFunction* known = known_function(name);
  return known == nullptr ? nullptr : &known->function;
}
bool is_comparison(std::string_view sign) {
  return sign == "<" || sign == ">" || sign == "<=" || sign == ">=";
}
constexpr const char* where_compared =
    "values are compared in the condition of select(condition, a, b) alone";
bool is_range(std::string_view name) { return name == "sum" || name == "vector"; }
}  // namespace

class Parser {
 public:
  Parser(Source source, std::span<const Function> more) : more_(more) {
    tree_.source = std::move(source);
    Lexer lexer(tree_.source);
    for (;;) {
      tokens_.push_back(lexer.next());
      if (tokens_.back().kind == Token::Kind::end) break;
    }
  }

  [[nodiscard]] Expression::Tree parse() && {
    tree_.root = sum();
    if (is_comparison(here().text)) fail(here(), where_compared);
    if (here().kind != Token::Kind::end) {
      const bool operand = here().kind != Token::Kind::sign || here().text == "(" || here().text == "[";
      fail(here(), operand ? "expected an operator such as * before '" + word(here()) + "'"
                           : "expected the end of the expression before '" + word(here()) + "'");
    }
    return std::move(tree_);
  }

 private:
  [[nodiscard]] const Token& here() const { return tokens_[at_]; }
  [[nodiscard]] bool is(std::string_view sign) const {
    return here().kind == Token::Kind::sign && here().text == sign;
  }
  Token take() {
    const Token token = here();
    if (token.kind != Token::Kind::end) ++at_;
    return token;
  }
  static std::string word(const Token& token) { return std::string(token.text); }
  [[noreturn]] void fail(const Token& token, const std::string& message) const {
    refuse(tree_.source, token.offset, message);
  }
  void expect(std::string_view sign, const std::string& where) {
    if (!is(sign))
      fail(here(), "expected '" + std::string(sign) + "' " + where +
                       (here().kind == Token::Kind::end ? "" : " before '" + word(here()) + "'"));
    take();
  }
  std::size_t add(Node node) {
    tree_.nodes.push_back(std::move(node));
    return tree_.nodes.size() - 1;
  }

  // Terms joined by one of two signs of the same rank; a single term is itself.
  template <class Term>
  std::size_t joined(Node::Kind kind, std::string_view sign, std::string_view inverse, Term&& term) {
    Node node{.kind = kind, .offset = here().offset};
    node.operands.push_back(term());
    node.inverted.push_back(false);
    while (is(sign) || is(inverse)) {
      const Token token = take();
      if (token.text == "*" && is("*")) fail(here(), "expected ^ for a power instead of **");
      node.inverted.push_back(token.text == inverse);
      node.operands.push_back(term());
    }
    return node.operands.size() == 1 ? node.operands.front() : add(std::move(node));
  }
  std::size_t sum() {
    return joined(Node::Kind::sum, "+", "-",
                  [&] { return joined(Node::Kind::product, "*", "/", [&] { return factor(); }); });
  }

  std::size_t factor() {
    const Depth deeper(*this);
    if (is("+")) {
      take();
      return factor();
    }
    if (is("-")) {
      Node node{.kind = Node::Kind::negate, .offset = take().offset};
      node.operands.push_back(factor());
      return add(std::move(node));
    }
    const std::size_t base = primary();
    if (!is("^")) return base;
    Node node{.kind = Node::Kind::power, .offset = take().offset};
    node.operands = {base, factor()};
    return add(std::move(node));
  }

  std::size_t primary() {
    const Token token = take();
    if (token.kind == Token::Kind::number) {
      const auto value = Real::parse(token.text);
      if (!value) fail(token, "'" + word(token) + "' is too large for a number");
      return add({.kind = Node::Kind::number, .offset = token.offset, .value = *value});
    }
    if (token.kind == Token::Kind::name) return named(token);
    if (token.kind == Token::Kind::sign && token.text == "(") {
      const std::size_t inside = sum();
      if (is_comparison(here().text)) fail(here(), where_compared);
      expect(")", "for the '(' in column " + std::to_string(token.offset + 1) + " of the text");
      return inside;
    }
    fail(token, token.kind == Token::Kind::end
                    ? "the expression ends here; expected a number, a name or a parenthesis"
                    : "expected a number, a name or a parenthesis before '" + word(token) + "'");
  }

  std::size_t named(const Token& token) {
    Node node{.offset = token.offset};
    node.name = word(token);
    const Function* function = function_named(token.text);
    node.kind = function != nullptr ? Node::Kind::function : Node::Kind::call;
    if (function == nullptr) function = function_named(token.text, more_);
    if (is("(")) {
      if (is_range(token.text)) return range(std::move(node));
      if (function == nullptr) {
        std::vector<std::string> known{"sum", "vector"};
        for (const KnownFunction& f : known_functions()) known.emplace_back(f.function.name);
        for (const Function& f : more_) known.emplace_back(f.name);
        fail(token, unknown_name("function", node.name, known));
      }
      return call(std::move(node), *function);
    }
    if (function != nullptr || is_range(token.text))
      fail(here(), "expected '(' behind the function '" + node.name + "'");
    node.kind = Node::Kind::name;
    if (is("[")) {
      take();
      node.kind = Node::Kind::element;
      node.operands.push_back(sum());
      expect("]", "behind the index of '" + node.name + "'");
    }
    return add(std::move(node));
  }
  std::size_t call(Node node, const Function& function) {
    const Token open = take();
    node.operands.push_back(node.kind == Node::Kind::function && function.name == "select" ? comparison()
                                                                                           : sum());
    while (is(",")) {
      take();
      node.operands.push_back(sum());
    }
    if (node.operands.size() != function.arguments)
      fail(open, node.name + ": expected " + std::to_string(function.arguments) +
                     (function.arguments == 1 ? " argument" : " arguments") + ", got " +
                     std::to_string(node.operands.size()));
    if (is_comparison(here().text)) fail(here(), where_compared);
    expect(")", "behind the arguments of '" + node.name + "'");
    return add(std::move(node));
  }
  std::size_t comparison() {
    const std::size_t left = sum();
    if (!is_comparison(here().text))
      fail(here(),
           "select: expected a comparison as its condition, such as x < y, before '" + word(here()) + "'");
    const Token token = take();
    Node node{.kind = Node::Kind::comparison, .offset = token.offset, .name = word(token)};
    node.operands = {left, sum()};
    if (is_comparison(here().text)) fail(here(), "select: expected one comparison as its condition");
    return add(std::move(node));
  }
  std::size_t range(Node node) {
    const std::string form = node.name + "(index, first, last, expression)";
    node.kind = Node::Kind::range;
    take();
    const Token index = take();
    const auto& reserved = reserved_names();
    if (index.kind != Token::Kind::name) fail(index, "expected the name of an index, as in " + form);
    if (std::find(reserved.begin(), reserved.end(), index.text) != reserved.end())
      fail(index, "'" + word(index) + "' has a meaning of its own; expected another name for the index");
    node.variable = word(index);
    for (int k = 0; k < 3; ++k) {
      expect(",", "as in " + form);
      node.operands.push_back(sum());
    }
    expect(")", "as in " + form);
    return add(std::move(node));
  }

  // Counts how deep the parser has called itself.
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      constexpr int deepest = 200;
      if (++parser_.depth_ > deepest)
        parser_.fail(parser_.here(), "expected at most " + std::to_string(deepest) +
                                         " parentheses, signs and exponents inside one another");
    }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    ~Depth() { --parser_.depth_; }

   private:
    Parser& parser_;
  };

  std::span<const Function> more_;
  Expression::Tree tree_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(Source source, std::span<const Function> more)
    : tree_(std::make_shared<const Tree>(Parser(std::move(source), more).parse())) {}

bool Expression::is_vector() const {
  const Node& top = node(root());
  return top.kind == Node::Kind::range && top.name == "vector";
}

std::vector<std::string> Expression::names() const {
  std::vector<std::string> read, indices;
  for (const Node& n : tree_->nodes) {
    if (n.kind == Node::Kind::name || n.kind == Node::Kind::element) read.push_back(n.name);
    if (n.kind == Node::Kind::range) indices.push_back(n.variable);
  }
  std::sort(read.begin(), read.end());
  read.erase(std::unique(read.begin(), read.end()), read.end());
  std::erase_if(read, [&](const std::string& name) {
    return std::find(indices.begin(), indices.end(), name) != indices.end();
  });
  return read;
}

const std::vector<std::string>& reserved_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"t", "pi", "sum", "vector"};
    for (const KnownFunction& f : known_functions()) all.emplace_back(f.function.name);
    return all;
  }();
  return names;
}

}  // namespace pfaff::text
