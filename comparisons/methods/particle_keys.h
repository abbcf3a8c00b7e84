#pragma once

#include "comparisons/scene/vocabulary.h"

#include "meshless/kernels/kernel_table.h"

#include <optional>
#include <vector>

namespace comparisons::methods {

/// The particle methods.
enum class Form { strong, weak1, weak2, hybrid, mixed };

inline bool has_subdomains(Form form) { return form != Form::strong; }
/// Needs second derivatives of the shape functions at any point.
inline bool collocates(Form form) { return form == Form::strong || form == Form::hybrid || form == Form::mixed; }

/// The least order of a form: 2 where second derivatives are collocated, as the mixed form does, whose pressure has one
/// order less.
inline int least_order(Form form) { return collocates(form) ? 2 : 1; }

/// The keys of a method in a scene.
std::vector<scene::Declaration> particle_keys(Form form);

/// Errors and warnings that can be told before any computing.
void check_particle_keys(Form form, const scene::CheckContext &context, scene::Diagnostics &diagnostics);

/// h over the distance that smoothing_rule names.
double smoothing_length_of(const scene::Parameters &parameters, bool regular);
/// The kernel of the basis.
meshless::kernels::Kernel kernel_of(const scene::Parameters &parameters, bool regular);
/// The kernel of the basis of the mixed method's pressure.
meshless::kernels::Kernel pressure_kernel_of(const scene::Parameters &parameters, bool regular);
/// The test function; nothing for Heaviside's.
std::optional<meshless::kernels::Kernel> test_function_of(const scene::Parameters &parameters, double test_radius);
/// Radius of the local subdomain in units of h.
/// @param regular a regular cloud, or ellipses
/// @param smoothing_length h over the spacing
double test_radius_of(const scene::Parameters &parameters, Form form, bool regular, double smoothing_length);
/// Subdomains that reach no farther than the boundary.
bool shrinks_subdomains(const scene::Parameters &parameters, bool regular, bool elliptic);

enum class Supports {
  round,
  elliptic,
  by_cells, ///< elliptic where cells are much longer than wide
};

Supports supports_of(const scene::Parameters &parameters, Form form, bool regular);

} // namespace comparisons::methods
