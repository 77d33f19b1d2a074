// Su & Qin, section 5, (92)-(99): the damped oscillator r'' + nu r' + r = 0 in Birkhoff's form, and alpha.
//
// Alpha is that of the registered damped pendulum, whose K is the oscillator's. The plug-in writes (95)
// followed by w -> w + grad g(w^), g = R^ P^^2/2, and the printed side adds this gradient. Where w^ = 0 its
// derivatives vanish, and the Jacobians there are (96) and (98).
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/generating/lagrangian_transformation.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/rows.hpp>

namespace pfaff::su_qin {

namespace {

class OscillatorForm {
 public:
  explicit OscillatorForm(Rows& rows) : rows_(rows) {}
  void add() {
    birkhoffian_form();
    alpha();
    derivatives();
  }

 private:
  Rows& rows_;
  printed::Oscillator printed_{nu, t0, t1};
  std::shared_ptr<const Model> model_ = damped("damped-oscillator");
  LagrangianTransformation<Quad> alpha_{damped("damped-pendulum")->tape(Formula::alpha)};

  // The equations of motion, K, its inverse, F and B of the plug-in.
  void birkhoffian_form() {
    const Numbers z{Quad(0.4), Quad(-0.7)};
    const Problem<Quad> problem(model_);
    Numbers k(4), pi(4), f(2), written(2);
    problem.structure(t0, z, k);
    problem.poisson_tensor(t0, z, pi);
    problem.one_form(t0, z, f);
    problem.field(t0, z, written);
    rows_.reproduced("(92)", "r'' = -nu r' - r", printed_.field(z), written);
    // The field from F and B alone, without the author's override.
    const Numbers field = value(*model_->derived(Formula::field), t0, z);
    rows_.reproduced("(93)", "K z' = (nu E p + E r, E p)", printed_.right_side(z),
                     Matrix<Quad>(2, k) * field);
    rows_.reproduced("(94)", "K", printed::listed(printed_.k0()), k);
    rows_.reproduced("(94)", "K^-1", printed::listed(printed_.k0_inverse()), pi);
    rows_.reproduced("(94)", "F", printed_.one_form(z), f);
    rows_.erratum("(94)", "B", {printed_.birkhoffian(z, printed::Form::as_printed)},
                  {printed_.birkhoffian(z, printed::Form::corrected)}, {problem.birkhoffian(t0, z)},
                  "(94): the middle term is nu r p");
  }

  // (w^, w) of (95) with w moved as the plug-in moves it.
  [[nodiscard]] Numbers moved(Numbers w) const {
    w[2] += w[1] * w[1] / 2;
    w[3] += w[0] * w[1];
    return w;
  }

  void alpha() {
    const Numbers hat{Quad(0.3), Quad(-0.2)}, z{Quad(0.5), Quad(0.1)};
    rows_.reproduced("(95)", "alpha of the damped pendulum", moved(printed_.alpha(hat, z)),
                     alpha_(t1, t0, hat, z));
    // States with w^ = 0: r^ = r, and p^ decayed.
    const Numbers decayed{z[0], exp(-(nu * tau)) * z[1]};
    const auto blocks = alpha_.blocks(t1, t0, decayed, z);
    rows_.reproduced("(96)", "alpha_*", printed::listed(printed_.alpha_jacobian()),
                     blocks.jacobian().entries());
    const Matrix<Quad> back =
        blocks.inverse_blocks(structure(*model_, t1, decayed), structure(*model_, t0, z)).jacobian();
    rows_.reproduced("(98)", "alpha_*^-1", printed::listed(printed_.alpha_inverse_jacobian()),
                     back.entries());
    const Numbers w{Quad(0.2), Quad(-0.4), Quad(0.6), Quad(0.3)};
    rows_.erratum("(97)", "alpha^-1", printed_.alpha_inverse(w, printed::Form::as_printed),
                  printed_.alpha_inverse(w, printed::Form::corrected), back * w,
                  "(97): p has e^{-nu t0} in front of R^");
  }

  // (99): the total derivatives of w^ and w in t at fixed z, as functions of (w^, w).
  void derivatives() {
    const Numbers hat{Quad(0.3), Quad(-0.2)}, z{Quad(0.5), Quad(0.1)};
    const auto blocks = alpha_.blocks(t1, t0, hat, z);
    const Numbers velocity = value(*model_->tape(Formula::field), t1, hat);
    const Numbers first = blocks.a * velocity, second = blocks.c * velocity;
    Numbers ours = alpha_.time_derivative(t1, t0, hat, z);
    for (std::size_t i = 0; i < 2; ++i) {
      ours[i] += first[i];
      ours[2 + i] += second[i];
    }
    const Numbers w = printed_.alpha(hat, z);
    Numbers rate = printed_.alpha_total_rate(w);
    rate[2] += w[1] * rate[1];  // of w + grad g(w^)
    rate[3] += w[0] * rate[1] + w[1] * rate[0];
    rows_.reproduced("(99)", "dw^/dt, dw/dt", rate, ours);
    rows_.reproduced("(99)", "dR^/dt, first form, the second p^ with its dot", {printed_.first_rate(hat)},
                     {ours[0]});
  }
};

}  // namespace

void oscillator_form(Rows& rows) { OscillatorForm(rows).add(); }

}  // namespace pfaff::su_qin
