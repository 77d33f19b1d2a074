#include <pfaff/core/emit/cpp_function.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace pfaff::emit {

const std::string_view cpp_reserved =
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t "
    "class compl concept const consteval constexpr constinit const_cast continue co_await co_return co_yield "
    "decltype default delete do double dynamic_cast else enum explicit export extern false float for friend "
    "goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private "
    "protected public register reinterpret_cast requires return short signed sizeof static static_assert "
    "static_cast struct switch template this thread_local throw true try typedef typeid typename union "
    "unsigned "
    "using virtual void volatile wchar_t while xor xor_eq std NAN INFINITY EOF errno assert linux unix "
    "pow abs fabs state parameters results shared arguments solve "
    "main "
    "as_lanes "
    "choose_lanes each_lane lane_of lane_count lanes4 lanes8 half_power";

Phrase Cpp::number(const Real& value) const {
  const double x = value.value();
  if (x != x) return {"(0.0 / 0.0)", Strength::atom};
  if (x - x != 0) return {x > 0 ? "(1.0 / 0.0)" : "(-1.0 / 0.0)", Strength::atom};
  std::string text = double_text(value);
  const bool negative = text.front() == '-';
  return {std::move(text), negative ? Strength::sum : Strength::atom};
}
Phrase Cpp::function(std::string_view name, const Phrase& argument) const {
  return {prefix_ + std::string(name) + "(" + argument.text + ")", Strength::atom};
}
Phrase Cpp::power(const Phrase& base, const Real& exponent) const {
  if (is_small_half_integer(exponent))
    return {"half_power(" + base.text + ", " + std::to_string(exponent.numerator()) + ")", Strength::atom};
  return {prefix_ + "pow(" + base.text + ", " + double_text(exponent) + ")", Strength::atom};
}
Phrase Cpp::choice(const Phrase& condition, const Phrase& positive, const Phrase& otherwise) const {
  return {"(" + condition.text + " > 0.0 ? " + positive.text + " : " + otherwise.text + ")", Strength::atom};
}

Phrase CppInLanes::choice(const Phrase& condition, const Phrase& positive, const Phrase& otherwise) const {
  return {"choose_lanes(" + condition.text + ", " + positive.text + ", " + otherwise.text + ")",
          Strength::atom};
}

bool cut_into_parts(const Tape& tape) { return tape.code.size() / 2 > cpp_part_size; }

Plan cpp_plan(const Tape& tape, const Cpp& language) {
  PlanRules rules = language.rules();
  rules.name_outputs = cut_into_parts(tape);
  return {tape, rules};
}

std::string cpp_half_power(const std::string& prefix) {
  return R"(// x^(n/2) for odd n, by products and a root.
template <class N>
inline N half_power(const N& x, int n) {
  N result = )" +
         prefix + R"(sqrt(x), square = x;
  for (int whole = (n < 0 ? -n : n) / 2; whole > 0; whole /= 2) {
    if (whole % 2 == 1) result = result * square;
    if (whole > 1) square = square * square;
  }
  return n < 0 ? 1.0 / result : result;
}

)";
}

std::string cpp_solver(const Tape& tape) {
  if (tape.solves.empty()) return {};
  return R"(// Solves a x = b for an n x n matrix a, row by row, which is overwritten. The pivot of a column is the entry
// that is largest in units of its row. A singular matrix gives x = NaN.
template <int n>
void solve(double* a, const double* b, double* x) {
  int order[n];
  double scale[n], reciprocal[n];
  bool regular = true;
  for (int i = 0; i < n; ++i) {
    order[i] = i;
    double largest = 0.0;
    for (int j = 0; j < n; ++j) {
      const double size = a[i * n + j] < 0.0 ? -a[i * n + j] : a[i * n + j];
      if (size > largest) largest = size;
    }
    regular = regular && largest > 0.0 && largest - largest == 0.0;
    scale[i] = 1.0 / largest;
  }
  for (int k = 0; k < n && regular; ++k) {
    int pivot = k;
    double best = -1.0;
    for (int i = k; i < n; ++i) {
      const double size = (a[i * n + k] < 0.0 ? -a[i * n + k] : a[i * n + k]) * scale[i];
      if (size > best) {
        best = size;
        pivot = i;
      }
    }
    regular = best > 0.0 && best - best == 0.0;
    if (pivot != k) {
      for (int j = 0; j < n; ++j) {
        const double moved = a[k * n + j];
        a[k * n + j] = a[pivot * n + j];
        a[pivot * n + j] = moved;
      }
      const int row = order[k];
      order[k] = order[pivot];
      order[pivot] = row;
      const double unit = scale[k];
      scale[k] = scale[pivot];
      scale[pivot] = unit;
    }
    reciprocal[k] = 1.0 / a[k * n + k];
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] * reciprocal[k];
      a[i * n + k] = factor;
      for (int j = k + 1; j < n; ++j) a[i * n + j] = a[i * n + j] - factor * a[k * n + j];
    }
  }
  for (int i = 0; i < n; ++i) {
    double sum = regular ? b[order[i]] : 0.0 / 0.0;
    for (int j = 0; j < i && regular; ++j) sum = sum - a[i * n + j] * x[j];
    x[i] = sum;
  }
  for (int i = n; i-- > 0 && regular;) {
    double sum = x[i];
    for (int j = i + 1; j < n; ++j) sum = sum - a[i * n + j] * x[j];
    x[i] = reciprocal[i] * sum;
  }
}

)";
}

namespace {
std::size_t at(int slot) { return static_cast<std::size_t>(slot); }

class FunctionWriter {
 public:
  FunctionWriter(const Tape& tape, const Plan& plan, const Cpp& language, const CppInterface& interface,
                 std::vector<std::string> names)
      : tape_(tape),
        plan_(plan),
        interface_(interface),
        names_(std::move(names)),
        expressions_(tape, language, names_) {}

  std::string whole() {
    std::string body = inputs(plan_.statements(), tape_.outputs);
    for (const int slot : plan_.statements()) body += statement(slot);
    std::vector<std::string> values;
    for (const int slot : tape_.outputs) values.push_back(expressions_.value(slot).text);
    return head() + body + results(values) + "}\n";
  }

  std::string in_parts() {
    cut();
    find_last_readers();
    std::string text;
    for (std::size_t p = 0; p < parts_.size(); ++p) text += part(p);
    text += head();
    const std::string array = places_ > 0 ? "shared" : "nullptr";
    if (places_ > 0) text += "  " + interface_.number + " shared[" + std::to_string(places_) + "];\n";
    for (std::size_t p = 0; p < parts_.size(); ++p)
      text += "  " + part_name(p) + "(" + interface_.part_arguments + ", " + array + ");\n";
    std::vector<std::string> values;
    std::vector<int> unnamed;
    for (const int slot : tape_.outputs) {
      if (plan_.named(slot)) {
        values.push_back("shared[" + std::to_string(place_.at(slot)) + "]");
      } else {
        unnamed.push_back(slot);
        values.push_back(expressions_.value(slot).text);
      }
    }
    return text + inputs({}, unnamed) + results(values) + "}\n";
  }

 private:
  [[nodiscard]] std::string head() const {
    return "extern \"C\" void " + interface_.name + "(" + interface_.parameters + ") {\n";
  }
  [[nodiscard]] std::string part_name(std::size_t p) const {
    return interface_.name + "_part_" + std::to_string(p + 1);
  }
  [[nodiscard]] std::string results(const std::vector<std::string>& values) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
      text += "  results[" + std::to_string(k) + "] = " + as_number(values[k]) + ";\n";
    return text;
  }
  // A value in the type of all numbers, which an expression of constants alone does not have.
  [[nodiscard]] std::string as_number(const std::string& value) const {
    return interface_.number == "double" ? value : "as_lanes<" + interface_.number + ">(" + value + ")";
  }

  // Calls visit(slot) for all that the definition of a statement, or the value of an output, reads.
  template <class Visit>
  void read_by(int slot, bool as_output, Visit&& visit) const {
    if (as_output && (plan_.named(slot) || is_atom(tape_.code[at(slot)]))) {
      visit(slot);
    } else {
      visit_parts(tape_, plan_, slot, visit);
    }
  }

  // Local variables for the inputs that the statements and outputs read.
  [[nodiscard]] std::string inputs(const std::vector<int>& statements,
                                   const std::vector<int>& outputs) const {
    std::set<int> read;
    const auto note = [&](int slot) {
      if (const Instruction& i = tape_.code[at(slot)]; i.operation == Operation::input) read.insert(i.a);
    };
    for (const int slot : statements) read_by(slot, false, note);
    for (const int slot : outputs) read_by(slot, true, note);
    std::string text;
    for (const int k : read)
      text += "  const " + interface_.number + " " + interface_.input_names[at(k)] + " = " +
              interface_.input_values[at(k)] + ";\n";
    return text;
  }

  [[nodiscard]] std::string statement(int slot) const {
    const Instruction& i = tape_.code[at(slot)];
    const std::string& name = names_[at(slot)];
    if (i.operation != Operation::solve)
      return "  const " + interface_.number + " " + name + " = " +
             as_number(expressions_.definition(slot).text) + ";\n";
    const LinearSystem& system = tape_.solves[at(i.a)];
    const std::vector<Phrase> entries = expressions_.entries(system);
    const auto size = static_cast<std::size_t>(system.size);
    const auto list = [&](std::size_t begin, std::size_t end) {
      std::string text;
      for (std::size_t k = begin; k < end; ++k) text += (k == begin ? "" : ", ") + entries[k].text;
      return text;
    };
    const std::string of = "_of_" + name;
    std::string text = "  double matrix" + of + "[] = {" + list(0, size * size) + "};\n";
    text += "  const double right" + of + "[] = {" + list(size * size, entries.size()) + "};\n";
    text += "  double solution" + of + "[" + std::to_string(size) + "];\n";
    text += "  solve<" + std::to_string(size) + ">(matrix" + of + ", right" + of + ", solution" + of + ");\n";
    for (std::size_t k = 0; k < size; ++k)
      text += "  [[maybe_unused]] const double " + names_[at(slot) + k] + " = solution" + of + "[" +
              std::to_string(k) + "];\n";
    return text;
  }

  // Which statements make which part, and in which part each slot is computed.
  void cut() {
    int operations = 0;
    for (const int slot : plan_.statements()) {
      if (parts_.empty() || operations > cpp_part_size) {
        parts_.emplace_back();
        operations = 0;
      }
      parts_.back().push_back(slot);
      operations += plan_.operations(slot);
      for (const int component : components(slot)) part_of_[component] = parts_.size() - 1;
    }
  }
  [[nodiscard]] std::vector<int> components(int slot) const {
    const Instruction& i = tape_.code[at(slot)];
    std::vector<int> all{slot};
    if (i.operation == Operation::solve)
      for (int k = 1; k < tape_.solves[at(i.a)].size; ++k) all.push_back(slot + k);
    return all;
  }
  // The last part that reads each number that more than its own part reads. Outputs are read after all parts.
  void find_last_readers() {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const int slot : parts_[p])
        read_by(slot, false, [&](int read) {
          if (plan_.named(read) && part_of_.at(read) != p) last_reader_[read] = p;
        });
    for (const int slot : tape_.outputs)
      if (plan_.named(slot)) last_reader_[slot] = parts_.size();
  }

  // One part: it reads what earlier parts have shared, computes, and shares what later ones read.
  std::string part(std::size_t p) {
    std::set<int> foreign;
    for (const int slot : parts_[p])
      read_by(slot, false, [&](int read) {
        if (plan_.named(read) && part_of_.at(read) != p) foreign.insert(read);
      });
    std::string text = "[[gnu::noinline]] static void " + part_name(p) + "(" + interface_.part_parameters +
                       ", [[maybe_unused]] " + interface_.number + "* shared) {\n" + inputs(parts_[p], {});
    for (const int slot : foreign)
      text += "  const " + interface_.number + " " + names_[at(slot)] + " = shared[" +
              std::to_string(place_.at(slot)) + "];\n";
    for (const int slot : parts_[p]) text += statement(slot);
    for (const int slot : foreign)
      if (last_reader_.at(slot) == p) free_.push_back(place_.at(slot));
    for (const int first : parts_[p])
      for (const int slot : components(first)) {
        if (last_reader_.count(slot) == 0) continue;
        if (free_.empty()) free_.push_back(places_++);
        place_[slot] = free_.back();
        free_.pop_back();
        text += "  shared[" + std::to_string(place_[slot]) + "] = " + names_[at(slot)] + ";\n";
      }
    return text + "}\n\n";
  }

  const Tape& tape_;
  const Plan& plan_;
  const CppInterface& interface_;
  std::vector<std::string> names_;
  Expressions expressions_;
  std::vector<std::vector<int>> parts_;
  std::map<int, std::size_t> part_of_, last_reader_;
  std::map<int, int> place_;
  std::vector<int> free_;
  int places_ = 0;
};
}  // namespace

std::string cpp_function(const Tape& tape, const Plan& plan, const Cpp& language,
                         const CppInterface& interface, std::vector<std::string> names) {
  FunctionWriter writer(tape, plan, language, interface, std::move(names));
  return cut_into_parts(tape) ? writer.in_parts() : writer.whole();
}

}  // namespace pfaff::emit
