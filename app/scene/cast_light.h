/// The projector's light on a relief that is cast: the codes that the shaders give a mesh (app/render/shader_source.cpp), made a row
/// at a time while the painter has it at hand. Feathered edges are in them.
///
/// Colour   sRGB codes in and out; linear light is multiplied, by sRGB's power law, as the shaders do.
/// Pixels   one belongs to the face of the prop that its middle lies on, and goes dark if the plan shows the cast on none there. Lines are
///          straight in those of the ideal pinhole: a lens that distorts is taken back for each pixel.
/// Threads  `begin`, which allocates nothing for a plan as large as one before: one; then `light`: any, several at once.
/// SIMD     as relief/cast_blocks.h.
#pragma once

#include "app/relief/instructions.h"
#include "app/relief/pixel_lens.h"
#include "app/relief/relief_painter.h"
#include "app/scene/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace frustumscreen {

class CastLight final : public RowLight {
public:
    explicit CastLight(Instructions instructions = best_instructions()) : instructions_(instructions) {}

    /// Of one of the plan's casts.
    void begin(const FramePlan& plan, std::size_t cast);
    void light(int y, int first, std::span<glm::u8vec4> codes) const override;

    /// What a face's pixels are multiplied by, as FaceLight; `..._code`: to the power of 1 / 2.4, with which codes are multiplied.
    struct Gain {
        glm::vec2 ray_per_pixel{0.0F}, first_ray{0.0F}; ///< of an ideal pixel
        glm::vec3 inverse_depth{0.0F, 0.0F, 1.0F};
        float per_cubic_metre = 0.0F, per_cubic_metre_code = 0.0F;
        float most = 1.0F, most_code = 1.0F;
        float brightness = 1.0F, brightness_code = 1.0F;
    };

    struct Face {
        int face = 0;                     ///< index into FramePlan::faces
        PixelRectangle lit;               ///< no other pixels are its own
        std::array<glm::vec3, 4> edges{}; ///< as CastFace
        Gain gain;
    };
    /// An EdgeFeather in ideal pixels: what is linear in (x, y, 1) goes from 0 to 1 over it.
    struct Feather {
        int face = 0;
        PixelRectangle lit;
        glm::vec3 along{0.0F}, inward{0.0F};
        glm::vec2 share{1.0F};
    };
    struct Parts {
        PixelLens lens;
        bool changes_codes = false;
        std::vector<Face> faces;
        std::vector<Feather> feathers;
    };

private:
    Instructions instructions_;
    Parts parts_;
};

} // namespace frustumscreen
