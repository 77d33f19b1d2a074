// The part of an evaluation that is about systems K zdot + D = 0.
#include <pfaff/bench/evaluation/evaluation_parts.hpp>
#include <pfaff/brackets/birkhoffian/birkhoffian_form.hpp>

namespace pfaff::evaluation_parts {

namespace {
// The residual relative to the size of its terms; 0 where all terms are 0.
template <class T>
json relative(const Residual<T>& r) {
  return number(r.scale == T(0) ? r.residual : T(r.residual / r.scale));
}
}  // namespace

template <class T>
void add_birkhoffian(Point<T>& at, std::optional<std::vector<Real>> centre, json& j) {
  const Model& model = *at.model;
  const BirkhoffianForm<T> form = birkhoffian_form<T>(model, centre, at.t, at.z);
  at.regular = form.degeneracy.regular;
  j["K"] = rows(form.structure);
  j["F_t"] = list(at.seen(form.one_form_rate));
  j["D"] = list(at.seen(form.covector));
  j["F"] = list(at.seen(form.one_form));
  j["B"] = number(at.seen({form.birkhoffian}).front());
  j["regular"] = at.regular;
  j["condition"] = number(form.degeneracy.condition);
  j["kernel"] = json::array();
  for (const auto& direction : form.degeneracy.kernel) j["kernel"].push_back(list(direction));
  j["class"] = to_string(birkhoffian_class(model));
  j["self_adjoint"] = {{"skew", relative(form.self_adjoint.skew)},
                       {"closed", relative(form.self_adjoint.closed)},
                       {"time", relative(form.self_adjoint.time)}};
  j["centre"] = centre ? list(numbers<T>(*centre)) : json(nullptr);
  at.seen(form.structure.entries());
}

template void add_birkhoffian(Point<double>&, std::optional<std::vector<Real>>, json&);
template void add_birkhoffian(Point<Quad>&, std::optional<std::vector<Real>>, json&);

}  // namespace pfaff::evaluation_parts
