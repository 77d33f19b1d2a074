// Names as LaTeX writes them: theta1 is \theta_{1}, p_x is p_{x}, length is \mathit{length}.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace pfaff::emit {

/// A symbol: a base and a subscript, which may be empty.
struct LatexName {
  std::string base, subscript;
  [[nodiscard]] std::string text() const { return subscript.empty() ? base : base + "_{" + subscript + "}"; }
  /// Its rate.
  [[nodiscard]] std::string dotted() const {
    return "\\dot{" + base + "}" + (subscript.empty() ? "" : "_{" + subscript + "}");
  }
};

/// Gives names, no two of them the same.
class LatexNames {
 public:
  LatexName operator()(std::string_view wanted);

 private:
  std::set<std::string> taken_;
};

/// Words and units as text: "kg m^2/s" is kg m$^{2}$/s.
std::string latex_words(std::string_view text);

}  // namespace pfaff::emit
