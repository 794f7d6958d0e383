/// The truth for measuring every picture: a ray cast of the source mesh, as defined in docs/conventions.md.
///
/// For a projector pixel whose ray lights the prop at S, on a face turned towards the eye E, the colour is
/// that of the first hit of E + t (S - E), t > 0; black if there is none. Triangles are two-sided; alpha MASK
/// is cut at its cut-off, BLEND is opaque. (For a pack's surfaces, only front sides are drawn.) Colour = base
/// colour * texture (bilinear, base level, linear light) * vertex colour.
///
/// Frames   points and the eye in the prop's frame, metres; pixels as `Pinhole` has them.
/// Set-up   vertices are placed and hits refined in 64-bit; Embree (float, robust) only finds the triangle.
/// Threads  `cast` and `cover` use every core inside; make one call at a time.
#pragma once

#include "app/bench/truth/shown_light.h"
#include "app/bench/truth/surface_colour.h"
#include "app/bench/truth/truth_view.h"
#include "app/image/image.h"
#include "assets_baked/bake/source_scene.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>

namespace frustumscreen::bench {

class LitSource;
class TracedMesh;

/// Shape  every image is [projector.height][projector.width].
struct TruthPicture {
    image::Image<std::uint8_t> prop; ///< 1: the ray through the pixel's centre lights the prop (any lit face)
    image::Image<std::uint8_t> hit;  ///< 1: the artifact is seen there
    image::ImageFloat point_m;       ///< hit point, prop frame; NaN = no hit
    image::Image8 colour;            ///< one ray through the centre; sRGB codes
    /// 16 rays, 4 x 4 stratified, misses black, averaged in linear light; at `hit` and the eight pixels
    /// around
    image::Image8 colour16;
    image::Image8 shown16{}; ///< `colour16` in the exhibit's light; empty unless a light was given
    image::Image<std::uint8_t> met_by_16{}; ///< number of these rays that meet the artifact
};

class Truth {
public:
    /// Errors: no triangles; a placement that is not finite; Embree has no memory.
    [[nodiscard]] static Result<Truth> build(std::shared_ptr<const bake::SourceMesh> mesh,
                                             const glm::dmat4& prop_from_artifact,
                                             bake::Sides sides = bake::Sides::Both);
    struct Hit {
        std::uint32_t triangle = 0;
        double u = 0.0, v = 0.0; ///< corner weights (1 - u - v, u, v)
        glm::dvec3 point_m{0.0}; ///< prop frame
        SurfaceColour colour;
    };
    /// First hit of origin + t direction, t > 0 (prop frame).
    [[nodiscard]] bool first_hit(const glm::dvec3& origin, const glm::dvec3& direction, Hit& hit) const;

    /// Casts the whole picture; with `sixteen_rays` false, the images of the 16 rays stay empty. `aim`: the
    /// light of `shown16`; null: it stays empty.
    [[nodiscard]] TruthPicture cast(const geometry::PropShape& prop, const TruthView& view, bool sixteen_rays,
                                    const LightAim* aim = nullptr) const;
    /// The share of each pixel covered by the artifact, from a grid of `rays` columns and rows. Only pixels
    /// crossed by an outline, according to the 16 rays of `picture`, are cast again; the others are 0 or 1.
    [[nodiscard]] image::Image<float> cover(const geometry::PropShape& prop, const TruthView& view,
                                            const TruthPicture& picture, const glm::ivec2& rays) const;

    /// From now on, `cast` with sixteen rays multiplies colours by the museum's light on the same source: for packs
    /// that were baked with light.
    void light_by(std::shared_ptr<const LitSource> lit) { lit_ = std::move(lit); }

    /// The target of the rays, for the ray-cast peer.
    [[nodiscard]] const std::shared_ptr<const TracedMesh>& traced() const { return traced_; }

private:
    class RayCaster;
    explicit Truth(std::shared_ptr<const TracedMesh> traced) : traced_(std::move(traced)) {}
    std::shared_ptr<const TracedMesh> traced_;
    std::shared_ptr<const LitSource> lit_; ///< null: colours are the source's own
};

} // namespace frustumscreen::bench
