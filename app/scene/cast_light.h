/// The projector's light on a relief that is cast: the codes that the shaders give a mesh (app/render/shader_source.cpp), made a row
/// at a time while the painter has it at hand. Feathered edges are in them.
///
/// Colour   sRGB codes in and out; linear light is multiplied, by sRGB's power law, exactly near black.
/// Pixels   one belongs to the face of the prop that its middle lies on, and goes dark if the plan shows the cast on none there.
/// Threads  `begin`, which allocates nothing for a plan as large as one before: one; then `light`: any, several at once.
/// SIMD     as relief/cast_blocks.h.
#pragma once

#include "app/relief/relief_painter.h"
#include "app/scene/frame_plan.h"

#include <array>
#include <span>
#include <vector>

namespace frustumscreen {

class CastLight final : public RowLight {
public:
    /// Of one of the plan's casts.
    void begin(const FramePlan& plan, std::size_t cast);
    void light(int y, int first, std::span<glm::u8vec4> codes) const override;

    /// What a face's pixels are multiplied by, as FaceLight; `..._code`: to the power of 1 / 2.4, with which codes are multiplied.
    struct Gain {
        glm::vec2 ray_per_pixel{0.0F}, first_ray{0.0F}; ///< of a pixel's middle
        glm::vec3 inverse_depth{0.0F, 0.0F, 1.0F};
        float per_cubic_metre = 0.0F, per_cubic_metre_code = 0.0F;
        float most = 1.0F, most_code = 1.0F;
        float brightness = 1.0F, brightness_code = 1.0F;
    };

private:
    struct Face {
        int face = 0;                      ///< index into FramePlan::faces
        std::array<glm::dvec3, 4> edges{}; ///< as CastFace
        Gain gain;
    };
    /// An EdgeFeather in pixels: what is linear in (x, y, 1) goes from 0 to 1 over it.
    struct Feather {
        int face = 0;
        glm::dvec3 along{0.0}, inward{0.0};
        glm::vec2 share{1.0F};
    };
    void soften(const Feather& feather, int y, int first, std::span<glm::u8vec4> codes) const;

    std::vector<Face> faces_;
    std::vector<Feather> feathers_;
    bool changes_codes_ = false;
};

} // namespace frustumscreen
