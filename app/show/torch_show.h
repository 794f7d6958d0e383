/// Torches in the picture: their contents on the artifact, and faint spots on the table that show people where the beams
/// meet it.
///
/// Frames   table T.
/// Threads  the render thread. Allocates nothing after `prepare`.
/// Errors   the driver has no memory.
#pragma once

#include "app/exhibit/presentation.h"
#include "app/render/gpu_store.h"
#include "app/residency/on_table.h"
#include "app/residency/torch_contents.h"
#include "app/scene/placed_torch.h"
#include "app/settings/settings.h"
#include "app/show/show.h"

#include <array>
#include <cstdint>
#include <span>

namespace frustumscreen::show {

class TorchShow {
public:
    /// A share of the projector's light; a spot is a hint and no picture.
    static constexpr double spot_brightness = 0.03;

    explicit TorchShow(const settings::TorchSettings& torch) : beam_(torch.beam) {}
    /// Uploads the picture of a spot.
    [[nodiscard]] Result<void> prepare(render::GpuStore& store);
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;
    [[nodiscard]] scene::TextureId spot() const { return spot_; }

    /// Adds the spots of torches that are there.
    void place_spots(const exhibit::Presentation& presentation, residency::OnTable& on_table) const;
    /// The lights' contents, as they are in `contents`, which has been stepped; valid until the next call.
    [[nodiscard]] std::span<const scene::PlacedTorch> place(const exhibit::Presentation& presentation,
                                                            const residency::TorchContents& contents);
    /// Plain light at a place above the table, to draw one frame with.
    [[nodiscard]] std::span<const scene::PlacedTorch> sample(const glm::dvec2& place_m);

private:
    torch::Beam beam_;
    torch::Content white_ = torch::white();
    scene::TextureId spot_ = scene::TextureId::None;
    std::array<scene::PlacedTorch, torch::max_torches> placed_{};
};

/// For the status. `contents`: null: packs have none.
[[nodiscard]] ShownTorch shown_torch(const exhibit::Presentation& presentation,
                                     const residency::TorchContents* contents);

[[nodiscard]] status::TorchReport torch_report(const ShownTorch& shown,
                                               std::span<const tracking::TrackedTorch> torches);

/// The lights' contents, for TorchContents::step.
struct WantedContents {
    std::array<residency::WantedContent, torch::max_torches> contents{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const residency::WantedContent> all() const {
        return std::span(contents).first(count);
    }
};
[[nodiscard]] WantedContents wanted_contents(const exhibit::Presentation& presentation,
                                             const residency::TorchContents& contents);

} // namespace frustumscreen::show
