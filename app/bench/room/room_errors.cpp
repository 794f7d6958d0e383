#include "app/bench/room/room_errors.h"

#include "app/bench/measures/timing.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::bench {

Result<std::unique_ptr<RoomErrors>> RoomErrors::create(RoomSet& set, RoomTruth& truth,
                                                       std::span<const RoomWalk> walks, int count,
                                                       const std::function<void(double done)>& progress) {
    std::unique_ptr<RoomErrors> made(new RoomErrors(walks));
    const settings::ScreenSettings& screen = set.settings().screen;
    made->drawn_.colour = image::Image8(screen.width, screen.height);
    const auto all = static_cast<double>(walks.size()) * count;
    for (std::size_t walk = 0; walk < walks.size(); ++walk) {
        const std::size_t frames = walks[walk].frames.size();
        const std::size_t of_walk = std::min(frames, static_cast<std::size_t>(count));
        for (std::size_t k = 0; k < of_walk; ++k) {
            const std::size_t frame = (2 * k + 1) * frames / (2 * of_walk);
            made->samples_.push_back({walk, frame, truth.cast(screen, walks[walk].frames[frame])});
            progress(static_cast<double>(made->samples_.size()) / all);
        }
    }
    return made;
}

Result<RoomError> RoomErrors::measure(RoomTechnique& technique, bool every_frame) {
    TRY(render::HitPointRenderer hit_points, render::HitPointRenderer::create(technique.renderer()));
    RoomError sum;
    std::vector<double> times_ms;
    std::size_t next = 0; // frame of the current walk, to draw
    for (std::size_t k = 0; k < samples_.size(); ++k) {
        const Sample& sample = samples_[k];
        const std::vector<RoomFrame>& frames = walks_[sample.walk].frames;
        next = k > 0 && samples_[k - 1].walk == sample.walk ? next : 0;
        for (; every_frame && next < sample.frame; ++next) {
            technique.draw(frames[next]);
        }
        if (k == 0) {
            technique.draw(frames[sample.frame]); // the driver compiles its own programs
            render::wait_until_drawn();
        }
        times_ms.push_back(ms_of([&] { technique.draw(frames[sample.frame]); }));
        next = sample.frame + 1;
        drawn_.point_m = hit_points.draw(technique.plan(), technique.renderer().store());
        const PictureError error = bench::measure(sample.truth, drawn_);
        sum.mean_mm += error.geometric_mean_mm;
        sum.p95_mm += error.geometric_p95_mm;
        sum.silhouette_percent += error.silhouette_percent;
    }
    const double share = 1.0 / static_cast<double>(std::max<std::size_t>(samples_.size(), 1));
    return RoomError{.mean_mm = share * sum.mean_mm,
                     .p95_mm = share * sum.p95_mm,
                     .silhouette_percent = share * sum.silhouette_percent,
                     .ms = quantile(times_ms, 0.5)};
}

} // namespace frustumscreen::bench
