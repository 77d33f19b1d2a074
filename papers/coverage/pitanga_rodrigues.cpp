// The items of Pitanga & Rodrigues, in the order of the paper.
#include <pfaff/papers/coverage/coverage.hpp>

namespace pfaff {

const std::vector<PaperItem>& pitanga_rodrigues_items() {
  using enum ItemKind;
  using enum Cover;
  static const std::vector<PaperItem> items{
      {"Gamma", statement},
      {"(1)"},
      {"(2)"},
      {"(3)"},
      {"(4)"},
      {"Remark 1", remark},
      {"(5)"},
      {"(6)"},
      {"figure of the splitting", figure, reason, "a drawing"},
      {"(7)"},
      {"(8)"},
      {"(9)"},
      {"(10)"},
      {"X_u", statement},
      {"(11)"},
      {"(12)"},
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
      {"(18)"},
      {"(19)"},
      {"(20)"},
      {"(21)"},
      {"(22)"},
      {"(23)"},
      {"(24)"},
      {"(25)"},
      {"(26)"},
      {"position of the sleigh", statement},
      {"(27)"},
      {"(28)"},
      {"(29)"},
      {"(30)"},
      {"(31)"},
      {"(32)"},
      {"(33)"},
      {"Q of the sleigh", statement},
      {"Remark 2", remark},
      {"(34)"},
      {"(35)"},
      {"Hamiltonian of the sleigh", statement},
      {"contact form's matrices", statement},
      {"Heisenberg algebra", statement},
      {"(36)"},
      {"(37)"},
      {"(38)"},
      {"Bates-Sniatycki", statement},
      {"(39)"},
      {"(40)"},
      {"(41)"},
  };
  return items;
}

}  // namespace pfaff
