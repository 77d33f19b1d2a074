// What the algorithm of Dirac and Bergmann found, as lines of text.
#include <algorithm>

#include <pfaff/brackets/dirac/dirac_bergmann.hpp>

namespace pfaff {

std::string_view to_string(ConstraintClosure closure) {
  switch (closure) {
    case ConstraintClosure::closed:
      return "closed";
    case ConstraintClosure::inconsistent:
      return "inconsistent";
    case ConstraintClosure::irregular:
      return "irregular";
    case ConstraintClosure::unreachable:
      return "unreachable";
  }
  return "unknown";
}

template <class T>
std::string describe(const ConstraintAlgorithm<T>& result) {
  std::string text;
  std::vector<std::string> names;
  int last = 0;
  for (const FoundConstraint& c : result.constraints) {
    names.push_back(c.name);
    last = std::max(last, c.generation);
  }
  for (int generation = 1; generation <= last; ++generation) {
    text += "generation " + std::to_string(generation) + ":";
    for (const FoundConstraint& c : result.constraints)
      if (c.generation == generation) text += " " + c.name;
    text += "\n";
  }
  if (result.closure != ConstraintClosure::closed)
    return text + std::string(to_string(result.closure)) + ": " + result.trouble;
  text += "closed after " + std::to_string(last) + (last == 1 ? " generation\n" : " generations\n");
  for (std::size_t m = 0; m < result.multipliers.size(); ++m)
    text += "multiplier of " + names[m] +
            (result.multipliers[m].determined ? " = " + to_string(Quad(result.multipliers[m].value), 6) + "\n"
                                              : std::string(" is not determined\n"));
  return text + describe(result.classes, names);
}

template std::string describe(const ConstraintAlgorithm<double>&);
template std::string describe(const ConstraintAlgorithm<Quad>&);

}  // namespace pfaff
