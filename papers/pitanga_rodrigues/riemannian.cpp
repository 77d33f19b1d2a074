// Pitanga & Rodrigues, section 2: projectors on a Riemannian manifold. Exact in rationals.
#include <pfaff/brackets/almost_product/tensor_split.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/projectors.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using RiemannianTable = printed::Table<Rational>;
using List = std::vector<Rational>;

constexpr std::size_t dimension = 5, forms = 2, free_coordinates = dimension - forms;

double size_of(const Rational& x) { return static_cast<double>(abs(x)); }
template <class From, class To>
double size_of(const LinearMap<Rational, From, To>& m) {
  return static_cast<double>(largest(m.matrix()));
}

// A metric of five dimensions and two one-forms in general position. The tables hold the same numbers for
// what is printed.
struct RiemannianSample {
  ExactSamples samples{26};
  ExactMatrix g = [this] {
    const ExactMatrix b = samples.any(dimension, dimension);
    return b * b.transposed() + ExactMatrix::identity(dimension);
  }();
  ExactMatrix gamma = samples.any(forms, free_coordinates);
  List phi = samples.any(1, dimension).entries(), psi = samples.any(1, dimension).entries(),
       z = samples.any(1, dimension).entries();

  Metric<Rational> metric{g};
  std::vector<Covector<Rational>> one_forms = one_forms_of(gamma);
  AlmostProduct<Rational> straight = orthogonal(metric.sharp(), one_forms), slanted = oblique(one_forms);

  RiemannianTable g_table = table_of(g), gamma_table = table_of(gamma), w = printed::forms(gamma_table),
                  inverse_table = printed::inverse(g_table);
  /// (8) with the inverse of G^{alpha beta}; the transposes act on covectors.
  RiemannianTable q_table = printed::metric_q(inverse_table, w,
                                              printed::inverse(printed::upper_g(inverse_table, w))),
                  q_star = printed::transposed(q_table);
};

void splitting_of_the_metric(Rows& rows, const RiemannianSample& s) {
  const auto& sharp = s.metric.sharp();
  const Covector<Rational> phi(s.phi), psi(s.psi);
  const auto q = s.straight.complement().transposed(), p = s.straight.admissible().transposed();
  const auto printed_value = [&](const List& a, const List& b) {
    return printed::on_covectors(s.inverse_table, a, b);
  };
  const auto ours = [&](const Covector<Rational>& a, const Covector<Rational>& b) {
    return pairing(a, sharp * b);
  };
  const List q_phi = printed::product(s.q_star, s.phi), q_psi = printed::product(s.q_star, s.psi);

  rows.reproduced("(1)", "g(Q* phi, psi) = g(phi, Q* psi)", quads(List{printed_value(q_phi, s.psi)}),
                  quads(List{ours(phi, q * psi)}));
  rows.reproduced("(2)", "g(Q* phi, psi) = g(Q* phi, Q* psi)", quads(List{printed_value(q_phi, s.psi)}),
                  quads(List{ours(q * phi, q * psi)}));
  rows.reproduced("(3)", "g(P* phi, P* psi), the last line",
                  quads(List{printed_value(s.phi, s.psi) - printed_value(q_phi, q_psi)}),
                  quads(List{ours(p * phi, p * psi)}));
  const auto parts = split(sharp, s.straight);
  rows.reproduced("(4)", "g = g_P + g_Q, before it", quads(s.inverse_table),
                  quads((parts.admissible + parts.complement).matrix()));
  rows.reproduced("(4)", "sharp phi = sharp_Q phi + sharp_P phi",
                  quads(printed::product(s.inverse_table, s.phi)),
                  quads((s.straight.complement() * (sharp * phi) + sharp * (p * phi)).components()));
  const auto reflection = s.straight.reflection().transposed();
  rows.reproduced("(4)", "Gamma* keeps g, before it", quads(List{printed_value(s.phi, s.psi)}),
                  quads(List{ours(reflection * phi, reflection * psi)}));

  const auto oblique_q = s.slanted.complement().transposed(), oblique_p = s.slanted.admissible().transposed();
  // Q*(phi) in the place of Q*(psi) changes nothing where the projectors are orthogonal, as P* phi is
  // orthogonal to both.
  const auto first_line = [&](const CovectorOperator<Rational>& one,
                              const CovectorOperator<Rational>& other) {
    return ours(one * phi, psi - other * phi) - ours(one * phi, one * psi);
  };
  rows.qualitative(
      "(3)", "the first line", {"psi - Q*(phi)", "psi - Q*(psi)"},
      {at_most(size_of(first_line(p, q)), 0), at_least(size_of(first_line(oblique_p, oblique_q)), clearly),
       at_most(size_of(ours(oblique_p * phi, psi - oblique_q * psi) - ours(oblique_p * phi, oblique_p * psi)),
               0)},
      "(3): psi - Q*(psi) in the second argument; notation, of no effect on orthogonal projectors");
  rows.claim("(1)-(4)", "for every almost-product structure", {"yes", "no: for orthogonal projectors"},
             {at_least(size_of(ours(oblique_q * phi, psi) - ours(phi, oblique_q * psi)), clearly),
              at_least(size_of(ours(oblique_q * phi, psi) - ours(oblique_q * phi, oblique_q * psi)), clearly),
              at_least(size_of(ours(oblique_p * phi, oblique_p * psi) - ours(phi, psi) +
                               ours(oblique_q * phi, oblique_q * psi)),
                       clearly),
              at_least(size_of(split(sharp, s.slanted).mixed), clearly), at_most(size_of(parts.mixed), 0)},
             "(1)-(4): the projectors must be orthogonal in the metric; an oblique structure breaks each");
}

// Remark 1: with a bivector or a two-form in place of the metric, and their own complement.
void other_tensors(Rows& rows) {
  ExactSamples samples{27};
  const ExactMatrix skew = samples.skew(6);
  const ContravariantTensor<Rational> bivector(skew);
  const CovariantTensor<Rational> form(inverse(skew));
  const auto one_forms = covectors_in_rows(samples.any(2, 6));
  const AlmostProduct<Rational> own(one_forms, raised(bivector, one_forms));
  const auto two = split(bivector, own);
  const auto one = split(form, own);
  rows.reproduced("Remark 1", "Pi = Pi_P + Pi_Q", quads(table_of(skew)),
                  quads((two.admissible + two.complement).matrix()));
  rows.reproduced("Remark 1", "Omega = Omega_P + Omega_Q", quads(printed::inverse(table_of(skew))),
                  quads((one.admissible + one.complement).matrix()));
  const AlmostProduct<Rational> other = oblique(one_forms);
  rows.qualitative("Remark 1", "its compatibility is needed", {"if Gamma is compatible", "yes"},
                   {at_least(size_of(split(bivector, other).mixed), clearly), at_most(size_of(two.mixed), 0),
                    at_least(size_of(split(form, other).mixed), clearly), at_most(size_of(one.mixed), 0)},
                   "a mixed part is left along other structures, and none along the compatible one");
}

void eigenspaces(Rows& rows, const RiemannianSample& s) {
  const auto reflection = s.slanted.reflection();
  double worst = 0;
  for (const auto& y : s.slanted.fields()) {
    const auto sum = reflection * y + y;
    for (const Rational& x : sum.components()) worst = std::max(worst, size_of(x));
  }
  rows.qualitative(
      "Gamma", "P and Q change their roles", {"D is the eigenvalue 1, -1", "1, P onto D"},
      {at_most(worst, 0), at_most(size_of(reflection * s.slanted.admissible() - s.slanted.admissible()), 0)},
      "Sections 1, 2.1, 4: here P is onto the admissible vectors throughout, and Gamma = P - Q");
}

void local_expressions(Rows& rows, const RiemannianSample& s) {
  const auto p = s.slanted.admissible(), q = s.slanted.complement();
  const TangentVector<Rational> z(s.z);
  rows.reproduced("(5)", "P(Z)", quads(printed::splitting_p(s.gamma_table, s.z)),
                  quads((p * z).components()));
  rows.reproduced("(5)", "Q(Z)", quads(printed::splitting_q(s.gamma_table, s.z)),
                  quads((q * z).components()));
  rows.reproduced("(6)", "P", quads(printed::matrix_p(s.gamma_table)), quads(p.matrix()));
  rows.reproduced("(6)", "Q", quads(printed::matrix_q(s.gamma_table)), quads(q.matrix()));

  std::vector<TangentVector<Rational>> x;
  std::vector<Covector<Rational>> dz;
  for (std::size_t a = 0; a < free_coordinates; ++a) {
    x.push_back(p * coordinate_element<Rational, Vectors>(dimension, a));
    dz.push_back(coordinate_element<Rational, Covectors>(dimension, a));
  }
  const auto printed_part = printed::metric_coefficients(s.g_table, s.gamma_table);
  const auto symmetrised = [](const RiemannianTable& m) {
    return printed::sum(printed::sum(m, printed::transposed(m)),
                        printed::zero_table<Rational>(m.size(), m.size()), Rational(1) / Rational(2));
  };
  const auto halved = [](const RiemannianTable& m) {
    return printed::sum(m, printed::zero_table<Rational>(m.size(), m.front().size()),
                        Rational(1) / Rational(2));
  };
  const auto& fields = s.slanted.fields();
  rows.erratum("(7)", "the coefficients of dz^a (x) dz^b", quads(printed_part.free),
               quads(symmetrised(printed_part.free)), quads(gram(s.metric.flat(), x, x)),
               "(7): symmetric in a and b, (F_ab + F_ba)/2");
  rows.erratum("(7)", "the coefficients of dz^a (x) w^alpha", quads(printed_part.mixed),
               quads(halved(printed_part.mixed)), quads(gram(s.metric.flat(), x, fields)),
               "(7): g_{a al} - g_{al be} Gamma^be_a of each of dz^a (x) w^al and w^al (x) dz^a");
  rows.reproduced("(7)", "the coefficients of w^alpha (x) w^beta", quads(printed_part.constrained),
                  quads(gram(s.metric.flat(), fields, fields)));
  // As a quadratic form (7) is right, twice over in its mixed part: its value on one vector.
  const auto on_one = [&](const RiemannianTable& f, const RiemannianTable& m, const RiemannianTable& last,
                          const List& v) {
    const List first(v.begin(), v.begin() + free_coordinates), w = printed::product(s.w, v);
    Rational sum(0);
    for (std::size_t a = 0; a < first.size(); ++a) {
      for (std::size_t b = 0; b < first.size(); ++b) sum = sum + f[a][b] * first[a] * first[b];
      for (std::size_t k = 0; k < w.size(); ++k) sum = sum + m[a][k] * first[a] * w[k];
    }
    for (std::size_t k = 0; k < w.size(); ++k)
      for (std::size_t l = 0; l < w.size(); ++l) sum = sum + last[k][l] * w[k] * w[l];
    return sum;
  };
  rows.reproduced("(7)", "g(Z, Z)",
                  quads(List{on_one(printed_part.free, printed_part.mixed, printed_part.constrained, s.z)}),
                  quads(List{value_on(s.metric.flat(), z, z)}));

  const auto upper = printed::inverse_coefficients(s.inverse_table, s.gamma_table);
  const auto& sharp = s.metric.sharp();
  rows.reproduced("(7)", "after it, the coefficients of X_a (x) X_b", quads(upper.free),
                  quads(gram(sharp, dz, dz)));
  rows.erratum("(7)", "after it, the coefficients of X_a (x) Y_alpha", quads(upper.mixed),
               quads(halved(upper.mixed)), quads(gram(sharp, dz, s.one_forms)),
               "(7), after it: g^{a al} + g^{ab} Gamma^al_b of each of X_a (x) Y_al and Y_al (x) X_a");
  rows.erratum("(7)", "after it, the coefficients of Y_alpha (x) Y_beta", quads(upper.constrained),
               quads(symmetrised(upper.constrained)), quads(gram(sharp, s.one_forms, s.one_forms)),
               "(7), after it: symmetric in al and be");
}

void metric_projectors(Rows& rows, const RiemannianSample& s) {
  const RiemannianTable upper = printed::upper_g(s.inverse_table, s.w);
  rows.reproduced("(8)", "before it, G^{alpha beta} = w^beta(xi^alpha)", quads(upper),
                  quads(gram(s.metric.sharp(), s.one_forms, s.one_forms)));
  rows.erratum("(7), (8)", "G_{alpha beta} is two matrices",
               quads(printed::metric_q(s.inverse_table, s.w,
                                       printed::metric_coefficients(s.g_table, s.gamma_table).constrained)),
               quads(s.q_table), quads(s.straight.complement().matrix()),
               "(7), (8): in (8) G_{al be} is the inverse of G^{al be}, not the g_{al be} of (7)");
  rows.reproduced("(8), (9)", "q", quads(s.q_table), quads(s.straight.complement().matrix()));
  rows.reproduced("(9)", "q q = q, after it", quads(printed::product(s.q_table, s.q_table)),
                  quads(s.straight.complement().matrix()));
  // Gamma with g_{a al} = g_{al be} Gamma^be_a.
  const RiemannianTable fitting =
      printed::product(printed::inverse(printed::kinds(s.g_table, free_coordinates, 1, 1)),
                       printed::kinds(s.g_table, free_coordinates, 1, 0));
  const auto one_forms = one_forms_of(matrix_of(fitting));
  const auto own = orthogonal(s.metric.sharp(), one_forms);
  rows.reproduced("(10)", "q = Q where D is orthogonal to its complement", quads(printed::matrix_q(fitting)),
                  quads(own.complement().matrix()));
  rows.qualitative("(10)", "and nowhere else", {"g_{a al} - g_{al be} Gamma^be_a = 0", "its condition"},
                   {at_least(size_of(s.straight.complement() - s.slanted.complement()), clearly),
                    at_least(size_of(split(s.metric.flat(), s.slanted).mixed), clearly),
                    at_most(size_of(split(s.metric.flat(), oblique(one_forms)).mixed), 0)},
                   "q and Q differ where the mixed block of the metric does not vanish");
}

}  // namespace

void riemannian_rows(Rows& rows) {
  const RiemannianSample sample;
  eigenspaces(rows, sample);
  splitting_of_the_metric(rows, sample);
  other_tensors(rows);
  local_expressions(rows, sample);
  metric_projectors(rows, sample);
}

}  // namespace pfaff::pitanga_rodrigues
