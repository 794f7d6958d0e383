#include "app/programs/preview/turn_pictures.h"

#include "app/settings/settings.h"
#include "app/show/offline_renderer.h"
#include "app/simulation/visitor_view.h"

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

std::vector<geometry::RigidTransform> turned_props(int count) {
    std::vector<geometry::RigidTransform> props(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        props[static_cast<std::size_t>(k)].rotation = glm::angleAxis(angle, glm::dvec3(0, 0, 1));
    }
    return props;
}

Result<show::OfflineSetup> setup_of(const pack::PackOutline& outline,
                                    const std::vector<geometry::RigidTransform>& props, int projected_width) {
    const bool is_cube = outline.description.prop_kind == settings::name_of(settings::PropKind::Cube);
    TRY(settings::CheckedSettings settings,
        settings::parse_settings(is_cube ? cube_table : frustum_table, "preview"));
    const geometry::Pinhole& projector = settings->projector.pinhole;
    show::OfflineOptions options;
    options.technique = "finest";
    options.width = projected_width;
    options.height = projected_width * projector.height / projector.width;
    for (const geometry::RigidTransform& prop : props) {
        options.views.push_back({prop, settings->eye.default_m});
    }
    return show::OfflineSetup{std::move(settings), std::move(options)};
}

simulation::VisitorScene visitor_scene(const settings::Settings& settings,
                                       const geometry::Pinhole& projector) {
    return {.projector = projector,
            .table_from_projector = settings.projector.table_from_projector,
            .prop = settings::make_prop(settings.prop),
            .table_from_prop = geometry::RigidTransform(),
            .eye_m = settings.eye.default_m,
            .table_size_m = {settings.table.width_m, settings.table.depth_m}};
}

/// One camera for all pictures; the prop's outline is as large as it fits.
simulation::VisitorCamera camera_for(const simulation::VisitorScene& scene,
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

void put(const image::Image8& picture, int column, int row, image::Image8& sheet) {
    for (int y = 0; y < picture.height; ++y) {
        const auto from = picture.texels.begin() + static_cast<std::ptrdiff_t>(y) * picture.width;
        std::copy(from, from + picture.width, &sheet.at(column * picture.width, row * picture.height + y));
    }
}

MarkPlace mark_of(const pack::PackHotspot& hotspot, double metres_per_box,
                  const geometry::RigidTransform& table_from_prop, const simulation::VisitorCamera& camera) {
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
    TurnPictures turn{.columns = options.columns,
                      .rows = options.rows,
                      .frames = options.columns * options.rows,
                      .size = options.size,
                      .sheet = {},
                      .marks = {}};
    const std::vector<geometry::RigidTransform> props = turned_props(turn.frames);
    const Result<show::OfflineScene> scene =
        show::load_offline(pack_file, [&](const pack::PackOutline& outline) {
            return setup_of(outline, props, options.projected_width);
        });
    TRY_VOID(scene);
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(*scene));
    simulation::VisitorScene visitor = visitor_scene(*scene->setup.settings, renderer->projector());
    const simulation::VisitorCamera camera = camera_for(visitor, props, turn.size);
    turn.sheet = image::Image8(turn.columns * turn.size.x, turn.rows * turn.size.y);
    turn.marks.resize(scene->pack->hotspots.size());
    for (int k = 0; k < turn.frames; ++k) {
        visitor.table_from_prop = props[static_cast<std::size_t>(k)];
        const image::Image8 projected = renderer->draw(visitor.table_from_prop, visitor.eye_m).colour;
        put(simulation::visitor_view(visitor, projected, camera, {true, rays_per_side, false}),
            k % turn.columns, k / turn.columns, turn.sheet);
        for (std::size_t each = 0; each < turn.marks.size(); ++each) {
            turn.marks[each].push_back(mark_of(scene->pack->hotspots[each], scene->plan.metres_per_box,
                                               visitor.table_from_prop, camera));
        }
        options.progress("the visitor's view", (k + 1.0) / turn.frames);
    }
    return turn;
}

} // namespace frustumscreen::programs
