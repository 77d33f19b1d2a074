// Su & Qin, section 3, (30)-(55): the transformation alpha, the fractional transformation, Theorems 3.1
// and 3.2 and Proposition 3.2. What is printed is evaluated with the alpha of (95) and its Jacobians (96) and
// (98); ours are steps of registered methods, the engine's derivatives of alpha and its transformations.
#include <cmath>

#include <pfaff/integrators/generating/lagrangian_transformation.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/papers_alpha.hpp>
#include <pfaff/papers/su_qin/rows.hpp>

namespace pfaff::su_qin {

namespace {

const Numbers old_state{Quad(0.8), Quad(-0.4)};

class Section {
 public:
  explicit Section(Rows& rows) : rows_(rows) {}
  void add() {
    transformations();
    conditions();
    theorems();
    propositions();
  }

 private:
  Rows& rows_;
  // The pendulum's K is the oscillator's, and so is alpha.
  std::shared_ptr<const Model> model_ = damped("damped-pendulum");
  printed::Oscillator printed_{nu, t0, t1};
  printed::Blocks printed_blocks_ = printed::blocks_of(printed_.alpha_jacobian()),
                  printed_inverse_ = printed::blocks_of(printed_.alpha_inverse_jacobian());
  LagrangianTransformation<Quad> alpha_{shared(record_alpha(PapersAlpha{}, 2))};
  StepJacobian<Quad> step_ =
      step_of("generating-function", {{"order", "4"}, {"variant", "P"}, {"extra", "0"}}, model_, old_state);
  Matrix<Quad> m_{2, step_.jacobian};
  Matrix<Quad> k_ = structure(*model_, t1, step_.z), k0_ = structure(*model_, t0, old_state);
  FractionalTransformation<Quad> blocks_ = alpha_.blocks(t1, t0, step_.z, old_state);
  FractionalTransformation<Quad> inverse_ = blocks_.inverse_blocks(k_, k0_);
  Matrix<Quad> n_ = blocks_(m_);

  static printed::Table<Quad> table(const Matrix<Quad>& m) {
    return {{m(0, 0), m(0, 1)}, {m(1, 0), m(1, 1)}};
  }
  static double asymmetry(const Matrix<Quad>& n) { return distance(n.entries(), n.transposed().entries()); }

  void transformations() {
    const std::vector<StatePair<Quad>> points{{t1, t0, step_.z, old_state}};
    const auto pulled = [](const Matrix<Quad>& middle, const FractionalTransformation<Quad>& alpha) {
      return pulled_back(middle, alpha.jacobian()).entries();
    };
    const Matrix<Quad> j4 = canonical_structure<Quad>(2);
    const Numbers pairs = printed::listed(printed_.pair_structure());
    rows_.reproduced("(30), Definition 3.2", "a step is K-symplectic", printed::listed(printed_.k0()),
                     pulled_back(k_, m_).entries());
    rows_.reproduced("(34)", "alpha_*^T J alpha_* of (95)", pairs, pulled(j4, blocks_));
    // (35) says that diag(J, -J), pulled back with (96), is diag(K, -K0), which the engine's structures are.
    const printed::Table<Quad> middle{{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 1, 0}},
        corrected{{0, 0, 1, 0}, {0, 0, 0, 1}, {-1, 0, 0, 0}, {0, -1, 0, 0}};
    rows_.erratum("(35)", "the middle matrix",
                  printed::listed(printed::congruent(middle, printed_.alpha_jacobian())),
                  printed::listed(printed::congruent(corrected, printed_.alpha_jacobian())),
                  pair_structure(k_, k0_).entries(), "(35): the middle matrix is J_4n");
    // Not "only if": 3 w^ breaks (34) and still gives symmetric N.
    const auto scaled = shared(record_alpha(PapersAlpha{3}, 2));
    const auto check = check_lagrangian<Quad>(scaled, model_->tape(Formula::structure), points);
    const auto blocks = LagrangianTransformation<Quad>(scaled).blocks(t1, t0, step_.z, old_state);
    const double broken = distance(pulled(j4, blocks), pairs), left = asymmetry(blocks(m_));
    rows_.claim(
        "(34)", "\"if and only if\"",
        {"only alpha_*^T J alpha_* = K~", "with " + shown(check.factor) + " K~, N - N^T " + shown(left)},
        {at_least(broken, clearly), is_true(!check.holds), at_most(std::abs(check.factor - 3), 1e-12),
         at_most(left, at_round_off)},
        "(34): c K~ with a constant c serves too");
    rows_.reproduced("(33)", "alpha_* times its inverse's blocks",
                     printed::listed(printed::unit_table<Quad>(4)),
                     (blocks_.jacobian() * inverse_.jacobian()).entries());
  }

  // The four determinants of (38), by (96) and (98). They vanish together.
  void conditions() {
    const auto ours = transversality(blocks_, inverse_, m_, n_);
    const printed::Table<Quad> m = table(m_), n = printed::fractional(printed_blocks_, m);
    const auto of = [](const printed::Table<Quad>& x) { return printed::determinant(x); };
    rows_.reproduced("(37), (38), Proposition 3.1", "four determinants",
                     {of(printed::denominator(printed_blocks_, m)),
                      of(printed::difference(printed::product(m, printed_inverse_.c), printed_inverse_.a)),
                      of(printed::denominator(printed_inverse_, n)),
                      of(printed::difference(printed::product(n, printed_blocks_.c), printed_blocks_.a))},
                     {ours[0], ours[1], ours[2], ours[3]});
    // A map that is minus the identity in the chart: w is no coordinate on its graph, and the determinants
    // vanish.
    const Matrix<Quad> e(2, Numbers{Quad(-1), Quad(0), Quad(0), -exp(-(nu * tau))});
    rows_.reproduced("(38), Proposition 3.1", "and they vanish together", Numbers(2),
                     {determinant(blocks_.denominator(e)), determinant(e * inverse_.c - inverse_.a)});
  }

  void theorems() {
    const printed::Table<Quad> m = table(m_), n = printed::fractional(printed_blocks_, m);
    rows_.reproduced("(36), (42), Theorem 3.1", "N = sigma(M)", printed::listed(n), n_.entries());
    rows_.reproduced("(42), Theorem 3.1", "N is symmetric", {n[1][0], n[0][1]}, {n_(0, 1), n_(1, 0)});
    rows_.reproduced("(43)", "M from N", printed::listed(printed::fractional(printed_inverse_, table(n_))),
                     m_.entries());
    const auto other = step_of("rk4", {}, model_, old_state);
    const Matrix<Quad> image = alpha_.blocks(t1, t0, other.z, old_state)(Matrix<Quad>(2, other.jacobian));
    rows_.qualitative("(42)", "and not for RK4", {"N not symmetric", shown(asymmetry(image))},
                      {at_least(asymmetry(image), 1e-10)}, "N - N^T of an RK4 step exceeds 1e-10");
    // (49) before it is set to zero, (M^T, I) K~ (M, I), for any M; (50) for the step.
    const Matrix<Quad> any(2, Numbers{Quad(0.9), Quad(0.3), Quad(-0.2), Quad(1.1)});
    const auto skew_part = [this](const Matrix<Quad>& map) {
      const Matrix<Quad> x = blocks_.a * map + blocks_.b, y = blocks_.denominator(map);
      return (x.transposed() * y - y.transposed() * x).entries();
    };
    rows_.reproduced(
        "(49)", "X^T Y - Y^T X = M^T K M - K0, any M",
        printed::listed(printed::difference(printed::congruent(printed_.k(), table(any)), printed_.k0())),
        skew_part(any));
    rows_.reproduced("(50)", "X^T Y - Y^T X of a step", Numbers(4), skew_part(m_));
    // Theorem 3.2: any symmetric N gives a K-symplectic M.
    const Matrix<Quad> symmetric(2, Numbers{Quad(0.1), Quad(-0.3), Quad(-0.3), Quad(0.2)});
    rows_.reproduced("(54), Theorem 3.2", "M of a symmetric N is K-symplectic",
                     printed::listed(printed_.k0()), pulled_back(k_, inverse_(symmetric)).entries());
    rows_.reproduced("(54)", "M of a symmetric N",
                     printed::listed(printed::fractional(printed_inverse_, table(symmetric))),
                     inverse_(symmetric).entries());
  }

  // The gradient map f of the oscillator's second-order scheme, (100) and (104), and the map g that it makes.
  void propositions() {
    const auto oscillator = damped("damped-oscillator");
    const auto g = [&](const Numbers& z) {
      return step_of("generating-function", {{"order", "2"}, {"variant", "P"}, {"extra", "0"}}, oscillator, z)
          .z;
    };
    const Numbers after = g(old_state), pair = alpha_(t1, t0, after, old_state);
    rows_.reproduced("(41)", "alpha_1(g(z), z) = f(alpha_2(g(z), z))",
                     printed_.gradient(2, part(printed_.alpha(after, old_state), 2, 2)), part(pair, 0, 2));
    // (55) is the same equation solved for g.
    const Numbers solved = printed_.step(2, {Quad(-0.3), Quad(0.9)}), ours = g({Quad(-0.3), Quad(0.9)});
    rows_.qualitative("(55)", "arguments of f", {"f(alpha_2, z, t, t0)", "f(alpha_2, t, t0)"},
                      {at_most(distance(solved, ours), at_round_off)},
                      "(55): f has no argument z; solved for g it gives the scheme");
    // (52): from any w the states alpha^-1(f(w), w) are one step apart.
    const Numbers at{Quad(0.5), Quad(0.3)},
        states = printed_.alpha_inverse(joined(printed_.gradient(2, at), at), printed::Form::corrected);
    rows_.reproduced("(52), Proposition 3.2", "alpha^1(f(w), w) = g(alpha^2(f(w), w))", part(states, 0, 2),
                     g(part(states, 2, 2)));
  }
};

}  // namespace

void generating_functions(Rows& rows) { Section(rows).add(); }

}  // namespace pfaff::su_qin
