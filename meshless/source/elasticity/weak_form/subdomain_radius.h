#pragma once

#include "meshless/domain/visibility.h"

#include <vector>

namespace meshless::elasticity::weak_form {

using domain::Point2;

/// The radius of a subdomain with Subdomains::shrunk (see there), at most `radius`.
/// @param own pieces that the particle lies on, none inside
double shrunk_radius(const domain::Visibility &visibility, const Point2 &centre, double radius,
                     const std::vector<std::size_t> &own);

} // namespace meshless::elasticity::weak_form
