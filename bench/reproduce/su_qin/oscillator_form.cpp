// Su & Qin, section 5, (93)-(99): the damped oscillator r'' + nu r' + r = 0 in Birkhoff's form, and alpha,
// rebuilt in quad through the same plug-in that any method sees.
#include <functional>

#include <pfaff/bench/reproduce/su_qin/oscillator.hpp>

namespace pfaff::su_qin {

namespace {

class OscillatorForm {
 public:
  std::vector<ReproducedRow> rows() {
    birkhoffian_form();
    alpha();
    derivatives();
    return rows_.take();
  }

 private:
  Rows rows_{"5"};
  const Quad e_ = exp(nu * t1), e0_ = exp(nu * t0);
  std::shared_ptr<const Model> model_ = damped("damped-oscillator");

  // (92)-(94): K, its inverse, F, B and the equations of motion from the plug-in's one-form.
  void birkhoffian_form() {
    const Numbers z{Quad(0.4), Quad(-0.7)};
    const Problem<Quad> problem(model_);
    Numbers k(4), pi(4), f(2), x(2);
    problem.structure(t0, z, k);
    problem.poisson_tensor(t0, z, pi);
    problem.one_form(t0, z, f);
    // The field from F and B alone, without the author's override.
    Replay<Quad>(model_->derived(Formula::field))(t0, z.data(), x.data());
    rows_.reproduced("(93)", "K z' = (nu E p + E r, E p)", {nu * e0_ * z[1] + e0_ * z[0], e0_ * z[1]},
                     {k[0] * x[0] + k[1] * x[1], k[2] * x[0] + k[3] * x[1]});
    rows_.reproduced("(94)", "K", {Quad(0), -e0_, e0_, Quad(0)}, k);
    rows_.reproduced("(94)", "K^-1", {Quad(0), Quad(1) / e0_, -Quad(1) / e0_, Quad(0)}, pi);
    rows_.reproduced("(94)", "F", {e0_ * z[1] / Quad(2), -(e0_ * z[0]) / Quad(2)}, f);
    const Quad half = e0_ / Quad(2), r2 = z[0] * z[0], rp = z[0] * z[1], p2 = z[1] * z[1];
    rows_.erratum("(94)", "B", {half * (r2 + rp + p2)}, {half * (r2 + nu * rp + p2)},
                  {problem.birkhoffian(t0, z)}, "(94): the middle term is nu r p");
  }

  // alpha is linear here: its Jacobian column by column.
  static std::vector<Quad> columns(const std::function<Numbers(const Numbers&)>& map) {
    std::vector<Quad> m(16);
    for (std::size_t j = 0; j < 4; ++j) {
      Numbers unit(4);
      unit[j] = Quad(1);
      const Numbers column = map(unit);
      for (std::size_t i = 0; i < 4; ++i) m[i * 4 + j] = column[i];
    }
    return m;
  }

  void alpha() {
    const Numbers hat{Quad(0.3), Quad(-0.2)}, z{Quad(0.5), Quad(0.1)};
    const Quad half = Quad(1) / Quad(2), zero(0), one(1);
    rows_.reproduced(
        "(95)", "alpha",
        {e_ * hat[1] - e0_ * z[1], hat[0] - z[0], (hat[0] + z[0]) * half, -(e_ * hat[1] + e0_ * z[1]) * half},
        alpha_of(*model_, hat, z));
    const auto a = columns([&](const Numbers& x) { return alpha_of(*model_, {x[0], x[1]}, {x[2], x[3]}); });
    rows_.reproduced("(96)", "alpha_*",
                     {zero, e_, zero, -e0_, one, zero, -one, zero, half, zero, half, zero, zero, -e_ * half,
                      zero, -e0_ * half},
                     a);
    const Numbers w{Quad(0.2), Quad(-0.4), Quad(0.6), Quad(0.3)};
    const Numbers inverse{w[2] + w[1] * half, (w[0] * half - w[3]) / e_, w[2] - w[1] * half,
                          -(w[0] * half + w[3]) / e0_};
    Numbers printed = inverse;
    printed[3] = -(half * e0_ * w[0]) - w[3] / e0_;
    rows_.erratum("(97)", "alpha^-1", printed, inverse, alpha_inverse(*model_, w),
                  "(97): p has e^{-nu t0} in front of R^");
    rows_.reproduced("(98)", "alpha_*^-1",
                     {zero, half, one, zero, half / e_, zero, zero, -one / e_, zero, -half, one, zero,
                      -half / e0_, zero, zero, -one / e0_},
                     columns([&](const Numbers& x) { return alpha_inverse(*model_, x); }));
  }

  // (99): the total time derivatives of w^ and w at fixed z, as functions of (w^, w).
  void derivatives() {
    const Numbers w{Quad(0.2), Quad(-0.4), Quad(0.6), Quad(0.3)}, z = alpha_inverse(*model_, w);
    const Numbers hat{z[0], z[1]};
    const Problem<Quad> problem(model_);
    Numbers y(2), rate(2);
    problem.chart(t1, hat, y);
    Replay<Quad>(model_->tape(Formula::chart_field))(t1, y.data(), rate.data());
    const Quad half = Quad(1) / Quad(2);
    const Numbers ours{rate[1], rate[0], rate[0] * half, -rate[1] * half};
    const Numbers in_w{-half * e_ * w[1] - e_ * w[2], half / e_ * w[0] - w[3] / e_,
                       half * half / e_ * w[0] - half / e_ * w[3],
                       half * half * e_ * w[1] + half * e_ * w[2]};
    rows_.reproduced("(99)", "dw^/dt, dw/dt", in_w, ours);
    // The first of its three forms, without the dot that the second p^ carries: p^' = -nu p^ - r^.
    const Quad slope = -(nu * hat[1]) - hat[0];
    rows_.erratum("(99)", "dR^/dt", {nu * e_ * hat[1] + e_ * hat[1]}, {nu * e_ * hat[1] + e_ * slope},
                  {ours[0]}, "(99): the second p^ carries a dot");
    rows_.erratum("(99)", "e - nu t", {half * (exp(Quad(1)) - nu * t1) * w[0] - w[3] / e_}, {in_w[1]},
                  {ours[1]}, "(99): e - nu t stands for e^{-nu t}");
  }
};

}  // namespace

std::vector<ReproducedRow> oscillator_form() { return OscillatorForm().rows(); }

}  // namespace pfaff::su_qin
