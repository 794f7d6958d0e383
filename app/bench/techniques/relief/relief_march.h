/// Peers that find each eye ray's hit in relief images, in the fragment shader; one pass over the prop's
/// faces.
///
/// Where    only pixels whose eye ray meets the images' box are drawn: each visible face is cut to the box's
///          shadow from the eye. The ray is followed from where it enters the box to where it leaves it.
/// Solid    a point is inside the artifact if it lies behind the surface of every image (dual-depth relief,
///          Policarpo, Oliveira & Comba 2005: front and back along each axis). One image alone is solid down
///          to its far side, which would hang a curtain from every outline; the intersection of all five is
///          the most that single-layer images say, and what each search below looks for.
/// Colour   of the image that sees the surface at the hit most squarely; bilinear, linear light.
/// Precision 16-bit depths, 32-bit rays in box coordinates.
///
/// Threads  the one whose context is current; the stage must outlive the technique, the images need not.
#pragma once

#include "app/bench/techniques/relief/relief_images.h"
#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen {

/// Linear search, then bisection between the last two steps.
/// Source   Policarpo, Oliveira & Comba, Real-time relief mapping on arbitrary polygonal surfaces, 2005.
struct LinearBinary {
    int steps = 32;
    int bisections = 5;
};
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_linear_march(const Stage& stage, const ReliefImages& images, const LinearBinary& search);

/// Relaxed cone stepping: each step runs to the border of a cone whose rays cross the image's surface once at
/// most, then bisection finds the crossing. An image that faces away from the ray steps by cones that are
/// free of its surface (cone_map.h). The largest step of the images that the point lies in front of is taken.
/// Source   Policarpo & Oliveira, Relaxed cone stepping for relief mapping, GPU Gems 3, ch. 18, 2007.
/// Differs  a step is at least to the border of the texel, so that no ray is stuck; the crossing is bisected
///          in the image that stepped, since behind it the ray may still be in front of the others.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_cone_march(const Stage& stage,
                                                                 const ReliefImages& images);

/// Maximum mipmaps: a texel of a coarser level bounds the material below it, so the ray skips it whole or
/// goes a level finer; at the finest the texels' columns are intersected exactly.
/// Source   Tevs, Ihrke & Seidel, Maximum mipmaps for fast, accurate, and scalable dynamic height field
///          rendering, 2008; Drobot, Quadtree displacement mapping with height blending, GPU Pro, 2010.
/// Differs  one level for the three axes at a time; columns are flat, not bilinear.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_quadtree_march(const Stage& stage,
                                                                     const ReliefImages& images);

} // namespace frustumscreen
