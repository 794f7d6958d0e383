/// A torch that lights the worlds of a picture: its place, its beam, and what its content is at one time.
///
/// Frames   table T; torch: torch.h.
/// Threads  values; any. The content must outlive the plan.
#pragma once

#include "app/geometry/transform.h"
#include "app/scene/drawable.h"
#include "app/torch/content.h"
#include "app/torch/torch.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace frustumscreen::scene {

struct PlacedTorch {
    geometry::RigidTransform table_from_torch;
    torch::Beam beam;
    torch::Blend blend = torch::Blend::Light;
    std::array<torch::Stage, torch::max_stages>
        stages{}; ///< the first `stage_count`; Stage::item of a layer: index into Drawable::layers
    std::array<torch::StageAt, torch::max_stages> stages_at{};
    std::size_t stage_count = 0;
    TextureId picture = TextureId::None; ///< of the stage that is a picture or a film; one a content
    std::uint32_t picture_version = 0;   ///< another number for another picture: a film's frame
    float brightness = 1.0F;             ///< factor of its light: fades. 0: it is off
    bool casts_shadows = true;           ///< false only to measure their cost
    double scale =
        1.0; ///< of the world that it lights: a window may show it smaller, with the ruler's marks on it
};

/// The parts that drawing its content takes (torch::ContentPart).
[[nodiscard]] std::uint8_t parts_of(const PlacedTorch& torch);

/// The content at a time, placed.
[[nodiscard]] PlacedTorch placed(const torch::Content& content, const torch::Beam& beam,
                                 const geometry::RigidTransform& table_from_torch, double seconds);

} // namespace frustumscreen::scene
