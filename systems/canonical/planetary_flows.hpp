// The flows of Kepler orbits and their interaction (planetary_splitting.hpp) of bodies that are known only
// when a program runs, as those of a text model are.
#pragma once

#include <vector>

#include <pfaff/core/facets/exact_flows.hpp>
#include <pfaff/systems/canonical/planetary_splitting.hpp>

namespace pfaff {

/// Bodies whose coordinates stand by direction, as in Gravitation, all positions before all momenta.
struct PlanetaryBodies {
  std::vector<Real> masses;
  Real constant;  // of gravitation
  std::size_t directions = 3;

  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    const auto mass = [this](std::size_t body) { return T(masses[body]); };
    return planetary::part_flow<T>(part, mass, T(constant), masses.size(), directions, h, z, change);
  }
};

using PlanetaryFlowsFactory = ExactFlowsFactoryOf<PlanetaryBodies>;

}  // namespace pfaff
