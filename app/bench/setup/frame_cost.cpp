#include "app/bench/setup/frame_cost.h"

#include "app/bench/measures/counts.h"
#include "app/bench/techniques/pack_level.h"
#include "app/scene/stereo.h"
#include "firmware_host/base/quantile.h"
#include "firmware_host/display/egl_context.h"
#include "firmware_host/display/picture_framebuffer.h"

#include <memory>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr int turns = 12;
constexpr int rounds = 6; ///< with fewer than 60 frame times the median is unsteady on a busy machine

std::vector<BenchPose> turned_in_the_middle(const glm::dvec3& eye_m) {
    std::vector<BenchPose> poses;
    for (int k = 0; k < turns; ++k) {
        const double yaw = 2.0 * std::numbers::pi * k / turns;
        poses.push_back({{glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), glm::dvec3(0.0)}, eye_m});
    }
    return poses;
}

/// One set-up's picture and its renderer. Its address must not change, because the technique refers to the kiosk.
struct Candidate {
    display::PictureFramebuffer picture;
    Kiosk kiosk;
    std::unique_ptr<Technique> level;
};

Result<std::unique_ptr<Candidate>> make_candidate(const settings::Settings& settings, const pack::Pack& pack,
                                                  const std::shared_ptr<const relief::BlockRelief>& relief) {
    const PixelSize size = scene::stereo_layout(settings).display;
    TRY(display::PictureFramebuffer picture, display::PictureFramebuffer::create(size.width, size.height));
    const unsigned framebuffer = picture.name();
    auto made = std::make_unique<Candidate>(
        Candidate{std::move(picture), {settings, settings::make_prop(settings.prop), framebuffer}, nullptr});
    PictureOptions options;
    options.lit = true;
    options.both_eyes = true;
    options.only_changes = true;
    TRY(made->level, relief
                         ? make_pack_relief(made->kiosk, pack, relief, std::nullopt, options, "relief")
                         : make_pack_level(made->kiosk, pack, pack.default_level, options, "default level"));
    return made;
}

} // namespace

Result<std::vector<SetUpCost>> frame_costs(std::span<const settings::Settings* const> set_ups,
                                           const pack::Pack& pack, const Progress& progress,
                                           const std::shared_ptr<const relief::BlockRelief>& relief) {
    if (set_ups.empty()) {
        return std::vector<SetUpCost>{};
    }
    TRY([[maybe_unused]] const display::EglContext context, display::EglContext::without_screen());
    std::vector<std::unique_ptr<Candidate>> candidates;
    std::vector<Technique*> techniques;
    for (const settings::Settings* settings : set_ups) {
        TRY(std::unique_ptr<Candidate> candidate, make_candidate(*settings, pack, relief));
        techniques.push_back(candidate->level.get());
        candidates.push_back(std::move(candidate));
    }
    const std::vector<BenchPose> poses = turned_in_the_middle(set_ups.front()->eye.default_m);
    const std::vector<FrameTimes> times = time_interleaved(techniques, poses, {rounds}, progress);
    std::vector<SetUpCost> costs;
    for (std::size_t k = 0; k < times.size(); ++k) {
        costs.push_back({quantile(times[k].wall_ms, 0.5) / quantile(times[0].wall_ms, 0.5),
                         quantile(times[k].cpu_ms, 0.5) / quantile(times[0].cpu_ms, 0.5),
                         count_frames(*set_ups[k], pack, poses).samples});
    }
    return costs;
}

} // namespace frustumscreen::bench
