/// The common part of the peers that search relief images: the rays, the pixels, the colours. Each peer
/// supplies its own search as a shader.
///
/// A search is GLSL that defines
///     bool search(vec3 start, vec3 along, float leave, out float at)
/// start + t along is the eye ray in box coordinates, inside the box for 0 < t < leave; `at` is the hit's t.
/// It may use
///     float box_codes                 65535: codes of one box length of height
///     int texels                      per side of an image
///     highp usampler2DArray relief    the technique's own; layers 0..2 have `material_along` the axes in .xy
///     bool inside(vec3 p)             p is behind the surface of every image, at the nearest texels
///
/// Threads  the one whose context is current.
#pragma once

#include "app/bench/techniques/peer_gl.h"
#include "app/bench/techniques/relief/relief_images.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bench {

struct ReliefSearch {
    std::string name;
    std::string defines;
    std::string_view source;
    gl::GlTexture relief; ///< the array read by `source`
};

[[nodiscard]] Result<std::unique_ptr<Technique>>
make_relief_technique(const Kiosk& kiosk, const ReliefImages& images, ReliefSearch search);

/// An array of `layers` unsigned 16-bit images with `levels` mip levels, read by texelFetch.
[[nodiscard]] gl::GlTexture make_relief_array(GLenum format, int texels, int levels, int layers);
/// Writes an image into the bound array.
void set_layer(int level, int layer, const image::Image<glm::u16vec2>& image);
void set_layer(int level, int layer, const image::Image<glm::u16vec4>& image);

/// The part of a face whose eye rays meet the box: convex, in the order of the face's corners; may be empty.
[[nodiscard]] std::vector<glm::dvec3> shadow_on_face(const geometry::PropFace& face, const glm::dvec3& eye_m,
                                                     const geometry::Box& box);

} // namespace frustumscreen::bench
