/// RoomShow: what happens once, at the start: packs are opened, space is reserved, and this GPU is measured.
#include "app/room/room_file.h"
#include "app/show/room_costs.h"
#include "app/show/room_show.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

namespace {

/// Upper limit for the indices in the plan of one eye's picture.
constexpr std::size_t max_plan_indices = 24'000'000;

/// Meshes and reliefs of any pack, and their fades.
scene::RenderNeeds needs_of(int samples) {
    scene::RenderNeeds needs{.samples = samples, .draws = {scene::raster_shader()}, .rasterizes = true};
    for (const bool cut_out : {false, true}) {
        for (const bool dithered : {false, true}) {
            needs.draws.insert({.cut_out = cut_out, .dithered = dithered});
        }
    }
    needs.interlocks = true;
    return needs;
}

scene::StereoLayout layout_of(const settings::Settings& settings, const scene::FlatScreen& screen,
                              bool both_eyes) {
    return scene::stereo_layout(screen.pinhole,
                                both_eyes ? settings::screen_stereo_of(settings) : settings::Stereo::Off);
}

scene::FlatScreen screen_of(const settings::ScreenSettings& screen) {
    return scene::flat_screen(screen.corners_m, screen.width, screen.height);
}

std::vector<glm::dvec3> box_sizes(std::span<const std::optional<residency::KnownModel>> models) {
    std::vector<glm::dvec3> sizes;
    for (const std::optional<residency::KnownModel>& model : models) {
        sizes.push_back(model ? model->box_size : glm::dvec3(1.0));
    }
    return sizes;
}

std::size_t quality_level_count(std::span<const std::optional<residency::KnownModel>> models,
                                std::size_t model) {
    return models[model] ? models[model]->quality_levels.size() : 0;
}

} // namespace

Result<RoomShow::Opened> RoomShow::open(const room::Room& room, bool live) {
    Opened opened;
    for (const std::filesystem::path& file : room.packs) {
        Result<residency::KnownModel> model = residency::know_model(file);
        if (!model && !live) {
            return tl::unexpected<Error>(model.error());
        }
        if (!model) {
            opened.faults.push_back(model.error().message);
        }
        opened.models.push_back(model ? std::optional(*std::move(model)) : std::nullopt);
    }
    return opened;
}

RoomShow::RoomShow(const settings::Settings& settings, const RoomShowOptions& options, room::Room room,
                   render::Renderer renderer, Opened opened)
    : options_(options), room_(std::move(room)), screen_(screen_of(settings.screen)),
      layout_(layout_of(settings, screen_, options.both_eyes)),
      tolerance_px_(settings.render.error_tolerance_px), renderer_(std::move(renderer)),
      faults_(std::move(opened.faults)), view_(room_, screen_, box_sizes(opened.models)),
      shown_(room_.objects.size()), choice_(room_.objects.size()), cost_(usual_room_cost) {
    reserve(opened.models);
    models_ = std::make_unique<residency::RoomModels>(
        std::move(opened.models),
        residency::RoomModelsOptions{
            .max_bytes = static_cast<std::uint64_t>(room_share * 1e6 * settings.exhibit.memory_mb),
            .waits = !options.live},
        renderer_.store());
}

void RoomShow::reserve(std::span<const std::optional<residency::KnownModel>> models) {
    std::size_t options = 0;
    for (const room::Object& object : room_.objects) {
        std::size_t most = 0;
        for (std::size_t quality_level = 0; quality_level < quality_level_count(models, object.pack);
             ++quality_level) {
            const residency::KnownQualityLevel& known = models[object.pack]->quality_levels[quality_level];
            most = std::max(most, known.relief ? 0 : 3 * static_cast<std::size_t>(known.work));
        }
        options += quality_level_count(models, object.pack);
        max_indices_ = std::min(max_indices_ + most, max_plan_indices);
    }
    const std::size_t parts = room_.objects.size() + max_fades;
    seen_.reserve(room_.objects.size());
    options_of_seen_.reserve(options);
    parts_.reserve(parts);
    for (std::size_t eye = 0; eye < layout_.count; ++eye) {
        plans_.push_back(scene::make_plan(screen_.surface, max_indices_, parts));
    }
}

Result<std::unique_ptr<RoomShow>> RoomShow::create(const settings::Settings& settings,
                                                   const RoomShowOptions& options) {
    TRY(room::Room room, room::read_room(settings.screen.room));
    TRY(Opened opened, open(room, options.live));
    const PixelSize size = layout_of(settings, screen_of(settings.screen), options.both_eyes).display;
    TRY(render::Renderer renderer,
        render::Renderer::create(size.width, size.height, needs_of(options.samples)));
    std::unique_ptr<RoomShow> show(
        new RoomShow(settings, options, std::move(room), std::move(renderer), std::move(opened)));
    if (options.live) {
        TRY_VOID(show->measure());
    }
    return show;
}

/// Measures the first pack that can be read; the others are assumed to cost the same.
Result<void> RoomShow::measure() {
    for (std::size_t model = 0; model < room_.packs.size(); ++model) {
        const residency::KnownModel* const known = models_->find(model);
        if (known == nullptr) {
            continue;
        }
        Result<scene::FrameCost> cost = measure_room_cost(*known, screen_, options_.samples, renderer_);
        if (cost && cost->mesh.fixed_ms + cost->mesh.ms_per_triangle > 0.0) {
            const bool has_relief = cost->raster.fixed_ms + cost->raster.ms_per_triangle > 0.0;
            cost_ = {cost->mesh, has_relief ? cost->raster : usual_room_cost.raster, {}};
            return {};
        }
        if (cost || cost.error().kind != ErrorKind::BadInput) {
            return cost ? Result<void>() : tl::unexpected<Error>(cost.error());
        }
    }
    return {};
}

} // namespace frustumscreen::show
