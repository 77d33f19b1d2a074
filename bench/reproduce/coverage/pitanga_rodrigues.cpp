// The items of Pitanga & Rodrigues, in the order of the paper.
#include <pfaff/bench/reproduce/coverage/coverage.hpp>

namespace pfaff {

const std::vector<PaperItem>& pitanga_rodrigues_items() {
  using enum ItemKind;
  using enum Cover;
  static const std::vector<PaperItem> items{
      {"(1)", equation, pending, "with section 2.1"},
      {"(2)", equation, pending, "with section 2.1"},
      {"(3)", equation, pending, "with section 2.1"},
      {"(4)", equation, pending, "with section 2.1"},
      {"Remark 1", remark, pending, "with section 2.1"},
      {"(5)", equation, pending, "with section 2.2"},
      {"(6)", equation, pending, "with section 2.2"},
      {"figure of the splitting", figure, reason, "a drawing"},
      {"(7)", equation, pending, "with section 2.2"},
      {"(8)", equation, pending, "with section 2.2"},
      {"(9)", equation, pending, "with section 2.2"},
      {"(10)", equation, pending, "with section 2.2"},
      {"(11)", equation, pending, "with section 3.1"},
      {"(12)", equation, pending, "with section 3.1"},
      {"(a)"},
      {"(b)"},
      {"(13)"},
      {"(14)"},
      {"(15)"},
      {"after (15)", statement},
      {"before (16)", statement},
      {"(16)"},
      {"before (17)", statement},
      {"(17)"},
      {"after (17)", statement},
      {"(18)", equation, pending, "with section 4.1"},
      {"(19)", equation, pending, "with section 4.1"},
      {"(20)", equation, pending, "with section 4.1"},
      {"(21)", equation, pending, "with section 4.1"},
      {"(22)", equation, pending, "with section 4.1"},
      {"(23)", equation, pending, "with section 4.1"},
      {"(24)", equation, pending, "with section 4.1"},
      {"(25)", equation, pending, "with section 4.1"},
      {"(26)", equation, pending, "with section 4.1"},
      {"(27)", equation, pending, "with section 4.1"},
      {"(28)", equation, pending, "with section 4.1"},
      {"(29)", equation, pending, "with section 4.1"},
      {"(30)", equation, pending, "with section 4.1"},
      {"(31)", equation, pending, "with section 4.1"},
      {"(32)", equation, pending, "with section 4.1"},
      {"(33)", equation, pending, "with section 4.1"},
      {"Q of the sleigh", statement, pending, "with section 4.1"},
      {"Remark 2", remark, pending, "with section 4.1"},
      {"(34)", equation, pending, "with section 4.1"},
      {"(35)", equation, pending, "with section 4.1"},
      {"contact form's matrices", statement, pending, "with section 4.2"},
      {"Heisenberg algebra", statement, pending, "with section 4.2"},
      {"(36)", equation, pending, "with section 4.2"},
      {"(37)", equation, pending, "with section 4.2"},
      {"(38)", equation, pending, "with section 4.2"},
      {"(39)", equation, pending, "with section 4.2"},
      {"(40)", equation, pending, "with section 4.2"},
      {"(41)", equation, pending, "with section 4.2"},
  };
  return items;
}

}  // namespace pfaff
