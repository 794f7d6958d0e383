#include "app/scene/prop_outline.h"

#include "app/scene/face_view.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>

namespace frustumscreen::scene {

PixelRectangle prop_bounds(const geometry::PropShape& prop, const geometry::Pinhole& projector,
                           const glm::dmat4& clip_from_prop) {
    std::array<glm::dvec4, geometry::max_corners> clip{};
    const std::size_t count = prop.corners.size();
    assert(count <= clip.size());
    for (std::size_t k = 0; k < count; ++k) {
        clip[k] = clip_from_prop * glm::dvec4(prop.corners[k], 1.0);
    }
    return pixels_around(std::span(clip).first(count), projector);
}

std::optional<PixelSize> largest_outline(const settings::Settings& settings,
                                         const geometry::Pinhole& projector, const Visibility& visibility) {
    constexpr int places = 13; // along each side of the table, including its middle and its corners
    constexpr int yaws_of_quarter = 32;
    constexpr int margin = 16;
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const int yaws = yaws_of_quarter * geometry::quarters_to_same(prop);
    const glm::dmat4 clip_from_table =
        projector.clip_from_point() * settings.projector.table_from_projector.inverse().matrix();
    PixelSize largest;
    const auto add = [&](const geometry::RigidTransform& table_from_prop) {
        const PixelRectangle part = prop_bounds(prop, projector, clip_from_table * table_from_prop.matrix());
        largest = united(largest, {part.width, part.height});
    };
    if (!visibility.views.empty()) {
        for (const KnownView& view : visibility.views) {
            add(view.table_from_prop);
        }
    } else if (settings.prop.zone == settings::PropZone::Hand) {
        return std::nullopt;
    } else {
        for (int place = 0; place < places * places; ++place) {
            const glm::dvec2 share = glm::dvec2(place % places, place / places) / (places - 1.0) - 0.5;
            const glm::dvec3 at(share.x * settings.table.width_m, share.y * settings.table.depth_m, 0.0);
            for (int yaw = 0; yaw < yaws; ++yaw) {
                const double angle = yaw * std::numbers::pi / (2.0 * yaws_of_quarter);
                add({glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0)), at});
            }
        }
    }
    return PixelSize{std::min(largest.width + margin, projector.width),
                     std::min(largest.height + margin, projector.height)};
}

} // namespace frustumscreen::scene
