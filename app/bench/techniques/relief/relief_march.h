/// Peers that find each eye ray's hit in relief images, in the fragment shader; one pass over the prop's
/// faces.
///
/// Where    only pixels whose eye ray meets the images' box are drawn: each visible face is cut to the box's
///          shadow from the eye. The ray is followed from its entry into the box to its exit.
/// Solid    a point is inside the artifact if it lies behind the surface of every image (dual-depth relief,
///          Policarpo, Oliveira & Comba 2005: front and back along each axis). One image alone is solid down
///          to its far side, which would extrude every outline; the intersection of all five is the tightest
///          bound that single-layer images give, and the target of each search below.
/// Colour   of the image that sees the surface at the hit most nearly along its normal; bilinear, linear
///          light.
/// Precision 16-bit depths, 32-bit rays in box coordinates.
///
/// Threads  the one whose context is current; the kiosk must outlive the technique, the images need not.
#pragma once

#include "app/bench/techniques/relief/relief_images.h"
#include "app/bench/techniques/technique.h"

#include <memory>

namespace frustumscreen::bench {

/// Linear search, then bisection between the last two steps.
/// Source   Policarpo, Oliveira & Comba, Real-time relief mapping on arbitrary polygonal surfaces, 2005.
struct LinearBinary {
    int steps = 32;
    int bisections = 5;
};
[[nodiscard]] Result<std::unique_ptr<Technique>>
make_linear_march(const Kiosk& kiosk, const ReliefImages& images, const LinearBinary& search);

/// Relaxed cone stepping: each step runs to the border of a cone whose rays cross the image's surface at most
/// once, then bisection finds the crossing. An image that faces away from the ray steps by cones that do not
/// contain its surface (cone_map.h). Among the images that the point lies in front of, the largest step
/// counts.
/// Source   Policarpo & Oliveira, Relaxed cone stepping for relief mapping, GPU Gems 3, ch. 18, 2007.
/// Differs  a step extends at least to the border of the texel, so no ray gets stuck; the crossing is
///          bisected in the image that stepped, since behind it the ray may still be in front of the others.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_cone_march(const Kiosk& kiosk,
                                                                 const ReliefImages& images);

/// Maximum mipmaps: a texel of a coarser level bounds the material below it, so the ray either skips the
/// whole texel or descends one level; at the finest level the texels' columns are intersected exactly.
/// Source   Tevs, Ihrke & Seidel, Maximum mipmaps for fast, accurate, and scalable dynamic height field
///          rendering, 2008; Drobot, Quadtree displacement mapping with height blending, GPU Pro, 2010.
/// Differs  one level for the three axes at a time; columns are flat, not bilinear.
[[nodiscard]] Result<std::unique_ptr<Technique>> make_quadtree_march(const Kiosk& kiosk,
                                                                     const ReliefImages& images);

} // namespace frustumscreen::bench
