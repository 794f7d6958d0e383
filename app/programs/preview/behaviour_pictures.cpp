#include "app/programs/preview/behaviour_pictures.h"

#include "app/programs/preview/preview_view.h"
#include "app/show/offline_renderer.h"

namespace frustumscreen::programs {

namespace {

constexpr int frames = 8;
constexpr double seconds_of_none = 1.0; ///< for a behaviour that states no time

Result<BehaviourPictures> draw(const std::filesystem::path& pack_file, const pack::PackBehaviour& behaviour,
                               const TurnOptions& options) {
    const Result<show::OfflineScene> scene =
        show::load_offline(pack_file, [&](const pack::PackOutline& outline) -> Result<show::OfflineSetup> {
            TRY(show::OfflineSetup setup, preview_setup(outline.description, options.projected_width));
            setup.options.behaviour = behaviour.behaviour.name;
            return setup;
        });
    TRY_VOID(scene);
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(*scene));
    const double seconds = behaviour.behaviour.seconds > 0.0 ? behaviour.behaviour.seconds : seconds_of_none;
    BehaviourPictures pictures{.behaviour = behaviour,
                               .frames = frames,
                               .step_s = seconds / (frames - 1),
                               .size = options.size / 2,
                               .sheet = {}};
    const simulation::VisitorScene visitor = preview_visitor(*scene->setup.settings, renderer->projector());
    const simulation::VisitorCamera camera =
        preview_camera(visitor, turned_props(options.columns * options.rows), pictures.size);
    pictures.sheet = image::Image8(frames * pictures.size.x, pictures.size.y);
    for (int k = 0; k < frames; ++k) {
        const image::Image8 projected =
            renderer->draw(visitor.table_from_prop, std::span(&visitor.eye_m, 1), k * pictures.step_s).colour;
        put_in_sheet(preview_picture(visitor, projected, camera), k, 0, pictures.sheet);
        options.progress("behaviour " + behaviour.behaviour.name, (k + 1.0) / frames);
    }
    return pictures;
}

} // namespace

Result<std::vector<BehaviourPictures>> behaviour_pictures(const std::filesystem::path& pack_file,
                                                          const TurnOptions& options) {
    TRY(const pack::PackWorld world, pack::load_world(pack_file));
    std::vector<BehaviourPictures> drawn;
    for (const pack::PackBehaviour& behaviour : world.behaviours) {
        TRY(BehaviourPictures pictures, draw(pack_file, behaviour, options));
        drawn.push_back(std::move(pictures));
    }
    return drawn;
}

} // namespace frustumscreen::programs
