// Which points of a system its constraints hold at a distance, as pictures of its motion draw them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// A constraint of length: from a point, the number k of the coordinates xk, yk (and zk), to another one, or
/// to a fixed place with as many coordinates.
struct Link {
  std::size_t from = 0;
  std::optional<std::size_t> to;
  std::vector<double> place;  // where `to` is empty
};

/// The links among the points of a model at a state (q, p). They are found from the gradients of the
/// constraints: one that touches two points, along the line between them, joins them; one that touches one
/// point and points away from a fixed place, at a length in proportion to the distance from it, joins the
/// point to that place. Other constraints join nothing. Empty where the positions are not points x0, y0, ...
/// of two or three coordinates, or are more than a thousand points.
std::vector<Link> links_of(const Model& model, double t, const std::vector<double>& state);

}  // namespace pfaff
