// Simpler recipes, for shrinking a system on which a claim fails.
#include <algorithm>
#include <array>
#include <numeric>

#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace {

// The place of one term: part, polynomial in it, powers.
struct TermPlace {
  std::size_t part, polynomial;
  Powers powers;
};

std::vector<TermPlace> term_places(const Recipe& recipe) {
  std::vector<TermPlace> places;
  for (std::size_t i = 0; i < recipe.parts.size(); ++i)
    for (std::size_t k = 0; k < recipe.parts[i].size(); ++k)
      for (const auto& [powers, c] : recipe.parts[i][k].terms()) places.push_back({i, k, powers});
  return places;
}

Recipe with_term(const Recipe& recipe, const TermPlace& place, const Powers& powers, const Real& c) {
  Recipe changed = recipe;
  SparsePolynomial& p = changed.parts[place.part][place.polynomial];
  p.add(place.powers, -p.terms().at(place.powers));
  p.add(powers, c);
  return changed;
}

Recipe without_term(const Recipe& recipe, const TermPlace& place) {
  return with_term(recipe, place, place.powers, 0);
}

// The polynomial without one of its variables: terms that contain it are gone.
SparsePolynomial without_variable(const SparsePolynomial& p, std::size_t index) {
  SparsePolynomial rest(p.variables() - 1);
  for (const auto& [powers, c] : p.terms()) {
    if (powers[index] != 0) continue;
    Powers fewer = powers;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(index));
    rest.add(fewer, c);
  }
  return rest;
}

template <class T>
void erase_at(std::vector<T>& list, std::size_t k) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(k));
}

// Position k of d, and its momentum, left out. Polynomials are in d variables or in 2 d; those of a shear
// come one for each position.
Recipe without_position(const Recipe& recipe, std::size_t k) {
  Recipe less = recipe;
  const std::size_t d = recipe.dimension / 2;
  less.dimension -= 2;
  erase_at(less.state, d + k);
  erase_at(less.state, k);
  if (!less.masses.empty()) erase_at(less.masses, k);
  for (Polynomials& part : less.parts)
    for (SparsePolynomial& p : part) {
      if (p.variables() == 2 * d) p = without_variable(p, d + k);
      if (p.variables() >= d) p = without_variable(p, k);
    }
  if (recipe.kind == SystemKind::sheared_form)
    for (const std::size_t part : {std::size_t{2}, std::size_t{3}}) erase_at(less.parts[part], k);
  if (recipe.kind == SystemKind::rolling) erase_at(less.parts[1], k);
  return less;
}

Recipe without_bead(const Recipe& recipe, std::size_t bead) {
  Recipe less = recipe;
  const std::size_t beads = recipe.dimension / 4;
  for (const std::size_t k : {2 * beads + 2 * bead, 2 * bead}) {
    erase_at(less.state, k + 1);
    erase_at(less.state, k);
  }
  erase_at(less.masses, 2 * bead + 1);
  erase_at(less.masses, 2 * bead);
  less.parts = {{recipe.parts[0].front()}};
  less.dimension -= 4;
  std::erase_if(less.rods, [&](const auto& rod) { return rod.first == bead || rod.second == bead; });
  for (auto& [first, second] : less.rods)
    for (std::size_t* end : {&first, &second})
      if (*end > bead) --*end;
  return less;
}

// Function j of a part left out, with the terms that contain it.
void leave_out_function(Recipe& recipe, std::size_t part, std::size_t j) {
  for (SparsePolynomial& p : recipe.parts[part])
    p = without_variable(p, p.variables() - recipe.applied[part].size() + j);
  erase_at(recipe.applied[part], j);
}

// Position k and its momentum left out, with the functions of them.
Recipe without_position_and_functions(const Recipe& recipe, std::size_t k) {
  Recipe less = recipe;
  less.dimension -= 2;
  erase_at(less.state, recipe.dimension / 2 + k);
  erase_at(less.state, k);
  for (std::size_t part = 0; part < less.parts.size(); ++part) {
    for (std::size_t j = less.applied[part].size(); j-- > 0;)
      if (less.applied[part][j].variable == k) leave_out_function(less, part, j);
    for (SparsePolynomial& p : less.parts[part]) p = without_variable(p, k);
    for (AppliedFunction& f : less.applied[part])
      if (f.variable > k) --f.variable;
  }
  return less;
}

Recipe without_component(const Recipe& recipe, std::size_t k) {
  Recipe less = recipe;
  --less.dimension;
  erase_at(less.state, k);
  erase_at(less.parts[0], k);
  for (SparsePolynomial& p : less.parts[0]) p = without_variable(p, k);
  return less;
}

void leave_out_variables(std::vector<Recipe>& list, const Recipe& recipe) {
  const std::size_t n = recipe.dimension, d = n / 2;
  switch (recipe.kind) {
    case SystemKind::separable:
    case SystemKind::driven:
    case SystemKind::nonseparable:
    case SystemKind::damped:
    case SystemKind::sheared_form:
      for (std::size_t k = 0; k < d && d > 1; ++k) list.push_back(without_position(recipe, k));
      break;
    case SystemKind::surface:
      for (std::size_t k = 0; k < d && d > 2; ++k) list.push_back(without_position(recipe, k));
      for (std::size_t k = 0; k < recipe.parts[1].size() && recipe.parts[1].size() > 1; ++k) {
        list.push_back(recipe);
        erase_at(list.back().parts[1], k);
      }
      break;
    case SystemKind::rolling:
      for (std::size_t k = 0; k < d && d > 2; ++k) list.push_back(without_position(recipe, k));
      break;
    case SystemKind::second_class:  // its last position is the one that the constraints fix
      for (std::size_t k = 0; k + 1 < d && d > 2; ++k) list.push_back(without_position(recipe, k));
      break;
    case SystemKind::field:
      for (std::size_t k = 0; k < n && n > 1; ++k) list.push_back(without_component(recipe, k));
      break;
    case SystemKind::transcendental:
      for (std::size_t k = 0; k < d && d > 1; ++k) list.push_back(without_position_and_functions(recipe, k));
      for (std::size_t part = 0; part < recipe.applied.size(); ++part)
        for (std::size_t j = 0; j < recipe.applied[part].size(); ++j) {
          list.push_back(recipe);
          leave_out_function(list.back(), part, j);
        }
      break;
    case SystemKind::rods:
      for (std::size_t k = 0; k < n / 4 && n > 4; ++k)
        if (Recipe less = without_bead(recipe, k); !less.rods.empty()) list.push_back(std::move(less));
      for (std::size_t k = 0; k < recipe.rods.size() && recipe.rods.size() > 1; ++k) {
        list.push_back(recipe);
        erase_at(list.back().rods, k);
      }
      break;
    default:
      break;
  }
}

// Half of the terms, a quarter of them and so on, down to single ones.
void leave_out_terms(std::vector<Recipe>& list, const Recipe& recipe) {
  const auto places = term_places(recipe);
  for (std::size_t chunk = (places.size() + 1) / 2; chunk > 0; chunk /= 2)
    for (std::size_t begin = 0; begin < places.size(); begin += chunk) {
      Recipe less = recipe;
      for (std::size_t k = begin; k < std::min(begin + chunk, places.size()); ++k)
        less = without_term(less, places[k]);
      list.push_back(std::move(less));
    }
}

void lower_powers(std::vector<Recipe>& list, const Recipe& recipe) {
  for (const TermPlace& place : term_places(recipe)) {
    const auto& terms = recipe.parts[place.part][place.polynomial].terms();
    for (std::size_t k = 0; k < place.powers.size(); ++k) {
      if (place.powers[k] == 0) continue;
      Powers lower = place.powers;
      --lower[k];
      if (!terms.contains(lower)) list.push_back(with_term(recipe, place, lower, terms.at(place.powers)));
    }
  }
}

void simplify(std::vector<Recipe>& list, const Recipe& recipe, Real Recipe::*number,
              std::initializer_list<Real> values) {
  for (const Real& value : values) {
    list.push_back(recipe);
    list.back().*number = value;
  }
}

void simplify_numbers(std::vector<Recipe>& list, const Recipe& recipe) {
  for (const TermPlace& place : term_places(recipe))
    for (const Real& c : {Real(1), Real(-1), Real(2), Real::fraction(1, 2)})
      list.push_back(with_term(recipe, place, place.powers, c));
  for (std::size_t k = 0; k < recipe.state.size(); ++k)
    for (const Real& x : {Real(0), Real(1), Real(-1), Real(2), Real::fraction(1, 2)}) {
      list.push_back(recipe);
      list.back().state[k] = x;
    }
  if (!recipe.masses.empty()) {
    list.push_back(recipe);
    std::fill(list.back().masses.begin(), list.back().masses.end(), Real(1));
  }
  if (recipe.kind == SystemKind::damped || recipe.kind == SystemKind::metriplectic)
    simplify(list, recipe, &Recipe::rate, {1});
}

// How long a number is to write and to read: 0 is shortest, then 1, then by digits.
std::size_t length(const Real& x) { return x.is(0) ? 0 : x.is(1) ? 1 : 1 + to_string(x).size(); }

}  // namespace

std::array<std::size_t, 4> complexity(const Recipe& recipe) {
  // A constraint counts as one thing to be read, as a term does, and so does a function.
  std::array<std::size_t, 4> result{recipe.dimension, recipe.rods.size(), 0, 0};
  if (recipe.kind == SystemKind::surface) result[1] = recipe.parts[1].size();
  for (const auto& applied : recipe.applied) result[1] += applied.size();
  for (const Polynomials& part : recipe.parts)
    for (const SparsePolynomial& p : part)
      for (const auto& [powers, c] : p.terms()) {
        ++result[1];
        result[2] += static_cast<std::size_t>(std::accumulate(powers.begin(), powers.end(), 0));
        result[3] += length(c);
      }
  for (const auto* list : {&recipe.state, &recipe.masses})
    for (const Real& x : *list) result[3] += length(x);
  result[3] += length(recipe.rate);
  return result;
}

std::vector<Recipe> simpler(const Recipe& recipe) {
  std::vector<Recipe> all, list;
  leave_out_variables(all, recipe);
  leave_out_terms(all, recipe);
  lower_powers(all, recipe);
  simplify_numbers(all, recipe);
  const auto before = complexity(recipe);
  for (Recipe& r : all)
    if (complexity(r) < before) list.push_back(std::move(r));
  return list;
}

}  // namespace pfaff
