#include "app/programs/preview/turn_pictures.h"

#include "app/programs/preview/preview_view.h"
#include "app/show/offline_renderer.h"

namespace frustumscreen::programs {

namespace {

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
        show::load_offline(pack_file, [&](const pack::PackOutline& outline) -> Result<show::OfflineSetup> {
            TRY(show::OfflineSetup setup, preview_setup(outline.description, options.projected_width));
            for (const geometry::RigidTransform& prop : props) {
                setup.options.views.push_back({prop, setup.settings->eye.default_m});
            }
            return setup;
        });
    TRY_VOID(scene);
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(*scene));
    simulation::VisitorScene visitor = preview_visitor(*scene->setup.settings, renderer->projector());
    const simulation::VisitorCamera camera = preview_camera(visitor, props, turn.size);
    turn.sheet = image::Image8(turn.columns * turn.size.x, turn.rows * turn.size.y);
    turn.marks.resize(scene->pack->hotspots.size());
    for (int k = 0; k < turn.frames; ++k) {
        visitor.table_from_prop = props[static_cast<std::size_t>(k)];
        const image::Image8 projected = renderer->draw(visitor.table_from_prop, visitor.eye_m).colour;
        put_in_sheet(preview_picture(visitor, projected, camera), k % turn.columns, k / turn.columns,
                     turn.sheet);
        for (std::size_t each = 0; each < turn.marks.size(); ++each) {
            turn.marks[each].push_back(mark_of(scene->pack->hotspots[each], scene->plan.metres_per_box,
                                               visitor.table_from_prop, camera));
        }
        options.progress("the visitor's view", (k + 1.0) / turn.frames);
    }
    return turn;
}

} // namespace frustumscreen::programs
