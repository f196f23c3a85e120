#pragma once
#include <cstddef>

#include "core/cell_id.h"
#include "study/color.h"

namespace morula::scenarios {

/// Colours of bodies, which no type and no mark has: a sphere is light, a shell is dark.
Rgb body_color(bool is_shell);

/// Colour number i of marks of faces, which no type and no body has. Source: "muted" of Tol 2021, personal.sron.nl/~pault, without the hues
/// that are near to those of categorical_color.
Rgb mark_color(std::size_t i);

/// Perceptually uniform dark-to-light map for numbers without a natural middle; t in 0..1 (clamped).
/// Control points: ten equidistant colours of "viridis" (van der Walt & Smith 2015, matplotlib, CC0), joined in OKLab.
Rgb sequential_color(double t);

/// Blue–grey–red map for numbers with a middle; t = 0.5 is the middle.
/// Computed in Msh space between (59, 76, 192) and (180, 4, 38): Moreland 2009, doi:10.1007/978-3-642-10520-3_9.
Rgb diverging_color(double t);

/// A pastel that belongs to this cell alone: hue from a hash of its id, constant lightness and chroma in OKLCH.
Rgb identity_color(CellId id);

/// OKLab to sRGB; components outside of the gamut are clipped. Source: Ottosson 2020, bottosson.github.io/posts/oklab.
Rgb from_oklab(double lightness, double a, double b);

}  // namespace morula::scenarios
