#include "app/programs/preview/preview_view.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <limits>
#include <numbers>

namespace frustumscreen::programs {

namespace {

constexpr double used_share = 0.94; ///< share of the picture that the prop's outline may fill
constexpr int rays_per_side = 2;

/// The shipped settings, with the prop at the table's centre.
constexpr std::string_view frustum_table = "[tracker]\nkind = \"none\"\n";
constexpr std::string_view cube_table =
    "[projector]\nposition_m = [0.0, -0.9, 1.2]\naim_m = [0.0, 0.0, 0.06]\nfx = 4200.0\n"
    "[prop]\nkind = \"cube\"\nbase_m = 0.16\nzone = \"table\"\n[tracker]\nkind = \"none\"\n";

} // namespace

std::vector<geometry::RigidTransform> turned_props(int count) {
    std::vector<geometry::RigidTransform> props(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        props[static_cast<std::size_t>(k)].rotation = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
    }
    return props;
}

Result<show::OfflineSetup> preview_setup(const pack::PackDescription& pack, int projected_width) {
    const bool is_cube = pack.prop_kind == settings::name_of(settings::PropKind::Cube);
    TRY(settings::CheckedSettings settings,
        settings::parse_settings(is_cube ? cube_table : frustum_table, "preview"));
    const geometry::Pinhole& projector = settings->projector.pinhole;
    show::OfflineOptions options;
    options.technique = "finest";
    options.width = projected_width;
    options.height = projected_width * projector.height / projector.width;
    return show::OfflineSetup{std::move(settings), std::move(options)};
}

simulation::VisitorScene preview_visitor(const settings::Settings& settings,
                                         const geometry::Pinhole& projector) {
    return {.projector = projector,
            .table_from_projector = settings.projector.table_from_projector,
            .prop = settings::make_prop(settings.prop),
            .table_from_prop = geometry::RigidTransform(),
            .eye_m = settings.eye.default_m,
            .table_size_m = {settings.table.width_m, settings.table.depth_m}};
}

simulation::VisitorCamera preview_camera(const simulation::VisitorScene& scene,
                                         const std::vector<geometry::RigidTransform>& props,
                                         const glm::ivec2& size) {
    simulation::VisitorCamera camera =
        simulation::visitor_camera(scene.prop, geometry::RigidTransform(), scene.eye_m, size.x, size.y);
    const geometry::RigidTransform camera_from_table = camera.table_from_camera.inverse();
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const geometry::RigidTransform& table_from_prop : props) {
        for (const glm::dvec3& corner : scene.prop.corners) {
            const auto pixel = camera.pinhole.pixel(camera_from_table.point(table_from_prop.point(corner)));
            low = glm::min(low, pixel.value_or(low));
            high = glm::max(high, pixel.value_or(high));
        }
    }
    geometry::Pinhole& pinhole = camera.pinhole;
    const glm::dvec2 frame = used_share * glm::dvec2(size) / glm::max(high - low, glm::dvec2(1.0));
    const double zoom = std::min(frame.x, frame.y);
    const glm::dvec2 middle(0.5 * (low + high));
    pinhole.fx *= zoom;
    pinhole.fy *= zoom;
    pinhole.cx = 0.5 * size.x + zoom * (pinhole.cx - middle.x);
    pinhole.cy = 0.5 * size.y + zoom * (pinhole.cy - middle.y);
    return camera;
}

image::Image8 preview_picture(const simulation::VisitorScene& visitor, const image::Image8& projected,
                              const simulation::VisitorCamera& camera) {
    return simulation::visitor_view(visitor, projected, camera, {true, rays_per_side, false});
}

void put_in_sheet(const image::Image8& picture, int column, int row, image::Image8& sheet) {
    for (int y = 0; y < picture.height; ++y) {
        const auto from = picture.texels.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
        std::copy(from, from + picture.width, &sheet.at(column * picture.width, row * picture.height + y));
    }
}

} // namespace frustumscreen::programs
