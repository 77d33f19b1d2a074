// Random models of beads and rods: a chain, a star or a ring of few beads, with some of the forces.
#include <sstream>

#include "grammar.hpp"

namespace pfaff::fuzz {

namespace {
std::string positive(Choices& choices) { return choices.one_of({"1.0", "0.5", "2", "0.25", "1e-1"}); }

// A model as the texts of its values, which are the same in TOML and in JSON but for inline tables.
class Description {
 public:
  Description(Choices& choices, const char* is) : choices_(choices), is_(is) {
    axes_ = 2 + choices.below(2);
    beads_ = 1 + choices.below(4);
    add("dimension", std::to_string(axes_));
    add("masses", each_bead([&] { return positive(choices); }));
    if (choices.once_in(3)) add("friction", each_bead([&] { return positive(choices); }));
    charged_ = choices.once_in(3);
    if (charged_) add("charges", each_bead([&] { return small(); }));
    if (choices.once_in(3)) add("gravity", choices.once_in(2) ? small() : vector());
    anchored_ = choices.once_in(2);
    if (choices.once_in(2)) anchor_ += "-of-the-whole-model";
    if (anchored_) add("anchors", "{" + key(anchor_) + list(axes_, [](std::size_t) { return "0.0"; }) + "}");
    add_rods();
    // Beads far enough from each other that no two are at one place.
    add("positions", list(beads_, [&](std::size_t k) {
          return list(axes_, [&](std::size_t x) {
            return std::to_string(x == 0 ? k + 1 : choices_.below(2)) + "." +
                   std::to_string(choices_.below(100));
          });
        }));
    if (choices.once_in(3))
      add(choices.one_of({"velocities", "momenta"}), list(beads_, [&](std::size_t) { return vector(); }));
    if (choices.once_in(2)) add_potentials();
  }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& entries() const { return entries_; }

 private:
  void add(const std::string& name, const std::string& value) { entries_.emplace_back(name, value); }
  [[nodiscard]] std::string key(const std::string& name) const { return '"' + name + '"' + is_; }
  std::string small() {
    return choices_.once_in(20) ? random_number(choices_) : choices_.one_of({"0.5", "-1.5", "0", "2"});
  }
  template <class Item>
  std::string list(std::size_t count, Item item) {
    std::string text;
    for (std::size_t k = 0; k < count; ++k) text += (k == 0 ? "" : ", ") + std::string(item(k));
    return '[' + text + ']';
  }
  template <class Item>
  std::string each_bead(Item item) {
    return list(beads_, [&](std::size_t) { return item(); });
  }
  std::string vector() {
    return list(axes_, [&](std::size_t) { return small(); });
  }
  std::string pair(std::size_t a, std::size_t b) {
    return '[' + std::to_string(a) + ", " + std::to_string(b) + ']';
  }

  void add_rods() {
    std::string rods = anchored_ ? "[0, \"" + anchor_ + "\"]" : "";
    std::size_t count = anchored_ ? 1 : 0;
    const bool star = choices_.once_in(2);
    for (std::size_t k = 1; k < beads_; ++k, ++count)
      rods += (count == 0 ? "" : ", ") + pair(star ? 0 : k - 1, k);
    if (!anchored_ && choices_.once_in(3)) return;
    if (choices_.once_in(12) && beads_ > 2) rods += ", " + pair(0, beads_ - 1), ++count;
    add("rods", '[' + rods + ']');
    if (choices_.once_in(3)) add("lengths", list(count, [&](std::size_t) { return positive(choices_); }));
  }
  void add_potentials() {
    std::string all;
    for (std::size_t k = 0, count = 1 + choices_.below(2); k < count; ++k) {
      std::string one;
      const auto set = [&](const std::string& name, const std::string& value) {
        one += (one.empty() ? "" : ", ") + key(name) + value;
      };
      const std::string kind =
          choices_.one_of({"lennard-jones", "coulomb", "spring", "harmonic-angle", "field", "trap"});
      if ((kind == "coulomb" || kind == "field") && !charged_ && !choices_.once_in(20)) continue;
      set("kind", '"' + kind + '"');
      if (kind == "lennard-jones") set("epsilon", positive(choices_)), set("sigma", positive(choices_));
      if (kind == "coulomb") set("strength", small());
      if (kind == "field") set("strength", vector());
      if (kind == "trap") set("stiffness", positive(choices_)), set("center", vector());
      if (kind == "spring" || kind == "harmonic-angle") {
        set("stiffness", positive(choices_));
        set(kind == "spring" ? "length" : "angle", positive(choices_));
        const std::size_t arms = kind == "spring" ? 2 : 3;
        if (beads_ < arms && !choices_.once_in(20)) continue;
        set("beads", '[' + list(arms, [](std::size_t bead) { return std::to_string(bead); }) + ']');
      }
      if ((kind == "lennard-jones" || kind == "coulomb") && choices_.once_in(2))
        set("exclude", std::to_string(choices_.below(4)));
      if ((kind == "lennard-jones" || kind == "coulomb") && choices_.once_in(3))
        set("cutoff", positive(choices_));
      all += (all.empty() ? "{" : ", {") + one + "}";
    }
    if (!all.empty()) add("potentials", '[' + all + ']');
  }

  Choices& choices_;
  const char* is_;
  std::size_t axes_ = 2, beads_ = 1;
  bool charged_ = false, anchored_ = false;
  std::string anchor_ = "origin";
  std::vector<std::pair<std::string, std::string>> entries_;
};
}  // namespace

std::string random_model_toml(Choices& choices) {
  std::string text;
  const Description description(choices, " = ");
  for (const auto& [key, value] : description.entries()) text += key + " = " + value + '\n';
  return text;
}

std::string random_model_json(Choices& choices) {
  std::string text;
  const Description description(choices, ": ");
  for (const auto& [key, value] : description.entries())
    text += (text.empty() ? "{" : ",\n ") + ('"' + key + "\": ") + value;
  return text + "}\n";
}

}  // namespace pfaff::fuzz
