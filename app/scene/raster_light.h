/// The projector's light on the reliefs that are rasterized on the processor: the codes that the shaders give a
/// mesh (app/render/shader_source.cpp), computed row by row while the row is in the cache, including
/// feathered edges.
///
/// Colour   sRGB codes in and out; linear light is multiplied, by sRGB's power law, as in the shaders.
/// Pixels   a pixel belongs to the face of the prop under its centre, and goes dark if the plan shows no such
///          relief on that face. Lines are straight in the pixels of the ideal pinhole: a lens that
///          distorts is undone for each pixel.
/// Threads  `begin` on one thread; it allocates nothing for a plan no larger than an earlier one. Then
///          `light` on any, several at once.
/// SIMD     as relief/rasterize_blocks.h.
#pragma once

#include "app/relief/instructions.h"
#include "app/relief/pixel_lens.h"
#include "app/relief/relief_painter.h"
#include "app/scene/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace frustumscreen::scene {

class RasterLight final : public relief::RowLight {
public:
    explicit RasterLight(relief::Instructions instructions = relief::best_instructions())
        : instructions_(instructions) {}

    /// Prepares the light for a picture of the plan's reliefs.
    void begin(const FramePlan& plan);
    /// The largest light of these reliefs, for each channel; the picture gets it here. 1 if all keep their colours.
    [[nodiscard]] const glm::vec3& common_light() const { return common_light_; }
    /// The rest of a relief's light, 0..1.
    [[nodiscard]] glm::vec3 rest_of(const glm::vec3& light) const;
    void light(int y, int first, std::span<glm::u8vec4> codes) const override;

    /// Factors for a face's pixels, as FaceLight; `..._code`: to the power of 1 / 2.4, for multiplying codes.
    struct Gain {
        glm::vec2 ray_per_pixel{0.0F}, first_ray{0.0F}; ///< of an ideal pixel
        glm::vec3 inverse_depth{0.0F, 0.0F, 1.0F};
        float per_cubic_metre = 0.0F, per_cubic_metre_code = 0.0F;
        float most = 1.0F, max_code = 1.0F;
        float brightness = 1.0F, brightness_code = 1.0F;
        bool coloured = false; ///< by the factors that follow
        glm::vec3 light{1.0F}, light_code{1.0F};
    };

    struct Face {
        int face = 0;                     ///< index into FramePlan::faces
        PixelRectangle lit;               ///< the face has no pixels outside this
        std::array<glm::vec3, 4> edges{}; ///< the first ones (relief/raster_view.h)
        geometry::PerCorner<glm::vec3> more_edges{};
        Gain gain;
    };
    /// An EdgeFeather in ideal pixels: functions linear in (x, y, 1) that go from 0 to 1 across it.
    struct Feather {
        int face = 0;
        PixelRectangle lit;
        glm::vec3 along{0.0F}, inward{0.0F};
        glm::vec2 share{1.0F};
    };
    struct Parts {
        relief::PixelLens lens;
        bool changes_codes = false;
        std::vector<Face> faces;
        std::vector<Feather> feathers;
    };

private:
    void add_face(const FramePlan& plan, const Draw& draw, const relief::RasterFace& seen);
    void add_feathers(const FramePlan& plan);

    relief::Instructions instructions_;
    Parts parts_;
    glm::vec3 common_light_{1.0F};
};

} // namespace frustumscreen::scene
