#include "app/programs/offline_render.h"

#include "app/render/read_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>

namespace frustumscreen {

Result<std::uint32_t> level_of(const Pack& pack, std::string_view technique) {
    const auto levels = static_cast<std::uint32_t>(pack.levels.size());
    if (technique == "auto") {
        return pack.default_level;
    }
    if (technique == "finest") {
        return levels - 1;
    }
    constexpr std::string_view prefix = "level";
    if (technique.substr(0, prefix.size()) == prefix) {
        std::uint32_t level = 0;
        const char* const begin = technique.data() + prefix.size();
        const char* const end = technique.data() + technique.size();
        const std::from_chars_result read = std::from_chars(begin, end, level);
        if (read.ec == std::errc{} && read.ptr == end && level < levels) {
            return level;
        }
    }
    return bad_input(fmt::format("technique '{}'; this pack has auto, finest and level0 to level{}",
                                 technique, levels - 1));
}

namespace {
/// The finest level is for those who do not count the cost: it gets the smoothest outlines too.
int samples_of(const OfflineOptions& options, const Pack& pack) {
    const int usual = options.technique == "finest" ? finest_samples : pack.samples;
    return options.samples > 0 ? options.samples : usual;
}
} // namespace

OfflineRenderer::OfflineRenderer(const CheckedSettings& settings, const OfflineOptions& options)
    : projector_(settings->projector.pinhole),
      table_from_projector_(settings->projector.table_from_projector), prop_(make_prop(settings->prop)) {
    if (options.width > 0 && options.height > 0) {
        projector_ = projector_.scaled_to(options.width, options.height);
    }
    if (options.light) {
        light_ = LightCompensation{};
    }
}

Result<std::unique_ptr<OfflineRenderer>> OfflineRenderer::create(const CheckedSettings& settings,
                                                                 const VerifiedPack& pack,
                                                                 const OfflineOptions& options) {
    const Result<std::uint32_t> level = level_of(*pack, options.technique);
    if (!level) {
        return tl::unexpected<Error>(level.error());
    }
    std::unique_ptr<OfflineRenderer> made(new OfflineRenderer(settings, options));
    const int width = made->projector_.width;
    const int height = made->projector_.height;
    Result<std::unique_ptr<SurfacelessDisplay>> display = SurfacelessDisplay::create(width, height);
    if (!display) {
        return tl::unexpected<Error>(display.error());
    }
    made->display_ = std::move(*display);
    Result<ArtifactGpu> artifact = ArtifactGpu::upload(*pack, *level);
    if (!artifact) {
        return tl::unexpected<Error>(artifact.error());
    }
    made->artifact_ = std::move(*artifact);
    Result<Renderer> renderer = Renderer::create({width,
                                                  height,
                                                  std::max(samples_of(options, *pack), default_samples),
                                                  {false, made->artifact_->cut_out()}});
    if (!renderer) {
        return tl::unexpected<Error>(renderer.error());
    }
    made->renderer_ = std::move(*renderer);
    if (options.hit_points) {
        Result<HitPointRenderer> hit_points =
            HitPointRenderer::create(width, height, made->artifact_->cut_out());
        if (!hit_points) {
            return tl::unexpected<Error>(hit_points.error());
        }
        made->hit_points_ = std::move(*hit_points);
    }
    const double metres_per_box = place(*pack, made->prop_).metres_per_box;
    made->technique_ = fmt::format("level{}", *level);
    made->estimated_error_mm_ =
        1e3 * metres_per_box * static_cast<double>(pack->levels[*level].error.mean_box);
    made->placed_ = placed(*pack, *level, metres_per_box, *level);
    made->placed_.samples = samples_of(options, *pack);
    made->plan_ = make_plan(made->prop_, made->placed_);
    return made;
}

void OfflineRenderer::draw_once(const PlanView& view) {
    plan_frame(prop_, placed_, view, plan_);
    renderer_->draw(plan_, &*artifact_, {display_->framebuffer(), display_->buffer_age()},
                    Redraw::Everything);
    (void)display_->present(MonotonicTime{}); // cannot fail without a screen
}

OfflinePicture OfflineRenderer::draw(const RigidTransform& table_from_prop, const glm::dvec3& eye_m) {
    const PlanView view{projector_, table_from_projector_, table_from_prop, std::span(&eye_m, 1), light_};
    if (!warm_) {
        draw_once(view); // the driver compiles its shaders on the first picture
        warm_ = true;
    }
    const auto start = std::chrono::steady_clock::now();
    draw_once(view);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    OfflinePicture picture;
    picture.ms = taken.count();
    picture.colour = read_colour(display_->framebuffer(), projector_.width, projector_.height);
    if (hit_points_) {
        picture.hit_points = hit_points_->draw(plan_, &*artifact_);
    }
    return picture;
}

} // namespace frustumscreen
