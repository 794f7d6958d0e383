#include "app/show/room_costs.h"

#include "app/render/read_back.h"
#include "firmware_host/display/picture_framebuffer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <vector>

namespace frustumscreen::show {

namespace {

constexpr int repeats = 4; ///< of which the quickest counts; the first compiles shaders

/// As large as half of the screen, behind its middle.
scene::PlacedLevel placed_before(const scene::FlatScreen& screen, double size_m, const glm::dvec3& aside_m) {
    scene::PlacedLevel placed;
    placed.metres_per_box = size_m;
    const glm::dvec3 at =
        screen.surface.middle - size_m * screen.surface.faces.front().plane.normal + aside_m;
    placed.prop_from_placed[3] = glm::dvec4(at - glm::dvec3(0.0, 0.0, 0.5 * size_m), 1.0);
    return placed;
}

} // namespace

Result<scene::FrameCost> measure_room_cost(const residency::KnownModel& model,
                                           const scene::FlatScreen& screen, int samples,
                                           render::Renderer& renderer) {
    TRY(const display::PictureFramebuffer picture,
        display::PictureFramebuffer::create(renderer.width(), renderer.height()));
    const glm::dvec3 normal = screen.surface.faces.front().plane.normal;
    const double width_m = glm::distance(screen.surface.corners[0], screen.surface.corners[1]);
    const double height_m = glm::distance(screen.surface.corners[0], screen.surface.corners[3]);
    const std::array<glm::dvec3, 1> eye{screen.surface.middle + width_m * normal};
    const scene::PlanView view{.projector = screen.pinhole,
                               .table_from_projector = screen.table_from_pinhole,
                               .table_from_prop = {},
                               .eyes_m = eye};
    std::vector<scene::QualityLevelTime> times;
    std::array<int, 2> measured{}; // levels, reliefs
    for (std::size_t quality_level = 0; quality_level < model.quality_levels.size(); ++quality_level) {
        const residency::KnownQualityLevel& known = model.quality_levels[quality_level];
        if (measured[known.relief ? 1 : 0]++ >= 2) {
            continue;
        }
        TRY(residency::ReadQualityLevel read, residency::read_quality_level(model, quality_level));
        const std::shared_ptr<const relief::BlockRelief> relief = read.data.relief;
        render::LevelUpload upload(std::move(read.data));
        TRY_VOID(upload.go_on());
        const scene::Drawable drawable = renderer.store().keep(std::move(upload));
        const std::size_t indices = read.triangles ? read.triangles->indices.size() : 0;
        for (const std::size_t copies :
             {std::size_t{1}, std::size_t{4}}) { // of the same pixels together, and of as many triangles each
            const double size_m = 0.5 * height_m / (copies == 1 ? 1.0 : 2.0);
            std::vector<scene::Part> parts;
            for (std::size_t k = 0; k < copies; ++k) {
                const double aside = static_cast<double>(k) - 0.5 * static_cast<double>(copies - 1);
                scene::Part& part = parts.emplace_back();
                part.level = placed_before(
                    screen, size_m,
                    glm::dvec3(glm::normalize(screen.surface.corners[1] - screen.surface.corners[0]) * aside *
                               size_m));
                part.level.triangles = read.triangles;
                part.level.relief = relief;
                part.level.box_size = model.box_size;
                part.level.drawable = drawable;
                part.level.samples = samples;
            }
            std::vector<scene::FramePlan> plans;
            plans.push_back(scene::make_plan(screen.surface, copies * indices, copies));
            double min_ms = 1e9;
            for (int k = 0; k < repeats; ++k) {
                const auto start = std::chrono::steady_clock::now();
                scene::plan_frame(screen.surface, parts, view, plans.front());
                static_cast<void>(renderer.draw(plans, {picture.name(), 0}, render::Redraw::Everything));
                render::wait_until_drawn();
                min_ms = std::min(min_ms, std::chrono::duration<double, std::milli>(
                                              std::chrono::steady_clock::now() - start)
                                              .count());
            }
            const double edge_px = screen.pinhole.height * size_m / height_m * width_m / (width_m + size_m);
            times.push_back({.samples = samples,
                             .work = {.triangles = static_cast<double>(copies) * known.work,
                                      .pixels = static_cast<double>(copies) * 0.5 * edge_px * edge_px},
                             .ms = min_ms,
                             .relief = known.relief});
        }
        renderer.store().release(drawable);
    }
    return scene::cost_of(times);
}

} // namespace frustumscreen::show
