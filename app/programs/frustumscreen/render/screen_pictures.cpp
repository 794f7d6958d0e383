#include "app/programs/frustumscreen/render/screen_pictures.h"

#include "app/programs/common/progress_line.h"
#include "app/programs/frustumscreen/render/screen_painter.h"
#include "app/render/hit_points.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::programs {

Result<void> write_screen_pictures(const settings::Settings& configured, const ScreenRequest& request,
                                   std::span<const tracking::TrackedState> frames) {
    if (!configured.screen.exists()) {
        return bad_input("render.no_screen",
                         "--output screen: the settings have no screen; add a table [screen] with its room");
    }
    settings::Settings settings = configured;
    if (request.width > 0 && request.height > 0) {
        settings.screen.width = request.width;
        settings.screen.height = request.height;
    }
    TRY(const std::unique_ptr<ScreenPainter> painter,
        ScreenPainter::create(settings, request.eye, request.hit_points));
    const show::RoomShow& room = painter->room();
    std::optional<render::HitPointRenderer> hit_points;
    if (request.hit_points) {
        TRY(hit_points, render::HitPointRenderer::create(room.renderer()));
    }
    std::string csv = "frame,t_us,ms,error_mm\n";
    ProgressLine progress("rendering");
    for (std::size_t k = 0; k < frames.size(); ++k) {
        const tracking::TrackedState& frame = frames[k];
        const std::vector<glm::dvec3> eyes_m =
            chosen_eyes(painter->eye(), frame, 1e-3 * settings.eye.interocular_mm);
        const auto start = std::chrono::steady_clock::now();
        painter->draw(to_seconds(frame.time - frames.front().time), eyes_m);
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        const std::filesystem::path stem = request.out / fmt::format("frame_{:05}", k);
        TRY_VOID(write_file(stem.string() + ".png", image::encode_png(painter->picture())));
        if (hit_points) {
            TRY_VOID(write_file(stem.string() + ".pfm", image::encode_pfm(hit_points->draw(
                                                            room.plans().front(), room.renderer().store()))));
        }
        csv += fmt::format("{},{},{:.3f},{:.4f}\n", k, to_microseconds(frame.time), taken.count(),
                           room.error_mm());
        progress.show(k + 1, frames.size());
    }
    return write_file(request.out / "frames.csv", as_bytes(csv));
}

} // namespace frustumscreen::programs
