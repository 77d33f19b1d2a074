// Su & Qin, section 3, (34)-(55): the transformation alpha, the fractional transformation, Theorems 3.1
// and 3.2 and Proposition 3.2, on steps of registered methods for the damped pendulum with the alpha of (95).
#include <cmath>

#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/integrators/generating_expansion.hpp>
#include <pfaff/integrators/lagrangian_transformation.hpp>

namespace pfaff::su_qin {

namespace {

// (95), w^ = (R^, P^), w = (R, P), z = (r, p); w^ multiplied by `factor`.
struct PapersAlpha {
  int factor = 1;
  template <class T>
  void alpha(const T& t, const T& t_old, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const Real rate = Real::fraction(3, 10);
    const T e = exp(rate * t), e0 = exp(rate * t_old);
    w_hat[0] = factor * (e * new_z[1] - e0 * old_z[1]);
    w_hat[1] = factor * (new_z[0] - old_z[0]);
    w[0] = (new_z[0] + old_z[0]) / 2;
    w[1] = -(e * new_z[1] + e0 * old_z[1]) / 2;
  }
};

const Numbers old_state{Quad(0.8), Quad(-0.4)};

class Section {
 public:
  std::vector<ReproducedRow> rows() {
    transformations();
    conditions();
    theorems();
    propositions();
    return rows_.take();
  }

 private:
  Rows rows_{"3"};
  std::shared_ptr<const Model> model_ = damped("damped-pendulum");
  LagrangianTransformation<Quad> alpha_{shared(record_alpha(PapersAlpha{}, 2))};
  StepJacobian<Quad> step_ = scheme(old_state);
  Matrix<Quad> m_{2, step_.jacobian};
  Matrix<Quad> k_ = structure(*model_, t1, step_.z), k0_ = structure(*model_, t0, old_state);
  FractionalTransformation<Quad> blocks_ = alpha_.blocks(t1, t0, step_.z, old_state);
  FractionalTransformation<Quad> inverse_ = blocks_.inverse_blocks(k_, k0_);
  Matrix<Quad> n_ = blocks_(m_);

  [[nodiscard]] StepJacobian<Quad> scheme(const Numbers& z) const {
    return step_of("generating-function", {{"order", "4"}, {"variant", "P"}}, model_, z);
  }
  // f(w) = sum_k tau^k phi_w^(k)(w), (P^, R^) of (95) being minus those of the chart's alpha: w = (R, P) is
  // the chart's (R, -P), and so is w^ = (R^, P^) its (R^, -P^).
  [[nodiscard]] Numbers f(const Numbers& w) const {
    Numbers sum(2);
    Quad power(1);
    for (int k = 1; k <= 4; ++k) {
      power *= tau;
      const Numbers term = engine_term(*model_, k, {w[0], -w[1]});
      sum[0] += power * term[0];
      sum[1] -= power * term[1];
    }
    return sum;
  }
  static double asymmetry(const Matrix<Quad>& n) { return distance(n.entries(), n.transposed().entries()); }

  void transformations() {
    const std::vector<StatePair<Quad>> points{{t1, t0, step_.z, old_state}};
    const auto pulled = [](const Matrix<Quad>& middle, const FractionalTransformation<Quad>& alpha) {
      return pulled_back(middle, alpha.jacobian()).entries();
    };
    const Matrix<Quad> j4 = canonical_structure<Quad>(2), j2 = canonical_structure<Quad>(1);
    const Numbers pairs = pair_structure(k_, k0_).entries();
    rows_.reproduced("(34)", "alpha_*^T J alpha_* of (95)", pairs, pulled(j4, blocks_));
    rows_.erratum("(35)", "the middle matrix", pulled(pair_structure(j2, j2), blocks_), pulled(j4, blocks_),
                  pairs, "(35): the middle matrix is J_4n");
    // Not "only if": 3 w^ breaks (34) and still gives symmetric N.
    const auto scaled = shared(record_alpha(PapersAlpha{3}, 2));
    const auto check = check_lagrangian<Quad>(scaled, model_->tape(Formula::structure), points);
    const auto blocks = LagrangianTransformation<Quad>(scaled).blocks(t1, t0, step_.z, old_state);
    rows_.claim("(34)", "\"if and only if\"", "only alpha_*^T J alpha_* = K~",
                "holds with " + to_string(Quad(check.factor), 2) + " K~, N - N^T " +
                    to_string(Quad(asymmetry(blocks(m_))), 2),
                distance(pulled(j4, blocks), pairs),
                !check.holds && std::abs(check.factor - 3) < 1e-12 && asymmetry(blocks(m_)) <= at_round_off,
                "(34): c K~ with a constant c serves too");
    rows_.reproduced("(33)", "alpha_* times its inverse's blocks", Matrix<Quad>::identity(4).entries(),
                     (blocks_.jacobian() * inverse_.jacobian()).entries());
  }

  // One vanishes where another does because they are one number.
  void conditions() {
    const auto [first, second, third, fourth] = transversality(blocks_, inverse_, m_, n_);
    const Quad whole = determinant(blocks_.jacobian());
    rows_.reproduced("(38)", "four conditions, one number", {first, first, first},
                     {whole * second, Quad(1) / third, whole / fourth});
    // In the chart minus the identity: w is not a coordinate of its graph, and none of the others is either.
    const Matrix<Quad> e(2, Numbers{Quad(-1), Quad(0), Quad(0), -exp(-(nu * tau))});
    rows_.reproduced("(38)", "and they vanish together", Numbers(2),
                     {determinant(blocks_.denominator(e)), determinant(e * inverse_.c - inverse_.a)});
  }

  void theorems() {
    rows_.reproduced("(42)", "N = sigma(M) is symmetric", n_.entries(), n_.transposed().entries());
    rows_.reproduced("(43)", "M = sigma^-1(N)", m_.entries(), inverse_(n_).entries());
    const auto other = step_of("rk4", {}, model_, old_state);
    const Matrix<Quad> image = alpha_.blocks(t1, t0, other.z, old_state)(Matrix<Quad>(2, other.jacobian));
    rows_.qualitative("(42)", "and not for RK4", "N not symmetric", to_string(Quad(asymmetry(image)), 3),
                      asymmetry(image), 1e-10, asymmetry(image) > 1e-10,
                      "N - N^T of an RK4 step exceeds 1e-10");
    // (50) for any M: X^T Y - Y^T X = M^T K M - K0.
    const Matrix<Quad> any(2, Numbers{Quad(0.9), Quad(0.3), Quad(-0.2), Quad(1.1)});
    const Matrix<Quad> x = blocks_.a * any + blocks_.b, y = blocks_.denominator(any);
    rows_.reproduced("(49)", "X^T Y - Y^T X = M^T K M - K0, any M", (pulled_back(k_, any) - k0_).entries(),
                     (x.transposed() * y - y.transposed() * x).entries());
    // Theorem 3.2: any symmetric N gives a K-symplectic M.
    const Matrix<Quad> symmetric(2, Numbers{Quad(0.1), Quad(-0.3), Quad(-0.3), Quad(0.2)});
    rows_.reproduced("(54)", "M of a symmetric N is K-symplectic", k0_.entries(),
                     pulled_back(k_, inverse_(symmetric)).entries());
  }

  void propositions() {
    // (55): w^ = f(w) on the step.
    const Numbers pair = alpha_(t1, t0, step_.z, old_state), w = part(pair, 2, 2);
    const Numbers gradient = f(w);
    rows_.reproduced("(41)", "w^ = phi_w(w) on a step", gradient, part(pair, 0, 2));
    rows_.qualitative("(55)", "arguments of f", "f(alpha_2, z, t, t0)", "f(alpha_2, t, t0)",
                      distance(gradient, part(pair, 0, 2)), at_round_off,
                      distance(gradient, part(pair, 0, 2)) <= at_round_off, "(55): f has no argument z");
    // (52): from any w the states alpha^-1(f(w), w) are one step apart; alpha^-1 as in (97).
    const Numbers at{Quad(0.5), Quad(0.3)}, image = f(at);
    const Quad half = Quad(1) / Quad(2), e = exp(nu * t1), e0 = exp(nu * t0);
    const Numbers after{at[0] + half * image[1], (half * image[0] - at[1]) / e};
    const Numbers before{at[0] - half * image[1], -(half * image[0] + at[1]) / e0};
    rows_.reproduced("(52)", "alpha^1(f(w), w) = g(alpha^2(f(w), w))", after, scheme(before).z);
  }
};

}  // namespace

std::vector<ReproducedRow> generating_functions() { return Section().rows(); }

}  // namespace pfaff::su_qin
