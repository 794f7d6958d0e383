#include "app/residency/hotspot_show.h"

#include "app/scene/scene_level.h"

#include <algorithm>
#include <array>
#include <memory>

namespace frustumscreen::residency {

namespace {

constexpr double line_width_m = 0.0015;
constexpr double soft_m = 0.0005;      ///< width of the soft edge on each side of a line
constexpr double from_label_m = 0.002; ///< between the line and the letters

/// Profile across a line: bright in the middle, dark at the edges.
image::Image<std::uint8_t> line_picture() {
    constexpr std::array<std::uint8_t, 8> across{0, 130, 255, 255, 255, 255, 130, 0};
    image::Image<std::uint8_t> picture(1, static_cast<int>(across.size()));
    std::copy(across.begin(), across.end(), picture.texels.begin());
    return picture;
}

/// The level's triangles in the box frame.
geometry::TriangleTree tree_of(const pack::PackLevel& level, const glm::dvec3& box_size) {
    constexpr double max_code = 65535.0;
    std::vector<glm::vec3> positions;
    positions.reserve(level.vertices.size());
    for (const pack::PackVertex& vertex : level.vertices) {
        const glm::dvec3 share =
            glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]) / max_code;
        positions.emplace_back((share - glm::dvec3(0.5, 0.5, 0.0)) * box_size);
    }
    return {positions, level.indices};
}

} // namespace

exhibit::ArtifactTriangles hiding_triangles(const pack::PackLevel& level, const glm::dvec3& box_size,
                                            double metres_per_box) {
    return {std::make_shared<const geometry::TriangleTree>(tree_of(level, box_size)),
            metres_per_box * static_cast<double>(level.error.max_box)};
}

Result<HotspotShow> HotspotShow::create(render::GpuStore& store) {
    const image::Image<std::uint8_t> picture = line_picture();
    TRY(const scene::TextureId line, store.upload(picture));
    HotspotShow show;
    show.line_ = line;
    show.planned_gpu_bytes_ = scene::caption_gpu_bytes(picture.width, picture.height);
    return show;
}

void HotspotShow::place(const exhibit::PresentedHotspot& hotspot, scene::TextureId label, double brightness,
                        const geometry::Pinhole& projector,
                        const geometry::RigidTransform& table_from_projector, OnTable& on_table) const {
    exhibit::LeaderLine line = hotspot.line.value_or(exhibit::LeaderLine{});
    if (line.count > 1) {
        glm::dvec2& end = line.points_m[line.count - 1];
        const glm::dvec2 back = line.points_m[line.count - 2] - end;
        end += back * std::min(0.5, from_label_m / glm::length(back));
    }
    const std::span<const glm::dvec2> points = line.points();
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const glm::dvec2 along = glm::normalize(points[k + 1] - points[k]);
        const glm::dvec2 side = glm::dvec2(-along.y, along.x) * (0.5 * line_width_m + soft_m);
        on_table.add({.corners_m = flat_corners(
                          {points[k] + side, points[k + 1] + side, points[k + 1] - side, points[k] - side}),
                      .brightness = brightness * hotspot.brightness,
                      .texture = line_});
    }
    on_table.add({.corners_m = picture_corners(on_pixels(hotspot.label, projector, table_from_projector)),
                  .brightness = brightness * hotspot.brightness,
                  .texture = label});
}

} // namespace frustumscreen::residency
