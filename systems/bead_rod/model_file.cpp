#include <pfaff/systems/bead_rod/model_file.hpp>

#include <algorithm>
#include <charconv>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/systems/bead_rod/document.hpp>

namespace pfaff {

namespace {
using Kind = DocumentNode::Kind;

// A value and where it stands, for messages.
class ModelEntry {
 public:
  ModelEntry(const DocumentNode& node, std::string where) : node_(node), where_(std::move(where)) {}

  [[noreturn]] void refuse(const std::string& expected) const {
    throw InputError(
        where_ + ": expected " + expected +
        (node_.kind == Kind::number || node_.kind == Kind::text ? ", got '" + node_.text + "'" : ""));
  }
  [[nodiscard]] bool is(Kind kind) const { return node_.kind == kind; }
  [[nodiscard]] const std::string& text() const {
    if (!is(Kind::text)) refuse("a text");
    return node_.text;
  }
  [[nodiscard]] Real number() const {
    const auto value = is(Kind::number) || is(Kind::text) ? Real::parse(node_.text) : std::nullopt;
    if (!value) refuse("a number");
    return *value;
  }
  [[nodiscard]] std::size_t index() const {
    std::size_t value = 0;
    const std::string& s = node_.text;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (!is(Kind::number) || error != std::errc() || end != s.data() + s.size())
      refuse("the number of a bead, from 0");
    return value;
  }
  [[nodiscard]] int integer() const {
    int value = 0;
    const std::string& s = node_.text;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (!is(Kind::number) || error != std::errc() || end != s.data() + s.size()) refuse("an integer");
    return value;
  }
  [[nodiscard]] std::vector<ModelEntry> items() const {
    if (!is(Kind::list)) refuse("a list");
    std::vector<ModelEntry> result;
    for (std::size_t k = 0; k < node_.items.size(); ++k)
      result.emplace_back(node_.items[k], where_ + "[" + std::to_string(k) + "]");
    return result;
  }
  [[nodiscard]] std::vector<Real> numbers() const {
    std::vector<Real> result;
    for (const ModelEntry& item : items()) result.push_back(item.number());
    return result;
  }
  [[nodiscard]] std::vector<Real> numbers(std::size_t count) const {
    std::vector<Real> result = numbers();
    if (result.size() != count)
      refuse(std::to_string(count) + " numbers, got " + std::to_string(result.size()));
    return result;
  }
  // `count` lists of `width` numbers, one after the other.
  [[nodiscard]] std::vector<Real> rows(std::size_t count, std::size_t width) const {
    const auto lists = items();
    if (lists.size() != count)
      refuse(std::to_string(count) + " lists, one per bead, got " + std::to_string(lists.size()));
    std::vector<Real> result;
    for (const ModelEntry& list : lists)
      for (const Real& x : list.numbers(width)) result.push_back(x);
    return result;
  }
  template <std::size_t N>
  [[nodiscard]] std::vector<std::array<std::size_t, N>> tuples() const {
    std::vector<std::array<std::size_t, N>> result;
    for (const ModelEntry& item : items()) {
      const auto ends = item.items();
      if (ends.size() != N) item.refuse(std::to_string(N) + " beads, got " + std::to_string(ends.size()));
      auto& tuple = result.emplace_back();
      for (std::size_t k = 0; k < N; ++k) tuple[k] = ends[k].index();
    }
    return result;
  }
  [[nodiscard]] const DocumentNode& node() const { return node_; }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const DocumentNode& node_;
  std::string where_;
};

// A table whose keys are checked: finish() refuses those that nobody asked for.
class ModelTable {
 public:
  ModelTable(const ModelEntry& entry, std::string prefix) : entry_(entry), prefix_(std::move(prefix)) {
    if (!entry.is(Kind::table)) entry.refuse("a table");
  }
  std::optional<ModelEntry> find(const std::string& key) {
    asked_.push_back(key);
    for (const auto& [name, node] : entry_.node().members)
      if (name == key) return ModelEntry(node, prefix_ + key);
    return std::nullopt;
  }
  ModelEntry required(const std::string& key) {
    if (const auto entry = find(key)) return *entry;
    throw InputError(entry_.where() + ": key '" + key + "' is missing");
  }
  void finish() const {
    for (const auto& [name, node] : entry_.node().members)
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end())
        throw InputError(entry_.where() + ": " + unknown_name("key", name, asked_));
  }

 private:
  const ModelEntry& entry_;
  std::string prefix_;
  std::vector<std::string> asked_;
};

std::size_t read_end(const BeadRodDescription& d, const ModelEntry& end) {
  if (!end.is(Kind::text)) {
    const std::size_t bead = end.index();
    if (bead >= d.beads())
      throw InputError(end.where() + ": there is no bead " + std::to_string(bead) + "; expected 0 to " +
                       std::to_string(d.beads() - 1) + " or the name of an anchor");
    return bead;
  }
  std::vector<std::string> names;
  for (std::size_t a = 0; a < d.anchors.size(); ++a) {
    if (d.anchors[a].name == end.text()) return d.beads() + a;
    names.push_back(d.anchors[a].name);
  }
  if (names.empty()) end.refuse("the number of a bead: there are no anchors");
  throw InputError(end.where() + ": " + unknown_name("anchor", end.text(), names));
}

void read_rods(BeadRodDescription& d, ModelTable& root) {
  if (const auto rods = root.find("rods"))
    for (const ModelEntry& item : rods->items()) {
      const auto ends = item.items();
      if (ends.size() != 2) item.refuse("two points, got " + std::to_string(ends.size()));
      std::size_t first = read_end(d, ends[0]), second = read_end(d, ends[1]);
      if (first >= d.beads()) std::swap(first, second);
      d.rods.push_back({first, second, Real(0)});
    }
  if (const auto lengths = root.find("lengths")) {
    const auto numbers = lengths->numbers(d.rods.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) d.rods[k].length = numbers[k];
  } else {
    for (Rod& rod : d.rods) rod.length = d.distance(rod.first, rod.second);
  }
}

void read_potential(BeadRodDescription& d, const ModelEntry& entry) {
  ModelTable table(entry, entry.where() + ".");
  const ModelEntry kind = table.required("kind");
  const auto pair = [&](PairPotential p) {
    if (const auto cutoff = table.find("cutoff")) p.cutoff = cutoff->number();
    if (const auto exclude = table.find("exclude")) p.exclude = exclude->integer();
    d.pairs.push_back(p);
  };
  if (kind.text() == "lennard-jones") {
    PairPotential p;
    p.epsilon = table.required("epsilon").number();
    p.sigma = table.required("sigma").number();
    pair(p);
  } else if (kind.text() == "coulomb") {
    PairPotential p;
    p.kind = PairPotential::Kind::coulomb;
    p.strength = table.required("strength").number();
    pair(p);
  } else if (kind.text() == "spring") {
    d.springs.push_back({table.required("stiffness").number(), table.required("length").number(),
                         table.required("beads").tuples<2>()});
  } else if (kind.text() == "harmonic-angle") {
    d.angles.push_back({table.required("stiffness").number(), table.required("angle").number(),
                        table.required("beads").tuples<3>()});
  } else if (kind.text() == "field") {
    d.fields.push_back({table.required("strength").numbers(d.axes())});
  } else if (kind.text() == "trap") {
    d.traps.push_back({table.required("stiffness").number(), table.required("center").numbers(d.axes())});
  } else {
    throw InputError(kind.where() + ": " +
                     unknown_name("potential", kind.text(),
                                  {"lennard-jones", "coulomb", "spring", "harmonic-angle", "field", "trap"}));
  }
  table.finish();
}

void read_motion(BeadRodDescription& d, ModelTable& root) {
  const auto velocities = root.find("velocities"), momenta = root.find("momenta");
  if (velocities && momenta) momenta->refuse("either velocities or momenta, not both");
  d.momenta.assign(d.beads() * d.axes(), Real(0));
  if (momenta) d.momenta = momenta->rows(d.beads(), d.axes());
  if (!velocities) return;
  d.momenta = velocities->rows(d.beads(), d.axes());
  for (std::size_t k = 0; k < d.momenta.size(); ++k) d.momenta[k] = d.masses[k / d.axes()] * d.momenta[k];
}
}  // namespace

BeadRodDescription read_bead_rod_model(const std::string& path) {
  const DocumentNode document = read_document(path);
  const ModelEntry whole(document, path);
  ModelTable root(whole, path + ": ");
  BeadRodDescription d;
  d.origin = path;
  const ModelEntry dimension = root.required("dimension");
  d.dimension = dimension.integer();
  if (d.dimension != 2 && d.dimension != 3) dimension.refuse("2 or 3");
  d.masses = root.required("masses").numbers();
  const std::size_t beads = d.beads();
  if (const auto friction = root.find("friction")) d.friction = friction->numbers(beads);
  if (const auto charges = root.find("charges")) d.charges = charges->numbers(beads);
  if (const auto gravity = root.find("gravity")) {
    if (gravity->is(Kind::list)) {
      d.gravity = gravity->numbers(d.axes());
    } else {
      d.gravity.assign(d.axes(), Real(0));
      d.gravity.back() = -gravity->number();
    }
  }
  if (const auto anchors = root.find("anchors")) {
    if (!anchors->is(Kind::table)) anchors->refuse("a table of named points");
    for (const auto& [name, node] : anchors->node().members)
      d.anchors.push_back({name, ModelEntry(node, anchors->where() + "." + name).numbers(d.axes())});
  }
  d.positions = root.required("positions").rows(beads, d.axes());
  read_motion(d, root);
  read_rods(d, root);
  if (const auto potentials = root.find("potentials"))
    for (const ModelEntry& entry : potentials->items()) read_potential(d, entry);
  root.finish();
  d.check();
  return d;
}

}  // namespace pfaff
