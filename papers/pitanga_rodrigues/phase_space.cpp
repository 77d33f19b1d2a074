// Pitanga & Rodrigues 4.2, (39) to (41): the pseudo-Poisson structure of nonholonomic systems.
#include <pfaff/core/system.hpp>
#include <pfaff/papers/pitanga_rodrigues/engine_point.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/contact.hpp>
#include <pfaff/papers/printed/projectors.hpp>
#include <pfaff/papers/printed/sleigh.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using D = Dual<Quad, 1>;

// The matrix P of a paper's formula and its slopes by the positions.
struct PrintedProjector {
  printed::Table<Quad> p;
  std::vector<printed::Table<Quad>> slopes;
};
// `at` gives the formula's P where the only position that it depends on, with this index, is a dual.
template <class F>
PrintedProjector differentiated(std::size_t index, F&& at) {
  const printed::Table<D> moving = at();
  PrintedProjector result{printed::zero_table<Quad>(3, 3),
                          std::vector<printed::Table<Quad>>(3, printed::zero_table<Quad>(3, 3))};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      result.p[i][j] = moving[i][j].value;
      result.slopes[index][i][j] = moving[i][j].derivative[0];
    }
  return result;
}
PrintedProjector of_contact(const Quad& y) {
  return differentiated(1, [&] { return printed::ContactFormulas<D>{D::variable(y, 0)}.p(); });
}
PrintedProjector of_sleigh(const Quad& theta) {
  return differentiated(2, [&] {
    const printed::SleighFormulas<D> formulas{D::variable(theta, 0), D(sleigh_inertia), D(sleigh_distance)};
    return printed::difference(printed::unit_table<D>(3), formulas.q());
  });
}

Numbers column(const Matrix<Quad>& m, std::size_t j) { return m.block(0, j, m.rows(), 1).entries(); }
double distance_of(const Matrix<Quad>& tensor, const EnginePoint& engine) {
  return distance(tensor * engine.energy_slopes(), engine.rate());
}

void contact_brackets(Rows& rows, const EnginePoint& engine) {
  const Quad px = engine.p()[0];
  const printed::ContactFormulas<Quad> formulas{engine.q()[1]};
  // Momenta that do not keep the constraint.
  const Numbers raw{px + Quad(1) / 3, Quad(2) / 7, Quad(-5) / 4};
  Numbers off = engine.q();
  off.insert(off.end(), raw.begin(), raw.end());
  const EnginePoint projected(contact_model(), Quad(0), off);
  rows.reproduced("(39)", "the momenta on the constraint", printed::product(formulas.p(), raw),
                  projected.p());
  rows.reproduced("(39)", "p_z = y p_x, after it", {formulas.y * projected.p()[0]}, {projected.p()[2]});

  const Matrix<Quad> tensor = engine.tensor();
  Numbers listed, ours;
  for (std::size_t j = 0; j < 5; ++j) {
    const Numbers printed_column = formulas.columns(px)[j], engine_column = column(tensor, j);
    listed.insert(listed.end(), printed_column.begin(), printed_column.end());
    ours.insert(ours.end(), engine_column.begin(), engine_column.end());
  }
  rows.reproduced("(40)", "its five columns", listed, ours);
  const double restored = distance(formulas.sixth_column(px), column(tensor, 5));
  rows.claim("(40)", "is a matrix of six columns", {"five", shown(column(tensor, 5))},
             {at_most(static_cast<double>(formulas.columns(px).size()), 5), at_most(restored, at_round_off),
              at_most(static_cast<double>(largest(tensor + tensor.transposed())), at_round_off)},
             "(40): the sixth column is (y/d, 0, y^2/d, 0, -p_x/d, 0), d = 1 + y^2, by which it is skew");
  const auto point = engine.point();
  const auto d = static_cast<double>(formulas.d);
  rows.qualitative("(40)", "Jacobi's identity",
                   {"may not hold", "fails by " + shown({point.jacobiator.value})},
                   {at_least(static_cast<double>(abs(point.jacobiator.value)), 1 / (d * d) - 1e-12),
                    at_most(static_cast<double>(abs(point.jacobiator.value)), 1 / (d * d) + 1e-12),
                    at_most(static_cast<double>(point.rank), 4), at_least(static_cast<double>(point.rank), 4),
                    at_most(point.casimirs, at_round_off)},
                   "the sum of (z, p_x, p_y) is -1/(1 + y^2)^2; the rank is 4, and p_z - y p_x is a Casimir");
  rows.qualitative("(40)", "its flow", {"-", "the motion of (38)"},
                   {at_most(distance_of(tensor, engine), at_round_off)},
                   "Pibar grad H is the motion of d'Alembert's principle");
}

void blocks(Rows& rows, const EnginePoint& contact, const EnginePoint& sleigh) {
  const PrintedProjector level = of_contact(contact.q()[1]), p = of_sleigh(sleigh.q()[2]);
  const auto level_d = printed::momentum_brackets(level.p, level.slopes, contact.p()),
             d = printed::momentum_brackets(p.p, p.slopes, sleigh.p());
  rows.reproduced("(41)", "D_ij of the contact form", printed::listed(level_d),
                  contact.tensor().block(3, 3, 3, 3).entries());
  rows.reproduced("(41)", "D_ij of the sleigh", printed::listed(d),
                  sleigh.tensor().block(3, 3, 3, 3).entries());
  const auto negated = [](const printed::Table<Quad>& m) {
    return printed::difference(printed::zero_table<Quad>(3, 3), m);
  };
  rows.erratum("(41)", "of the sleigh", printed::listed(printed::phase_space_tensor(p.p, negated(p.p), d)),
               printed::listed(printed::phase_space_tensor(p.p, negated(printed::transposed(p.p)), d)),
               sleigh.tensor().entries(), "(41): -P^T below P");
  rows.qualitative("(41)", "the bracket of the sleigh", {"a prototype", "its flow is the motion"},
                   {at_most(distance_of(sleigh.tensor(), sleigh), at_round_off)},
                   "Pibar grad H is the motion of d'Alembert's principle");
}

// The field of projectors of (6), for the contact form.
struct Slanted {
  template <class S>
  [[nodiscard]] MomentumProjector<S> at(const std::vector<S>& z) const {
    return {oblique(one_forms_of(Matrix<S>(1, std::vector<S>{-z[1], S(0)}))).admissible(), Covector<S>(3)};
  }
};
// x y - z = const in disguise.
struct Integrable {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] / 3) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[2];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = q[1];
    rows[1] = q[0];
    rows[2] = -T(1);
  }
};

void limits(Rows& rows, const EnginePoint& contact) {
  const Matrix<Quad> oblique_tensor =
      pseudo_poisson_tensor<Quad>(Slanted{}, contact.q(), Covector<Quad>(contact.p()));
  rows.claim(
      "(41)", "P is any of the projectors", {"the matrix-projector", "the orthogonal one"},
      {at_least(distance_of(oblique_tensor, contact), clearly),
       at_most(distance_of(contact.tensor(), contact), at_round_off)},
      "(41): P is the orthogonal projector; with the oblique one of (6) the rate of the momenta is wrong");
  const EnginePoint holonomic(
      make_model(SystemDescriptor{.name = "example", .title = "", .reference = ""}, Integrable{}), Quad(0),
      contact.state());
  const auto point = holonomic.point();
  rows.qualitative(
      "(41)", "a constraint that is integrable", {"P is singular, generally", "rank 4, and Poisson"},
      {at_most(static_cast<double>(abs(determinant(holonomic.projectors().admissible().matrix()))),
               at_round_off),
       at_most(static_cast<double>(abs(point.jacobiator.value)), at_round_off),
       at_most(static_cast<double>(point.rank), 4)},
      "there P is singular too, and Jacobi's identity holds");
}

}  // namespace

void phase_space_rows(Rows& rows) {
  const EnginePoint contact(contact_model(), Quad(0),
                            {Quad(1), Quad(3) / 5, Quad(-2), Quad(7) / 4, Quad(-1) / 3, Quad(2)}),
      sleigh(sleigh_model(), Quad(0),
             {Quad(1), Quad(-2), Quad(7) / 10, Quad(3) / 4, Quad(5) / 3, Quad(2) / 5});
  contact_brackets(rows, contact);
  blocks(rows, contact, sleigh);
  limits(rows, contact);
}

}  // namespace pfaff::pitanga_rodrigues
