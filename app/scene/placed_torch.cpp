#include "app/scene/placed_torch.h"

#include <algorithm>
#include <span>

namespace frustumscreen::scene {

std::uint8_t parts_of(const PlacedTorch& torch) {
    const unsigned bare = torch.casts_shadows ? 0U : unsigned{torch::BarePart};
    return static_cast<std::uint8_t>(
        bare | torch::parts_of(std::span(torch.stages).first(torch.stage_count), torch.blend));
}

PlacedTorch placed(const torch::Content& content, const torch::Beam& beam,
                   const geometry::RigidTransform& table_from_torch, double seconds) {
    PlacedTorch torch{.table_from_torch = table_from_torch, .beam = beam, .blend = content.blend};
    torch.beam.shape = content.shape.value_or(beam.shape);
    torch.beam.height_per_width = content.height_per_width;
    torch.stage_count = std::min(content.stages.size(), torch.stages.size());
    for (std::size_t k = 0; k < torch.stage_count; ++k) {
        torch.stages[k] = content.stages[k];
        torch.stages_at[k] = torch::stage_at(content.stages[k], content.height_per_width, seconds);
    }
    return torch;
}

} // namespace frustumscreen::scene
