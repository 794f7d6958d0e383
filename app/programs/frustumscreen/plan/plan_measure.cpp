#include "app/programs/frustumscreen/plan/plan_measure.h"

#include "app/programs/common/progress_line.h"
#include "app/programs/devices/wiring.h"
#include "app/render/gl_memory.h"
#include "app/render/read_back.h"
#include "app/scene/stereo.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/quantile.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace frustumscreen::programs {

namespace {

constexpr std::size_t max_poses = 12;
constexpr int loads = 5;  ///< for each scene
constexpr int rounds = 9; ///< over all poses and scenes; the first warms up

using Clock = std::chrono::steady_clock;

double microseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

/// Bytes that the program has from the allocator.
std::int64_t allocated_bytes() {
    const struct mallinfo2 info = ::mallinfo2();
    return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

/// Situations from the plan's devices, half a second apart.
Result<std::vector<tracking::TrackedState>> situations(const settings::Settings& settings,
                                                       const scene::DevicePlan& devices) {
    const MonotonicTime start;
    TRY(show::Inputs inputs, make_inputs(settings, devices, std::nullopt, start));
    tracking::TrackedStateTracker tracker(settings.eye.default_m);
    if (!inputs.tracker) {
        tracking::TrackedState standing = tracker.at(start);
        standing.prop_known = true;
        return std::vector<tracking::TrackedState>{standing};
    }
    std::vector<tracking::TrackedState> all;
    std::vector<tracker::PoseSample> samples;
    for (std::size_t k = 0; k < max_poses; ++k) {
        const MonotonicTime now = start + std::chrono::milliseconds(500 * (k + 1));
        samples.clear();
        TRY_VOID(inputs.tracker->poll(now, samples));
        for (const tracker::PoseSample& sample : samples) {
            if (devices.head || sample.station != tracker::head_station) {
                tracker.take(sample);
            }
        }
        all.push_back(tracker.at(now));
    }
    return all;
}

struct Scene {
    std::unique_ptr<show::ArtifactShow> show;
    exhibit::Exhibit exhibit;
    SceneCost cost;
    std::vector<double> us; ///< for each drawn frame
};

SceneCost saving(const Scene& with, const Scene& without) {
    std::vector<double> differences;
    for (std::size_t k = 0; k < with.us.size(); ++k) {
        differences.push_back(with.us[k] - without.us[k]);
    }
    return {.gpu_bytes = with.cost.gpu_bytes - without.cost.gpu_bytes,
            .ram_bytes = with.cost.ram_bytes - without.cost.ram_bytes,
            .load_ms = with.cost.load_ms - without.cost.load_ms,
            .frame_us = quantile(differences, 0.5),
            .spread_us = 0.5 * (quantile(differences, 0.75) - quantile(differences, 0.25))};
}

class Measuring {
public:
    Measuring(const settings::Settings& settings, const scene::DevicePlan& devices,
              show::ArtifactShowOptions options, display::Display& display)
        : settings_(settings), devices_(devices), options_(std::move(options)), display_(display),
          layout_(scene::stereo_layout(settings)) {}

    /// Loads and frees the scene several times, with no other loaded; then loads it to keep it.
    [[nodiscard]] Result<Scene> load(unsigned cull_kinds) {
        std::vector<double> load_ms;
        std::vector<double> ram_bytes;
        for (int k = 0; k < loads; ++k) {
            TRY(const Scene scene, load_once(cull_kinds));
            load_ms.push_back(scene.cost.load_ms);
            ram_bytes.push_back(static_cast<double>(scene.cost.ram_bytes));
        }
        Result<Scene> stays = load_once(cull_kinds);
        if (stays) {
            stays->cost.load_ms = quantile(load_ms, 0.5);
            stays->cost.ram_bytes = static_cast<std::int64_t>(quantile(ram_bytes, 0.5));
        }
        return stays;
    }

    [[nodiscard]] Result<Scene> load_once(unsigned cull_kinds) {
        options_.cull_kinds = cull_kinds;
        const std::int64_t before = allocated_bytes();
        const Clock::time_point start = Clock::now();
        TRY(std::unique_ptr<show::ArtifactShow> show,
            show::ArtifactShow::create(settings_, devices_, options_, target()));
        exhibit::Exhibit exhibit = show::make_exhibit(settings_, *show, MonotonicTime{});
        Scene scene{.show = std::move(show), .exhibit = std::move(exhibit), .cost = {}, .us = {}};
        scene.cost.load_ms = 1e-3 * microseconds_since(start);
        scene.cost.ram_bytes = allocated_bytes() - before;
        scene.cost.gpu_bytes = static_cast<std::int64_t>(scene.show->use().gpu_bytes);
        return scene;
    }

    /// Draws all scenes at each pose in turn; each round uses another order.
    [[nodiscard]] Result<std::size_t> draw(std::vector<Scene>& scenes) {
        TRY(const std::vector<tracking::TrackedState> poses, situations(settings_, devices_));
        ProgressLine progress("measuring");
        MonotonicTime now;
        std::size_t drawn = 0;
        const std::size_t frames_each = std::max<std::size_t>(poses.size(), 6) * rounds;
        for (std::size_t frame = 0; frame < frames_each; ++frame) {
            now += std::chrono::milliseconds(500);
            for (std::size_t k = 0; k < scenes.size(); ++k) {
                Scene& scene = scenes[(k + frame) % scenes.size()];
                const Clock::time_point start = Clock::now();
                const tracking::TrackedState& tracked_state = poses[frame % poses.size()];
                const std::array<glm::dvec3, 2> both_m =
                    tracking::eyes_of(tracked_state, 1e-3 * settings_.eye.interocular_mm);
                const render::DrawResult result =
                    scene.show->draw(now, scene.exhibit.step(now, {}, tracked_state),
                                     scene::drawn_eyes(layout_, tracked_state.eye_m, both_m), target(),
                                     render::Redraw::Everything);
                render::wait_until_drawn();
                if (result.drawn && frame >= frames_each / rounds) {
                    scene.us.push_back(microseconds_since(start));
                }
                TRY_VOID(display_.present(now));
                progress.show(++drawn, frames_each * scenes.size());
            }
        }
        for (Scene& scene : scenes) {
            scene.cost.frame_us = quantile(scene.us, 0.5);
        }
        return poses.size();
    }

private:
    [[nodiscard]] render::RenderTarget target() const { return {display_.framebuffer(), 0}; }

    const settings::Settings& settings_;
    const scene::DevicePlan& devices_;
    show::ArtifactShowOptions options_;
    display::Display& display_;
    scene::StereoLayout layout_;
};

} // namespace

Result<PlanMeasurement> measure_plan(const settings::Settings& settings, const scene::DevicePlan& devices,
                                     const std::filesystem::path& pack, const std::string& technique,
                                     display::Display& display) {
    settings::Settings unhurried = settings; // no deadline: every scene draws the level for the tolerance
    unhurried.projector.refresh_hz = 1e-3;
    Measuring measuring(unhurried, devices,
                        {.packs = {pack},
                         .technique = technique,
                         .samples = render::default_samples,
                         .cull_kinds = scene::AllCullKinds},
                        display);
    // The first scene also pays the driver's one-time costs.
    TRY_VOID(without_value(measuring.load_once(0)));
    TRY(Scene planned, measuring.load(scene::AllCullKinds));
    unsigned used = 0;
    for (const scene::LeftOut& each : planned.show->plan(0).left_out) {
        used |= each.cull_kind;
    }
    std::vector<Scene> scenes;
    scenes.push_back(std::move(planned));
    std::vector<unsigned> without{0};
    for (unsigned cull_kind = 1; cull_kind < scene::AllCullKinds; cull_kind <<= 1U) {
        if ((used & cull_kind) != 0) {
            without.push_back(scene::AllCullKinds & ~cull_kind);
        }
    }
    for (const unsigned cull_kinds : without) {
        TRY(Scene scene, measuring.load(cull_kinds));
        scenes.push_back(std::move(scene));
    }
    TRY(const std::size_t poses, measuring.draw(scenes));
    PlanMeasurement result;
    result.poses = poses;
    result.planned = scenes[0].cost;
    result.everything = scenes[1].cost;
    result.saved = saving(scenes[1], scenes[0]);
    for (std::size_t k = 1; k < without.size(); ++k) {
        result.cull_kinds.push_back({static_cast<scene::CullKind>(scene::AllCullKinds & ~without[k]),
                                     saving(scenes[k + 1], scenes[0])});
    }
    result.renderer = render::renderer_name();
    result.show = std::move(scenes[0].show);
    return result;
}

} // namespace frustumscreen::programs
