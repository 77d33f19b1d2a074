#include <pfaff/bench/measure/drift.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <cstdlib>
#include <cstdio>
namespace pfaff {
namespace {
constexpr std::size_t most = 32;
using Vector = std::vector<double>;
using Coefficients = std::array<double, most>;

struct Series { Vector t, y, f, w; void taper() { w.resize(t.size()); double sum = 0; for (std::size_t i = 0; i < t.size(); ++i) sum += w[i] = f[i] * t[i] * (1 - t[i]); for (double& v : w) v /= sum; } };

struct Basis {
  std::vector<Vector> p;  // p[n] degree n+1
  double scale;           // sd of t
  const Series& s;
  Basis(const Series& series, std::size_t q) : s(series) {
    const auto& t = s.t; const auto& w = s.w;
    std::size_t B = t.size();
    std::vector<Vector> all{Vector(B, 1.0)};
    for (std::size_t n = 1; n <= q; ++n) {
      Vector v(B);
      for (std::size_t i = 0; i < B; ++i) v[i] = (2 * t[i] - 1) * all[n - 1][i];
      for (int pass = 0; pass < 2; ++pass)
        for (const auto& u : all) {
          double dot = 0;
          for (std::size_t i = 0; i < B; ++i) dot += w[i] * u[i] * v[i];
          for (std::size_t i = 0; i < B; ++i) v[i] -= dot * u[i];
        }
      double norm = 0;
      for (std::size_t i = 0; i < B; ++i) norm += w[i] * v[i] * v[i];
      norm = std::sqrt(norm);
      if (n == 1) scale = norm / 2;
      for (auto& x : v) x /= norm;
      all.push_back(v);
    }
    p.assign(all.begin() + 1, all.end());
  }
  Coefficients project(const Vector& f) const {
    Coefficients c{};
    for (std::size_t n = 0; n < p.size(); ++n)
      for (std::size_t i = 0; i < f.size(); ++i) c[n] += s.w[i] * p[n][i] * f[i];
    return c;
  }
};

enum Group { steady, walk, smooth, groups };
struct Cell {
  double b, c, d; Group group; double prior;
  std::array<Coefficients, most> L;
  void whiten(Coefficients& x, std::size_t q) const {
    for (std::size_t i = 0; i < q; ++i) {
      for (std::size_t j = 0; j < i; ++j) x[i] -= L[i][j] * x[j];
      x[i] /= L[i][i];
    }
  }
  double log_det(std::size_t q) const { double s = 0; for (std::size_t i = 0; i < q; ++i) s += 2*std::log(L[i][i]); return s; }
};

double student(double x, int nu) {  // P(T <= x)
  double theta = std::atan(x / std::sqrt(double(nu))), c2 = std::pow(std::cos(theta), 2), term = nu % 2 ? std::cos(theta) : 1, sum = 0;
  for (int k = nu % 2 ? 3 : 2; k <= nu; k += 2) { sum += term; term *= c2 * (k - 1) / k; }
  sum *= std::sin(theta);
  return 0.5 + 0.5 * (nu % 2 ? (theta + sum) * 2 / std::numbers::pi : sum);
}
std::vector<Cell> make_cells() {
  constexpr std::size_t N = 400;
  Series s; s.t.resize(N); s.f.assign(N, 1.0 / N); s.y.assign(N,0);
  for (std::size_t i = 0; i < N; ++i) s.t[i] = (double(i) + 0.5) / N;
  s.taper();
  Basis basis(s, most);
  std::vector<Cell> cells;
  using Matrix = std::array<Coefficients, most>;
  auto covariance = [&](double c, double d) {
      Vector psi(N, 1.0);
      for (std::size_t k = 1; k < N; ++k) psi[k] = psi[k - 1] * std::exp(-c / N) * (double(k) - 1 + d) / double(k);
      std::vector<Vector> z(most, Vector(N));
      for (std::size_t n = 0; n < most; ++n)
        for (std::size_t j = 0; j < N; ++j)
          for (std::size_t i = j; i < (d > 0 ? N : j + 1); ++i) z[n][j] += psi[i - j] * basis.p[n][i] * s.w[i];
      Matrix V{};
      double trace = 0;
      for (std::size_t n = 0; n < most; ++n)
        for (std::size_t m = 0; m <= n; ++m) {
          for (std::size_t j = 0; j < N; ++j) V[n][m] += z[n][j] * z[m][j];
          if (n == m) trace += V[n][n];
        }
      for (auto& row : V) for (auto& x : row) x *= double(most) / trace;
      return V;
  };
  const Matrix W = covariance(0, 0);
  auto push = [&](Group group, double prior, double b, double c, double d, const Matrix& V) {
    Cell cell{b, c, d, group, prior, {}};
    auto& L = cell.L;
    for (std::size_t i = 0; i < most; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = (1 - b) * V[i][j] + b * W[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= L[i][k] * L[j][k];
        L[i][j] = i == j ? std::sqrt(std::max(sum,1e-300)) : sum / L[j][j];
      }
    cells.push_back(cell);
  };
  struct Shape { Group g; double c, d; };
  std::vector<Shape> shapes{{steady,0,-1},{steady,0,-1.5},{steady,0,.25},{steady,0,.5},{walk,0,.75},{walk,0,1},{walk,0,1.25},{walk,0,1.5},{smooth,0,2},{smooth,0,3},{steady,8,2},{steady,8,3}};
  for (double c : {16.,32.,64.}) for (double d : {.5,1.,2.,3.}) shapes.push_back({steady,c,d});
  for (auto& c : shapes) { auto V = covariance(c.c, c.d); for (double b : {1e-4, 1e-3, 1e-2, 0.1, 0.5}) if (c.g != smooth || b <= .01) push(c.g, c.d < 0 ? 0.5 : 1, b, c.c, c.d, V); }
  std::array<double, groups> count{};
  for (auto& c : cells) count[c.group] += c.prior;
  for (auto& c : cells) c.prior *= (c.group == steady ? 0.5 : 1) / count[c.group];
  push(steady, 0.5, 1, 0, 0, W);
  return cells;
}
const std::vector<Cell>& table() { static const std::vector<Cell> c = make_cells(); return c; }

double dot(const Coefficients& a, const Coefficients& b, std::size_t q) { double s = 0; for (std::size_t i = 0; i < q; ++i) s += a[i] * b[i]; return s; }

struct Verdict { DriftClass kind; double probability; std::optional<double> exponent; double slope, low, high; };

double env(const char* n, double d) { return std::getenv(n) ? std::atof(std::getenv(n)) : d; }
const double class_prior[] = {env("CS", .5), env("CW", .25), env("CM", .05)};
const double slope_prior[] = {env("SS", .94), env("SW", .05), env("SM", .01)};
double trend_prior = std::getenv("TP") ? std::atof(std::getenv("TP")) : 0.2;

Verdict judge(const Series& s, double amplitude) {
  std::size_t B = s.t.size();
  std::size_t q = std::min({most, std::size_t(2 * std::sqrt(double(B))), B - 1});
  Basis basis(s, q);
  Coefficients Y = basis.project(s.y);
  double eps = std::numeric_limits<double>::epsilon() * amplitude;
  double floor = double(q) * eps * eps;
  double h = double(q) / 2;
  // whitened data
  const auto& cells = table();
  std::size_t M = cells.size();
  std::vector<Coefficients> Yw(M, Y);
  Vector yy(M), ld(M);
  for (std::size_t m = 0; m < M; ++m) { cells[m].whiten(Yw[m], q); yy[m] = dot(Yw[m], Yw[m], q); ld[m] = cells[m].log_det(q); }
  // none
  Vector none(M);
  for (std::size_t m = 0; m < M; ++m) none[m] = std::log(cells[m].prior * class_prior[cells[m].group]) - 0.5 * ld[m] - h * std::log(yy[m] + floor);
  auto evidence = [&](double p, Vector* out) {
    Vector f(B);
    for (std::size_t i = 0; i < B; ++i) f[i] = p > 0 ? std::pow(s.t[i], p) : std::exp(-p * s.t[i]);
    Coefficients x = basis.project(f);
    double best = -1e300; Vector e(M);
    for (std::size_t m = 0; m < M; ++m) {
      if (cells[m].group == smooth || cells[m].c == 8) { e[m] = -1e300; continue; }
      Coefficients xw = x; cells[m].whiten(xw, q);
      double xx = dot(xw, xw, q), xy = dot(xw, Yw[m], q);
      double rss = std::max(yy[m] - xy * xy / xx, 0.0);
      e[m] = std::log(cells[m].prior * (cells[m].group == steady ? .7 : .3)) - 0.5 * ld[m] - h * std::log(rss + floor) - 0.5 * std::log(double(q));
      best = std::max(best, e[m]);
    }
    if (out) *out = e;
    double sum = 0; for (double v : e) sum += std::exp(v - best);
    return best + std::log(sum);
  };
  std::vector<double> ps{0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 6, -16, -12, -8, -5, -3};
  Vector pe; double top = *std::max_element(none.begin(), none.end());
  for (double p : ps) { pe.push_back(evidence(p, nullptr) + std::log(trend_prior * (p == 1 ? 0.5 : 0.033))); top = std::max(top, pe.back()); }
  std::array<double, groups> g{}; double walk_d = 0, tot = 0;
  for (std::size_t m = 0; m < M; ++m) { double v = std::exp(none[m] - top); g[cells[m].group] += v; if (cells[m].group == walk) walk_d += v * cells[m].d; tot += v; }
  double trend = 0; for (double v : pe) trend += std::exp(v - top);
  tot += trend;
  if (std::getenv("DV")) std::printf("  steady %.3g walk %.3g smooth %.3g trend %.3g\n", g[0]/tot, g[1]/tot, g[2]/tot, trend/tot);
  // slope
  Vector se(M), wt(M); double best = -1e300;
  for (std::size_t m = 0; m < M; ++m) {
    Coefficients xw{}; xw[0] = 1; cells[m].whiten(xw, q);
    double xx = dot(xw, xw, q), xy = dot(xw, Yw[m], q);
    double rss = std::max(yy[m] - xy * xy / xx, 0.0) + floor;
    se[m] = std::sqrt(rss / double(q - 1)) * cells[m].L[0][0];
    wt[m] = std::log(cells[m].prior * slope_prior[cells[m].group]) - 0.5 * ld[m] - 0.5 * std::log(xx) - (h - 0.5) * std::log(rss);
    best = std::max(best, wt[m]);
  }
  double sum = 0, hi = 0, lo = 0;
  for (std::size_t m = 0; m < M; ++m) { wt[m] = std::exp(wt[m] - best); if (wt[m] < 1e-5) wt[m] = 0; sum += wt[m]; if (wt[m] > 0) hi = std::max(hi, se[m] * 13); }
  for (int i = 0; i < 40; ++i) {
      double x = (lo + hi) / 2, cdf = 0;
      for (std::size_t m = 0; m < M; ++m) if (wt[m] > 0) cdf += wt[m] / sum * student(x / se[m], int(q) - 1);
      (cdf < 0.975 ? lo : hi) = x;
  }
  std::size_t kk = std::size_t(std::max_element(pe.begin(), pe.end()) - pe.begin());
  if (ps[kk] > 0 && ps[kk] <= 1.25 && hi >= std::abs(Y[0])) trend = 0;
  Verdict out{};
  double bestg = std::max({g[0], g[1], g[2], trend});
  out.probability = bestg / tot;
  if (bestg == trend) {
    std::size_t k = std::size_t(std::max_element(pe.begin(), pe.end()) - pe.begin());
    double lo = ps[k ? k - 1 : 0], hi = ps[std::min(k + 1, ps.size() - 1)];
    if (!k) lo = 0.75; if (ps[k] < 0) { lo = 1.4 * ps[k]; hi = 0.7 * ps[k]; } else if (hi < 0) hi = 8;
    constexpr double r = 0.6180339887498949;
    double a = hi - r * (hi - lo), b2 = lo + r * (hi - lo), fa = evidence(a, nullptr), fb = evidence(b2, nullptr);
    while (hi - lo > 1e-4) {
      if (fa > fb) { hi = b2; b2 = a; fb = fa; a = hi - r * (hi - lo); fa = evidence(a, nullptr); }
      else { lo = a; a = b2; fa = fb; b2 = lo + r * (hi - lo); fb = evidence(b2, nullptr); }
    }
    double p = (lo + hi) / 2; 
    if (ps[k] == 1 && evidence(p, nullptr) - evidence(1, nullptr) < 2) p = 1;
    out.exponent = p;
    out.kind = p < 0 ? DriftClass::exponential : p < 0.25 ? DriftClass::bounded : p < 0.75 ? DriftClass::random_walk : p <= 1.25 ? DriftClass::linear : DriftClass::polynomial;
  } else if (bestg == g[walk]) { out.kind = DriftClass::random_walk; out.exponent = walk_d / g[walk] - 0.5; }
  else if (bestg == g[steady]) { out.kind = DriftClass::bounded; out.exponent = 0; }
  else out.kind = DriftClass::undetermined;
  out.slope = Y[0] / basis.scale; out.low = (Y[0] - hi) / basis.scale; out.high = (Y[0] + hi) / basis.scale;
  return out;
}
// least squares of y on x; returns {slope, residual sum of squares, total}
std::array<double, 3> line(const Vector& x, const Vector& y) {
  double n = double(x.size()), mx = 0, my = 0, sxx = 0, sxy = 0, syy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) { mx += x[i] / n; my += y[i] / n; }
  for (std::size_t i = 0; i < x.size(); ++i) { sxx += (x[i]-mx)*(x[i]-mx); sxy += (x[i]-mx)*(y[i]-my); syy += (y[i]-my)*(y[i]-my); }
  return {sxy / sxx, syy - sxy * sxy / sxx, syy};
}
std::optional<double> exponential_rate(const Series& g) {
  double floor = 1e300; for (double v : g.y) if (v > 0) floor = std::min(floor, v);
  std::size_t start = 0;
  for (std::size_t i = 0; i < g.y.size(); ++i) if (g.y[i] <= 10 * floor) start = i + 1;
  Vector t, lt, l;
  for (std::size_t i = start; i < g.y.size(); ++i) { t.push_back(g.t[i]); lt.push_back(std::log(g.t[i])); l.push_back(std::log(g.y[i])); }
  if (t.size() < 6) return {};
  auto e = line(t, l), p = line(lt, l);
  if (e[0] * (t.back() - t.front()) < 3 || e[1] > 0.1 * e[2] || e[1] > 0.25 * p[1]) return {};
  return e[0];
}
}  // namespace

const char* to_string(DriftClass kind) {
  switch (kind) {
    case DriftClass::exact: return "exact";
    case DriftClass::bounded: return "bounded";
    case DriftClass::random_walk: return "random_walk";
    case DriftClass::linear: return "linear";
    case DriftClass::polynomial: return "polynomial";
    case DriftClass::exponential: return "exponential";
    case DriftClass::undetermined: return "undetermined";
  }
  return "undetermined";
}
DriftAccumulator::DriftAccumulator(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity & ~std::size_t{1}, 64)) { blocks_.reserve(capacity_); }
DriftAccumulator::Block DriftAccumulator::merged(const Block& a, const Block& b) {
  Block m;
  m.count = a.count + b.count;
  double f = double(b.count) / double(m.count);
  m.time = a.time + f * (b.time - a.time);
  m.mean = a.mean + f * (b.mean - a.mean);
  m.mean_square = a.mean_square + f * (b.mean_square - a.mean_square);
  m.minimum = std::min(a.minimum, b.minimum);
  m.maximum = std::max(a.maximum, b.maximum);
  return m;
}
void DriftAccumulator::add(double t, double error) {
  if (!std::isfinite(t) || !(std::abs(error) < 1e150)) {
    if (non_finite_++ == 0) bad_time_ = t;
    return;
  }
  if (non_finite_) return;
  if (samples_ == 0) first_time_ = t;
  ++samples_;
  double n = double(samples_), dt = t - mean_time_, de = error - mean_;
  mean_time_ += dt / n; mean_ += de / n;
  time_time_ += dt * (t - mean_time_); time_error_ += dt * (error - mean_); error_error_ += de * (error - mean_);
  final_ = error; last_time_ = t;
  Block one{1, t, error, error, error, error * error};
  if (!blocks_.empty() && blocks_.back().count < length_) { blocks_.back() = merged(blocks_.back(), one); return; }
  if (blocks_.size() == capacity_) {
    for (std::size_t i = 0; i < capacity_ / 2; ++i) blocks_[i] = merged(blocks_[2 * i], blocks_[2 * i + 1]);
    blocks_.resize(capacity_ / 2);
    length_ *= 2;
  }
  blocks_.push_back(one);
}
Drift DriftAccumulator::result() const {
  Drift r;
  r.samples = samples_; r.non_finite = non_finite_;
  if (non_finite_) r.non_finite_time = bad_time_;
  if (!samples_) return r;
  double square = 0;
  for (const auto& b : blocks_) {
    r.maximum = std::max({r.maximum, std::abs(b.minimum), std::abs(b.maximum)});
    square += b.mean_square * (double(b.count) / double(samples_));
  }
  r.rms = std::sqrt(square); r.final = final_;
  if (samples_ < 4 || !(time_time_ > 0)) return r;
  double slope = time_error_ / time_time_;
  r.oscillation_rms = std::sqrt(std::max(error_error_ - slope * time_error_, 0.0) / double(samples_));
  double up = -1e300, down = 1e300;
  for (const auto& b : blocks_) { double trend = mean_ + slope * (b.time - mean_time_); up = std::max(up, b.maximum - trend); down = std::min(down, b.minimum - trend); }
  r.oscillation_amplitude = (up - down) / 2;
  Series s, g;
  const Block& last = blocks_.back();
  (void)last; double span = (last_time_ - first_time_) * double(samples_) / double(samples_ - 1), origin = first_time_ - span / double(2 * samples_);
  for (const auto& b : blocks_) {
    s.t.push_back((b.time - origin) / span); s.f.push_back(double(b.count)); s.y.push_back(b.mean);
  }
  if (r.maximum == 0) { r.kind = DriftClass::exact; r.probability = 1; r.growth_exponent = 0; return r; }
  s.taper();
  Verdict v = judge(s, r.maximum);
  r.kind = v.kind; r.probability = v.probability; r.growth_exponent = v.exponent;
  r.slope = v.slope / span; r.slope_low = v.low / span; r.slope_high = v.high / span;
  if (span < 0) std::swap(r.slope_low, r.slope_high);
  std::size_t per = (blocks_.size() + 127) / 128;
  for (std::size_t i = 0; i + per <= blocks_.size(); i += per) {
    Block m = blocks_[i];
    for (std::size_t j = 1; j < per; ++j) m = merged(m, blocks_[i + j]);
    g.t.push_back((m.time - origin) / span); g.y.push_back(std::sqrt(m.mean_square)); g.f.push_back(double(m.count));
  }
  g.taper();
  if (r.kind == DriftClass::exponential) { r.growth_rate = -*r.growth_exponent / span; r.growth_exponent.reset(); }
  if (auto rate = exponential_rate(g)) { r.kind = DriftClass::exponential; r.growth_rate = *rate / span; r.growth_exponent.reset(); }
  else if (r.kind == DriftClass::bounded) {
    std::size_t k = g.y.size() / 4; double early = 0, late = 0;
    for (std::size_t i = 0; i < k; ++i) { early += g.y[i]; late += g.y[g.y.size() - 1 - i]; }
    if (late > 2 * early) {
      Verdict e = judge(g, r.maximum);
      if (e.kind != DriftClass::bounded && e.kind != DriftClass::undetermined) { r.kind = e.kind; r.growth_exponent = e.exponent; r.probability = e.probability; }
    }
  }
  if (samples_ < 32 || non_finite_) { r.kind = DriftClass::undetermined; r.growth_exponent.reset(); }
  return r;
}
}  // namespace pfaff
