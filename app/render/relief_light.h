/// A torch's plain light on reliefs that were rasterized on the processor, in their codes: the same light as torch_shader.h's, in a
/// fraction of a software driver's time.
///
/// Frames   pixels and nearness: relief/nearness_row.h.
/// Colour   sRGB codes in and out; light is added or laid over in linear light.
/// Threads  const; any. Allocates nothing.
/// SIMD     as relief/rasterize_blocks.h.
#pragma once

#include "app/relief/instructions.h"
#include "app/relief/picture_span.h"
#include "app/scene/frame_plan.h"
#include "app/torch/shadow_map.h"

#include <array>
#include <cstdint>
#include <span>

namespace frustumscreen::render {

/// True if the content is plain light of one colour.
[[nodiscard]] bool is_plain(const scene::PlacedTorch& torch);

/// A torch on a face of a plan, for `is_plain`.
struct PlainLight {
    const scene::FramePlan& plan;
    const scene::TorchFace& face;
    const torch::ShadowMap* shadow; ///< ended; null: it casts none
};

class ReliefLight {
public:
    ReliefLight();
    /// Lights those pixels of the rectangles that lie on the face and in the beam. Both pictures are at least 8
    /// pixels wide.
    void light(const PlainLight& plain, std::span<const PixelRectangle> rectangles,
               const relief::PictureSpan<const float>& nearness,
               const relief::PictureSpan<glm::u8vec4>& codes,
               relief::Instructions instructions = relief::best_instructions()) const;

    static constexpr int roots = 4096;
    struct Codes {
        std::array<float, 256> linear{};      ///< of a code
        std::array<std::uint8_t, roots> of{}; ///< of the square root of linear light, times the last index
    };

private:
    Codes codes_;
};

} // namespace frustumscreen::render
