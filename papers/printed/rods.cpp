#include <pfaff/papers/printed/rods.hpp>

namespace pfaff::printed {

using Numbers = std::vector<Quad>;

Numbers Rods::velocity() const {
  Numbers v = p;
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = p[k] / masses[k / dimension];
  return v;
}
Numbers Rods::force() const {
  Numbers f(q.size());
  for (std::size_t i = 0; i < beads(); ++i) f[dimension * i + dimension - 1] = -(gravity * masses[i]);
  return f;
}
Numbers Rods::coefficients() const {
  Numbers lambda(q.size());
  for (std::size_t k = 0; k < lambda.size(); ++k)
    if (!friction.empty()) lambda[k] = friction[k / dimension];
  return lambda;
}

int Rods::sign(std::size_t k, std::size_t bead) const {
  if (pendulum && k == 0) return bead == 0 ? 1 : 0;
  const std::size_t first = pendulum ? k - 1 : k;
  if (bead == first) return 1;
  return bead == first + 1 ? -1 : 0;
}
Numbers Rods::along(std::size_t k, const Numbers& x) const {
  Numbers link(dimension);
  for (std::size_t bead = 0; bead < beads(); ++bead)
    for (std::size_t axis = 0; axis < dimension; ++axis)
      link[axis] += Quad(sign(k, bead)) * x[bead * dimension + axis];
  return link;
}

Numbers Rods::constraints() const {
  Numbers phi;
  for (std::size_t k = 0; k < count(); ++k)
    phi.push_back((dot(link(k), link(k)) - lengths[k] * lengths[k]) / 2);
  return phi;
}
Numbers Rods::hidden_constraints() const {
  Numbers hidden;
  for (std::size_t k = 0; k < count(); ++k) hidden.push_back(dot(link(k), link_velocity(k)));
  return hidden;
}
Numbers Rods::constraints_as_printed() const {
  Numbers phi = constraints();
  phi.pop_back();
  for (std::size_t k = 1; k + 1 < count(); ++k)
    phi[k] = (dot(link(k + 1), link(k + 1)) - lengths[k] * lengths[k]) / 2;
  return phi;
}
Numbers Rods::hidden_constraints_as_printed() const {
  Numbers hidden = hidden_constraints();
  hidden.pop_back();
  for (std::size_t k = 1; k + 1 < count(); ++k) hidden[k] = dot(link(k + 1), link_velocity(k + 1));
  return hidden;
}

// Rod k joins beads j - 1 and j, or the origin and bead j.
Table<Quad> Rods::table_s() const {
  Table<Quad> s = zero_table<Quad>(count(), count());
  for (std::size_t k = 0; k < count(); ++k) {
    const bool hangs = pendulum && k == 0;
    const std::size_t j = pendulum ? k : k + 1;
    s[k][k] = (hangs ? 1 / masses[j] : 1 / masses[j - 1] + 1 / masses[j]) * lengths[k] * lengths[k];
    if (k + 1 == count()) continue;
    const Quad b = dot(link(k), link(k + 1)) / masses[j];
    s[k][k + 1] = s[k + 1][k] = hangs ? b : -b;
  }
  return s;
}
Table<Quad> Rods::table_a() const {
  Table<Quad> a = zero_table<Quad>(count(), count());
  for (std::size_t k = 0; k + 1 < count(); ++k) {
    a[k][k + 1] = (dot(link(k), link_velocity(k + 1)) - dot(link_velocity(k), link(k + 1))) / masses[k + 1];
    a[k + 1][k] = -a[k][k + 1];
  }
  return a;
}
Table<Quad> Rods::table_s_friction() const {
  const auto weight = [&](std::size_t bead) { return friction[bead] / (masses[bead] * masses[bead]); };
  Table<Quad> s = zero_table<Quad>(count(), count());
  for (std::size_t k = 0; k < count(); ++k) {
    s[k][k] = (weight(k) + weight(k + 1)) * lengths[k] * lengths[k];
    if (k + 1 < count()) s[k][k + 1] = s[k + 1][k] = -(weight(k + 1) * dot(link(k), link(k + 1)));
  }
  return s;
}

Table<Quad> Rods::spread(bool velocities, bool over_mass) const {
  Table<Quad> rows = zero_table<Quad>(count(), q.size());
  for (std::size_t k = 0; k < count(); ++k) {
    const Numbers link = velocities ? link_velocity(k) : this->link(k);
    for (std::size_t bead = 0; bead < beads(); ++bead)
      for (std::size_t axis = 0; axis < dimension; ++axis)
        rows[k][bead * dimension + axis] =
            Quad(sign(k, bead)) * link[axis] / (over_mass ? masses[bead] : Quad(1));
  }
  return rows;
}
Table<Quad> Rods::phi_by_q() const { return spread(false, false); }
Table<Quad> Rods::hidden_by_q() const { return spread(true, false); }
Table<Quad> Rods::hidden_by_p() const { return spread(false, true); }

Motion::Motion(const Rods& rods)
    : rods_(rods),
      v_(rods.velocity()),
      f_(rods.force()),
      lambda_(rods.coefficients()),
      b_(rods.phi_by_q()),
      t_(rods.hidden_by_q()),
      p_(rods.hidden_by_p()),
      s_(product(b_, transposed(p_))),
      a_(difference(product(t_, transposed(p_)), product(p_, transposed(t_)))),
      s_inverse_(inverse(s_)),
      hidden_(rods.hidden_constraints()) {
  Table<Quad> weighted = p_;
  for (auto& row : weighted)
    for (std::size_t l = 0; l < row.size(); ++l) row[l] *= lambda_[l];
  friction_ = product(weighted, transposed(p_));
}

Table<Quad> Motion::w() const {
  const std::size_t k = s_.size();
  Table<Quad> w = zero_table<Quad>(2 * k, 2 * k);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      w[i][k + j] = s_[i][j];
      w[k + i][j] = -s_[j][i];
      w[k + i][k + j] = a_[i][j];
    }
  return w;
}
Table<Quad> Motion::w_inverse() const {
  const std::size_t k = s_.size();
  const Table<Quad> corner = product(product(s_inverse_, a_), s_inverse_);
  Table<Quad> c = zero_table<Quad>(2 * k, 2 * k);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      c[i][j] = corner[i][j];
      c[i][k + j] = -s_inverse_[i][j];
      c[k + i][j] = s_inverse_[i][j];
    }
  return c;
}

Numbers Motion::friction() const {
  const Table<Quad> c = inverse(friction_);
  Numbers force(v_.size());
  for (std::size_t i = 0; i < v_.size(); ++i) {
    Quad bracket = v_[i];
    for (std::size_t j = 0; j < c.size(); ++j)
      for (std::size_t k = 0; k < c.size(); ++k)
        for (std::size_t l = 0; l < v_.size(); ++l)
          bracket -= p_[j][i] * c[j][k] * lambda_[l] * p_[k][l] * v_[l];
    force[i] = -(lambda_[i] * bracket);
  }
  return force;
}
Numbers Motion::hidden_rates() const {
  Numbers rates = second_derivatives();
  const Numbers accelerated = product(p_, f_);
  for (std::size_t k = 0; k < rates.size(); ++k) rates[k] += accelerated[k];
  return rates;
}

Numbers Motion::simplified(bool with_friction) const {
  const Numbers rates = hidden_rates(), rubbed = with_friction ? friction() : Numbers(v_.size());
  Numbers rate = v_;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    Quad force = f_[i];
    for (std::size_t j = 0; j < s_.size(); ++j)
      for (std::size_t k = 0; k < s_.size(); ++k) force -= s_inverse_[j][k] * b_[j][i] * rates[k];
    rate.push_back(force + rubbed[i]);
  }
  return rate;
}
Numbers Motion::dirac(bool with_friction) const {
  const std::size_t n = v_.size();
  const Table<Quad> corner = product(product(s_inverse_, a_), s_inverse_);
  Numbers rate = simplified(with_friction);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < s_.size(); ++j)
      for (std::size_t k = 0; k < s_.size(); ++k) {
        rate[i] -= s_inverse_[j][k] * p_[j][i] * hidden_[k];
        rate[n + i] += (corner[j][k] * b_[j][i] + s_inverse_[j][k] * t_[j][i]) * hidden_[k];
      }
  return rate;
}

Numbers Motion::second_derivatives() const {
  Numbers g;  // the second derivatives of |Delta r|^2 / 2 are those of a square
  for (std::size_t k = 0; k < rods_.count(); ++k)
    g.push_back(dot(rods_.link_velocity(k), rods_.link_velocity(k)));
  return g;
}
Numbers Motion::multipliers() const { return product(s_inverse_, hidden_rates()); }
Numbers Motion::reactions() const { return product(transposed(b_), multipliers()); }
Numbers Motion::lagrange() const {
  const Numbers reaction = reactions();
  Numbers rate = v_;
  for (std::size_t i = 0; i < v_.size(); ++i) rate.push_back(f_[i] - reaction[i]);
  return rate;
}
Numbers Motion::first_derivatives() const { return product(b_, v_); }

}  // namespace pfaff::printed
