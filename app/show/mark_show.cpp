#include "app/show/mark_show.h"

#include "app/scene/scene_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::show {

namespace {

constexpr int texels = 32;

/// Bright in the middle, dark at the rim, without an edge: this gives the most accurate centre.
image::Image<std::uint8_t> soft_disc() {
    image::Image<std::uint8_t> disc(texels, texels);
    for (int v = 0; v < texels; ++v) {
        for (int u = 0; u < texels; ++u) {
            const double from_middle =
                std::hypot(u + 0.5 - 0.5 * texels, v + 0.5 - 0.5 * texels) / (0.5 * texels);
            const double light = 0.5 + 0.5 * std::cos(std::numbers::pi * std::fmin(1.0, from_middle));
            disc.at(u, v) = static_cast<std::uint8_t>(std::lround(255.0 * light));
        }
    }
    return disc;
}

bool is_apart(const typography::TableRectangle& mark, const typography::TableRectangle& other) {
    constexpr double between_m = 0.004;
    return typography::clearance(mark.corners(), other.corners()) > between_m;
}

} // namespace

bool has_space_for_mark(const glm::dvec2& place_m, const exhibit::Presentation& presentation, double prop_m) {
    const typography::TableRectangle mark{place_m, glm::dvec2(mark_size_m), 0};
    bool free =
        glm::distance(place_m, glm::dvec2(presentation.table_from_prop.translation)) > prop_m + mark_size_m;
    free = free && (!presentation.caption || is_apart(mark, presentation.caption->rectangle));
    free = free && (!presentation.advice || is_apart(mark, presentation.advice->rectangle));
    free = free && (!presentation.notice || is_apart(mark, presentation.notice->rectangle));
    if (presentation.table != nullptr) {
        const auto pictures = presentation.table->pictures();
        free =
            free && std::all_of(pictures.begin(), pictures.end(), [&](const exhibit::PlacedPicture& picture) {
                return picture.brightness <= 0.0 || is_apart(mark, picture.place.whole());
            });
    }
    return free;
}

Result<void> MarkShow::prepare(render::GpuStore& store) {
    return store.upload(soft_disc()).map([&](scene::TextureId texture) { texture_ = texture; });
}

void MarkShow::place(const std::optional<drift::ShownMark>& mark, residency::OnTable& on_table) const {
    if (mark && texture_ != scene::TextureId::None) {
        on_table.add({.corners_m = residency::picture_corners({mark->place_m, glm::dvec2(mark_size_m), 0}),
                      .brightness = mark_brightness * mark->brightness,
                      .texture = texture_});
    }
}

std::uint64_t MarkShow::planned_gpu_bytes() const {
    return texture_ != scene::TextureId::None ? scene::caption_gpu_bytes(texels, texels) : 0;
}

} // namespace frustumscreen::show
