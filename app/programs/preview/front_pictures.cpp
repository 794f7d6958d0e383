#include "app/programs/preview/front_pictures.h"

#include "app/programs/preview/preview_view.h"
#include "app/show/offline_renderer.h"

namespace frustumscreen::programs {

Result<FrontPictures> front_pictures(const std::filesystem::path& pack_file, const TurnOptions& options,
                                     const std::function<void(show::OfflineOptions&)>& change,
                                     std::span<const double> times_s,
                                     const std::function<void(double)>& drawn) {
    const Result<show::OfflineScene> scene =
        show::load_offline(pack_file, [&](const pack::PackOutline& outline) -> Result<show::OfflineSetup> {
            TRY(show::OfflineSetup setup, preview_setup(outline.description, options.projected_width));
            change(setup.options);
            return setup;
        });
    TRY_VOID(scene);
    TRY(const std::unique_ptr<show::OfflineRenderer> renderer, show::OfflineRenderer::create(*scene));
    FrontPictures pictures{.size = options.size / 2, .sheet = {}};
    const simulation::VisitorScene visitor = preview_visitor(*scene->setup.settings, renderer->projector());
    const simulation::VisitorCamera camera =
        preview_camera(visitor, turned_props(options.columns * options.rows), pictures.size);
    const int count = static_cast<int>(times_s.size());
    pictures.sheet = image::Image8(count * pictures.size.x, pictures.size.y);
    for (int k = 0; k < count; ++k) {
        const image::Image8 projected = renderer
                                            ->draw(visitor.table_from_prop, std::span(&visitor.eye_m, 1),
                                                   times_s[static_cast<std::size_t>(k)])
                                            .colour;
        put_in_sheet(preview_picture(visitor, projected, camera), k, 0, pictures.sheet);
        drawn((k + 1.0) / count);
    }
    return pictures;
}

} // namespace frustumscreen::programs
