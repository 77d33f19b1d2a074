// Pitanga & Rodrigues 4.2 up to (38): a particle with the contact form w = dz - y dx.
#include <pfaff/brackets/almost_product/lie_bracket.hpp>
#include <pfaff/brackets/almost_product/tensor_split.hpp>
#include <pfaff/papers/pitanga_rodrigues/engine_point.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/contact.hpp>
#include <pfaff/papers/printed/projectors.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using Exact = printed::ContactFormulas<Rational>;

AlmostProduct<Rational> slanted_at(const Rational& y) {
  return oblique(one_forms_of(ExactMatrix(1, std::vector<Rational>{-y, Rational(0)})));
}

// Exact, with the unit metric.
void matrices(Rows& rows) {
  const Rational y = Rational(3) / Rational(5);
  const Exact formulas{y};
  const Metric<Rational> metric(ExactMatrix::identity(3));
  const auto slanted = slanted_at(y);
  const auto straight = orthogonal(metric.sharp(), slanted.one_forms());
  const auto e = [](std::size_t i) { return coordinate_element<Rational, Vectors>(3, i); };
  const std::vector<TangentVector<Rational>> frame{slanted.admissible() * e(0), slanted.admissible() * e(1),
                                                   slanted.fields()[0]};
  const std::vector<Covector<Rational>> coframe{coordinate_element<Rational, Covectors>(3, 0),
                                                coordinate_element<Rational, Covectors>(3, 1),
                                                slanted.one_forms()[0]};
  const std::string item = "contact form's matrices";
  rows.reproduced(item, "the metric in dx, dy, w", quads(formulas.metric()),
                  quads(gram(metric.flat(), frame, frame)));
  rows.reproduced(item, "its inverse in X_1, X_2, Y_3", quads(formulas.inverse_metric()),
                  quads(gram(metric.sharp(), coframe, coframe)));
  rows.reproduced(item, "G(w, w)", quads(std::vector<Rational>{formulas.g()}),
                  quads(gram(metric.sharp(), slanted.one_forms(), slanted.one_forms())));
  rows.reproduced(item, "xi", quads(formulas.xi()),
                  quads(raised(metric.sharp(), slanted.one_forms())[0].components()));
  rows.reproduced(item, "Q", quads(formulas.q()), quads(straight.complement().matrix()));
  rows.reproduced(item, "P", quads(formulas.p()), quads(straight.admissible().matrix()));
  rows.reproduced(item, "q of (6)", quads(formulas.small_q()), quads(slanted.complement().matrix()));
  rows.reproduced(
      item, "X_1 and X_2 are in the kernel of both",
      quads(printed::product(formulas.q(), printed::Table<Rational>{{formulas.x1()[0], formulas.x2()[0]},
                                                                    {formulas.x1()[1], formulas.x2()[1]},
                                                                    {formulas.x1()[2], formulas.x2()[2]}})),
      quads((straight.complement().matrix() * slanted.admissible().matrix()).block(0, 0, 3, 2)));
  rows.reproduced(item, "U", quads(formulas.u()), quads(conjugation(slanted, metric.sharp()).matrix()));
  rows.reproduced(item, "U q U^-1",
                  quads(printed::product(
                      formulas.u(), printed::product(formulas.small_q(), printed::inverse(formulas.u())))),
                  quads(straight.complement().matrix()));
  rows.erratum(item, "the expansion of Q", quads(formulas.expansion(2)), quads(formulas.expansion(0)),
               quads(straight.complement().matrix()), "contact form's matrices: y^2 dx (x) d/dx in Q");
  const TangentVector<Rational> xi = raised(metric.sharp(), slanted.one_forms())[0];
  const Rational square = value_on(metric.flat(), xi, xi);
  rows.erratum(
      item, "the norm of X^Q", quads(std::vector<Rational>{formulas.norm_of_xi() * formulas.norm_of_xi()}),
      quads(std::vector<Rational>{formulas.norm_of_xi()}), quads(std::vector<Rational>{square}),
      "contact form's matrices: 1 + y^2 is the square of the norm of X^Q, and Q has its inverse in front");
  rows.erratum("(7), (8)", "G_ww of the contact form", quads(std::vector<Rational>{formulas.metric()[2][2]}),
               quads(std::vector<Rational>{Rational(1) / formulas.d}),
               quads(inverse(gram(metric.sharp(), slanted.one_forms(), slanted.one_forms()))),
               "(7), (8): 1/(1 + y^2), not the 1 of (7)");
  rows.qualitative(
      item, "they are not orthogonal, before them", {"g_{a al} - g_{al be} Gamma^be_a != 0", "y"},
      {at_least(static_cast<double>(abs(value_on(metric.flat(), frame[0], frame[2]))), clearly),
       at_least(static_cast<double>(largest(split(metric.flat(), slanted).mixed.matrix())), clearly)},
      "the mixed block of the metric does not vanish");
}

// The fields X_1, X_2 and X^q as the projectors give them.
struct Field {
  std::size_t index;
  bool admissible;
  template <class S>
  [[nodiscard]] TangentVector<S> at(const std::vector<S>& z) const {
    const auto structure = oblique(one_forms_of(Matrix<S>(1, std::vector<S>{-z[1], S(0)})));
    const auto e = coordinate_element<S, Vectors>(3, index);
    return admissible ? structure.admissible() * e : structure.complement() * e;
  }
};
void heisenberg(Rows& rows) {
  const std::vector<Rational> z{Rational(1), Rational(-2) / Rational(7), Rational(4)};
  const Field x1{0, true}, x2{1, true}, xq{2, false};
  const auto formulas = Exact{z[1]};
  std::vector<Rational> opposite;
  for (const Rational& x : formulas.x_q()) opposite.push_back(-x);
  rows.erratum("Heisenberg algebra", "[X_1, X_2]", quads(formulas.x_q()), quads(opposite),
               quads(lie_bracket(x1, x2, z).components()), "Heisenberg algebra: [X_1, X_2] = -X^q");
  rows.reproduced("Heisenberg algebra", "[X_1, X^q]", zeros(3), quads(lie_bracket(x1, xq, z).components()));
  rows.reproduced("Heisenberg algebra", "[X_2, X^q]", zeros(3), quads(lie_bracket(x2, xq, z).components()));
}

void motion(Rows& rows) {
  const EnginePoint engine(contact_model(), Quad(0),
                           {Quad(1), Quad(3) / 5, Quad(-2), Quad(7) / 4, Quad(-1) / 3, Quad(2)});
  const printed::ContactFormulas<Quad> formulas{engine.q()[1]};
  const Numbers v{Quad(2), Quad(-1) / 3, Quad(5) / 7};
  const Numbers& a = engine.acceleration();
  Numbers off = engine.q();
  off.insert(off.end(), v.begin(), v.end());  // unit masses: momenta are velocities
  rows.reproduced("(36)", "f", {formulas.constraint(v)}, engine.constraints(off));
  rows.reproduced("(36)", "f = 0 on the constraint", {formulas.constraint(engine.velocity())}, zeros(1));
  rows.reproduced("(37)", "P z''", printed::product(formulas.p(), a), zeros(3));
  rows.reproduced("(38)", "x'' + y z'' and y''", formulas.momentum_equation(a), zeros(2));
  rows.reproduced("Bates-Sniatycki", "x'' + y x' y' / (1 + y^2) and y''",
                  formulas.bates_sniatycki(engine.velocity(), a), zeros(2));
  const double largest_acceleration = static_cast<double>(abs(a[0]));
  rows.qualitative("Bates-Sniatycki", "the particle is accelerated", {"-", shown(a)},
                   {at_least(largest_acceleration, clearly)},
                   "control: the rows of (37) and (38) do not compare zeros alone");
}

}  // namespace

void contact_rows(Rows& rows) {
  matrices(rows);
  heisenberg(rows);
  motion(rows);
}

}  // namespace pfaff::pitanga_rodrigues
