// The part of an evaluation that is about constraints: their brackets W, the blocks S and A of W where the
// constraints are holonomic (nguyen-turski (4.1)), their classes, and the forces that keep them.
#include <pfaff/bench/evaluation/evaluation_parts.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff::evaluation_parts {

namespace {

std::vector<std::string> names_of(const std::vector<std::size_t>& members,
                                  const std::vector<std::string>& names) {
  std::vector<std::string> list;
  for (const std::size_t k : members) list.push_back(names[k]);
  return list;
}

// Why there is no Dirac bracket, in one line.
template <class T>
std::string why_singular(const Classification<T>& classes, const std::vector<std::string>& names) {
  std::string text = "the brackets W of the constraints have rank " + std::to_string(classes.rank()) +
                     " of " + std::to_string(names.size());
  if (names.size() % 2 != 0) text += ", as an odd number of them cannot all be second class";
  text += ": " + describe(classes, names);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;) text.replace(at, 1, "; ");
  return text;
}

// S_ij = {phi_i, phi~_j}, A_ij = {phi~_i, phi~_j}, S^D_ij = <phi~_i, phi~_j>.
template <class T>
void add_blocks(const Point<T>& at, const ConstraintBrackets<T>& brackets, json& j) {
  const std::size_t count = brackets.values.size() / 2, n = at.z.size() / 2;
  Matrix<T> s(count, count), a(count, count), friction(count, count);
  std::vector<T> lambda(n);
  const bool rubs = at.model->given(Formula::friction);
  if (rubs) lambda = at.values(at.model->tape(Formula::friction));
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < count; ++k) {
      s(i, k) = brackets.brackets(2 * i, 2 * k + 1);
      a(i, k) = brackets.brackets(2 * i + 1, 2 * k + 1);
      for (std::size_t c = 0; c < n; ++c)
        friction(i, k) = friction(i, k) + brackets.gradients(2 * i + 1, n + c) * lambda[c] *
                                              brackets.gradients(2 * k + 1, n + c);
    }
  j["S"] = rows(s);
  j["A"] = rows(a);
  j["S_D"] = rubs ? rows(friction) : json(nullptr);
}

// What the constraints at the level of velocities are called: holonomic ones, named phi and phi~ in turn, by
// phi~.
std::vector<std::string> velocity_names(const Model& model) {
  std::vector<std::string> names;
  for (const std::string& name : model.constraint_names()) {
    if (!names.empty() && name == names.back() + "~") names.pop_back();
    names.push_back(name);
  }
  return names;
}

// A, row by row, S = A H_pp A^T and its structure, of constraints at the level of velocities.
template <class T>
void add_velocity_constraints(Point<T>& at, json& j) {
  const auto constraints = at.model->template velocity_constraints<T>();
  const std::size_t n = constraints->degrees(), count = constraints->count();
  std::vector<Quad> state;
  for (const T& x : at.z) state.push_back(Quad(x));
  at.reason = dependent_velocity_constraints(*at.model, Quad(at.t), state);
  at.regular = at.reason.empty();
  j["structure"] = to_string(constraints->pattern().structure());
  if (count > most_dense) return;
  (void)constraints->linearise(at.t, In<T>(at.z).first(n), In<T>(at.z).subspan(n));  // told apart above
  Matrix<T> a(count, n), s(count, count);
  std::vector<T> unit(count), row(n), column(count);
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = T(1);
    constraints->apply_transpose(unit, row);
    unit[i] = T(0);
    constraints->by_momentum(row, column);
    for (std::size_t k = 0; k < n; ++k) a(i, k) = row[k];
    for (std::size_t k = 0; k < count; ++k) s(k, i) = column[k];
  }
  j["velocity_rows"] = rows(a);
  j["velocity_names"] = velocity_names(*at.model);
  j["S"] = rows(s);
}

}  // namespace

template <class T>
void add_constraints(Point<T>& at, json& j) {
  const Model& model = *at.model;
  const std::vector<std::string> names = model.constraint_names();
  j["constraint_names"] = names;
  if (model.holonomic()) {
    const auto constraints = model.holonomic_constraints<T>();
    const std::size_t n = constraints->degrees();
    const In<T> q = In<T>(at.z).first(n), p = In<T>(at.z).subspan(n);
    std::vector<T> values(constraints->count());
    constraints->values(at.t, q, values);
    j["constraints"] = list(at.seen(values));
    constraints->hidden_values(at.t, q, p, values);
    j["hidden_constraints"] = list(at.seen(values));
    j["structure"] = to_string(constraints->pattern().structure());
  } else {
    j["constraints"] = list(at.seen(at.values(model.tape(Formula::constraints))));
  }
  if (model.nonholonomic()) add_velocity_constraints(at, j);
  if (!model.constrained() || names.size() > most_dense) return;
  const ConstraintBrackets<T> brackets = constraint_brackets(model, at.t, at.z);
  at.finite = at.finite && brackets.finite;
  if (model.holonomic()) add_blocks(at, brackets, j);
  j["W"] = rows(brackets.brackets);
  j["rank"] = j["condition"] = j["first_class"] = j["redundant"] = nullptr;
  if (!brackets.finite) return;
  j["rank"] = brackets.classes.rank();
  if (brackets.classes.regular()) j["condition"] = number(brackets.classes.condition);
  j["first_class"] = names_of(brackets.classes.members(ConstraintClass::first), names);
  j["redundant"] = names_of(brackets.classes.members(ConstraintClass::redundant), names);
  if (brackets.classes.regular()) return;
  at.regular = false;
  at.reason = why_singular(brackets.classes, names);
}

template <class T>
void add_constrained_motion(Point<T>& at, const std::vector<T>& rate, json& j) {
  const Model& model = *at.model;
  if (model.holonomic()) {
    // S lambda = P (F - friction v - p').
    const auto constraints = model.holonomic_constraints<T>();
    const std::size_t n = constraints->degrees();
    const bool placed =
        constraints->place(at.t, In<T>(at.z).first(n), In<T>(at.z).subspan(n)) == Status::converged;
    std::string form = "none";
    for (const auto& [key, value] : model.source().formulation_parameters)
      if (key == "friction-form") form = value;
    std::vector<T> force(n), multipliers(constraints->count());
    const auto drag = constraints->friction();
    for (std::size_t k = 0; k < n; ++k) {
      force[k] = constraints->forces()[k] - rate[n + k];
      if (form != "none" && !drag.empty()) force[k] = force[k] - drag[k] * constraints->velocities()[k];
    }
    constraints->hidden_by_momentum(force, multipliers);
    constraints->solve(multipliers, multipliers);
    j["multipliers"] = placed ? list(multipliers) : json(nullptr);
  }
  if (model.nonholonomic()) {
    // S lambda = P (-H_q - p').
    const auto constraints = model.velocity_constraints<T>();
    const std::size_t n = constraints->degrees();
    const bool placed =
        constraints->place(at.t, In<T>(at.z).first(n), In<T>(at.z).subspan(n)) == Status::converged;
    std::vector<T> force(n), multipliers(constraints->count());
    for (std::size_t k = 0; k < n; ++k) force[k] = constraints->forces()[k] - rate[n + k];
    constraints->by_momentum(force, multipliers);
    constraints->solve(multipliers, multipliers);
    j["multipliers"] = placed ? list(multipliers) : json(nullptr);
    constraints->apply_transpose(multipliers, force);
    for (T& f : force) f = -f;
    j["constraint_forces"] = placed ? list(force) : json(nullptr);
  }
}

template void add_constraints(Point<double>&, json&);
template void add_constraints(Point<Quad>&, json&);
template void add_constrained_motion(Point<double>&, const std::vector<double>&, json&);
template void add_constrained_motion(Point<Quad>&, const std::vector<Quad>&, json&);

}  // namespace pfaff::evaluation_parts
