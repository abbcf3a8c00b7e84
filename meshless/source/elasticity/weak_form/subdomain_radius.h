#pragma once

#include "meshless/domain/visibility.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include <vector>

namespace meshless::elasticity::weak_form {

using domain::Point2;

/// The radius of a subdomain with Subdomains::shrunk (see there), at most `radius`.
/// @param own pieces that the particle lies on, none inside
double shrunk_radius(const domain::Visibility &visibility, const Point2 &centre, double radius,
                     const std::vector<std::size_t> &own);

/// @throws std::invalid_argument if subdomains are to be shrunk that have the shape of supports that are ellipses
void require_shrinkable(Subdomains subdomains, const cloud::Particles<2> &particles);

} // namespace meshless::elasticity::weak_form
