#include "app/programs/preview/turn_pictures.h"

#include "app/settings/settings.h"
#include "app/show/offline_renderer.h"
#include "app/simulation/visitor_view.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen {

namespace {

constexpr double used_share = 0.94; ///< share of the picture that the prop's outline may fill
constexpr int rays_per_side = 2;

/// The shipped settings, with the prop at the table's centre.
constexpr std::string_view frustum_table = "[tracker]\nkind = \"none\"\n";
constexpr std::string_view cube_table =
    "[projector]\nposition_m = [0.0, -0.9, 1.2]\naim_m = [0.0, 0.0, 0.06]\nfx = 4200.0\n"
    "[prop]\nkind = \"cube\"\nbase_m = 0.16\nzone = \"table\"\n[tracker]\nkind = \"none\"\n";

std::vector<RigidTransform> turned_props(int count) {
    std::vector<RigidTransform> props(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        props[static_cast<std::size_t>(k)].rotation = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
    }
    return props;
}

Result<OfflineSetup> setup_of(const PackOutline& outline, const std::vector<RigidTransform>& props,
                              int projected_width) {
    const bool is_cube = outline.description.prop_kind == name_of(PropKind::Cube);
    TRY(CheckedSettings settings, parse_settings(is_cube ? cube_table : frustum_table, "preview"));
    const Pinhole& projector = settings->projector.pinhole;
    OfflineOptions options;
    options.technique = "finest";
    options.width = projected_width;
    options.height = projected_width * projector.height / projector.width;
    for (const RigidTransform& prop : props) {
        options.views.push_back({prop, settings->eye.default_m});
    }
    return OfflineSetup{std::move(settings), std::move(options)};
}

VisitorScene visitor_scene(const Settings& settings, const Pinhole& projector) {
    return {projector,
            settings.projector.table_from_projector,
            make_prop(settings.prop),
            RigidTransform(),
            settings.eye.default_m,
            {settings.table.width_m, settings.table.depth_m}};
}

/// One camera for all pictures; the prop's outline is as large as it fits.
VisitorCamera camera_for(const VisitorScene& scene, const std::vector<RigidTransform>& props,
                         const glm::ivec2& size) {
    VisitorCamera camera = visitor_camera(scene.prop, RigidTransform(), scene.eye_m, size.x, size.y);
    const RigidTransform camera_from_table = camera.table_from_camera.inverse();
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const RigidTransform& table_from_prop : props) {
        for (const glm::dvec3& corner : scene.prop.corners) {
            const auto pixel = camera.pinhole.pixel(camera_from_table.point(table_from_prop.point(corner)));
            low = glm::min(low, pixel.value_or(low));
            high = glm::max(high, pixel.value_or(high));
        }
    }
    Pinhole& pinhole = camera.pinhole;
    const glm::dvec2 room = used_share * glm::dvec2(size) / glm::max(high - low, glm::dvec2(1.0));
    const double zoom = std::min(room.x, room.y);
    const glm::dvec2 middle(0.5 * (low + high));
    pinhole.fx *= zoom;
    pinhole.fy *= zoom;
    pinhole.cx = 0.5 * size.x + zoom * (pinhole.cx - middle.x);
    pinhole.cy = 0.5 * size.y + zoom * (pinhole.cy - middle.y);
    return camera;
}

void put(const Image8& picture, int column, int row, Image8& sheet) {
    for (int y = 0; y < picture.height; ++y) {
        const auto from = picture.texels.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
        std::copy(from, from + picture.width, &sheet.at(column * picture.width, row * picture.height + y));
    }
}

MarkPlace mark_of(const PackHotspot& hotspot, double metres_per_box, const RigidTransform& table_from_prop,
                  const VisitorCamera& camera) {
    const glm::dvec3 point = table_from_prop.point(metres_per_box * hotspot.point);
    const glm::dvec3 normal = table_from_prop.direction(hotspot.normal);
    const auto pixel = camera.pinhole.pixel(camera.table_from_camera.inverse().point(point));
    if (!pixel) {
        return {};
    }
    return {pixel->x / camera.pinhole.width, pixel->y / camera.pinhole.height,
            glm::dot(normal, camera.table_from_camera.translation - point) > 0.0};
}

} // namespace

Result<TurnPictures> turn_pictures(const std::filesystem::path& pack_file, const TurnOptions& options) {
    TurnPictures turn{options.columns, options.rows, options.columns * options.rows, options.size, {}, {}};
    const std::vector<RigidTransform> props = turned_props(turn.frames);
    const Result<OfflineScene> scene = load_offline(pack_file, [&](const PackOutline& outline) {
        return setup_of(outline, props, options.projected_width);
    });
    TRY_VOID(scene);
    TRY(const std::unique_ptr<OfflineRenderer> renderer, OfflineRenderer::create(*scene));
    VisitorScene visitor = visitor_scene(*scene->setup.settings, renderer->projector());
    const VisitorCamera camera = camera_for(visitor, props, turn.size);
    turn.sheet = Image8(turn.columns * turn.size.x, turn.rows * turn.size.y);
    turn.marks.resize(scene->pack->hotspots.size());
    for (int k = 0; k < turn.frames; ++k) {
        visitor.table_from_prop = props[static_cast<std::size_t>(k)];
        const Image8 projected = renderer->draw(visitor.table_from_prop, visitor.eye_m).colour;
        put(visitor_view(visitor, projected, camera, {true, rays_per_side, false}), k % turn.columns,
            k / turn.columns, turn.sheet);
        for (std::size_t each = 0; each < turn.marks.size(); ++each) {
            turn.marks[each].push_back(mark_of(scene->pack->hotspots[each], scene->plan.metres_per_box,
                                               visitor.table_from_prop, camera));
        }
        options.progress("the visitor's view", (k + 1.0) / turn.frames);
    }
    return turn;
}

} // namespace frustumscreen
