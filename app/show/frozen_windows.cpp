#include "app/show/frozen_windows.h"

#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"
#include "app/scene/scene_level.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

namespace {

/// Time of a window by patches for each sample of its picture, measured on one core of a virtual machine: half of it warps and
/// draws the points, of which there are about two a sample; the rest averages the samples.
constexpr double patch_ms_per_sample = 2e-5;
/// Patches that save less are not worth that outlines grow by half a pixel.
constexpr double min_gain = 2.0;
/// The eye sees about half of a level's triangles.
constexpr double seen_share = 0.5;

/// The worker keeps this of a window to read its world.
struct ToRead {
    std::filesystem::path file;
    pack::PackOutline outline;
    std::uint32_t level = 0;
    glm::dmat4 window_from_box{1.0};
    double samples_per_m = 1.0;
};

/// Without triangles if the pack is another one by now.
Result<FrozenWorld> read_world(const ToRead& from) {
    bool is_same = false;
    TRY(const pack::VerifiedPack pack,
        pack::load_pack(from.file,
                        [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
                            is_same = outline == from.outline;
                            return is_same ? std::vector{from.level} : std::vector<std::uint32_t>();
                        }));
    FrozenWorld world;
    if (is_same) {
        const scene::SceneLevel level = scene::whole_level(*pack, from.level);
        add_level(level, pack->textures[level.mesh.texture], pack->box_size, from.window_from_box,
                  from.samples_per_m, world);
    }
    return world;
}

} // namespace

bool patches_are_quicker(const scene::FrameCost& cost, const scene::PlacedLevel& part,
                         const PatchView& view) {
    const double side = view.samples > 1 ? 2.0 : 1.0;
    const double samples = static_cast<double>(view.cameras.width) * view.cameras.height;
    const scene::QualityLevelCost& own = part.relief ? (part.on_gpu ? cost.on_gpu : cost.raster) : cost.mesh;
    const double items = part.relief      ? static_cast<double>(part.relief->blocks.size())
                         : part.triangles ? static_cast<double>(part.triangles->indices.size()) / 3.0
                                          : 0.0;
    const scene::FrameWork work{.triangles = seen_share * items, .pixels = samples / (side * side)};
    return min_gain * patch_ms_per_sample * samples < own.ms(work, part.samples) - own.fixed_ms;
}

std::uint32_t level_for(const pack::PackOutline& outline, const scene::ScenePlan& plan,
                        const scene::QualityLevel& shown) {
    if (!shown.relief) {
        return shown.level;
    }
    const auto relief =
        std::find_if(plan.reliefs.begin(), plan.reliefs.end(),
                     [&](const pack::ReliefOutline& each) { return each.texels == shown.level; });
    std::uint32_t level = 0;
    while (level + 1 < outline.levels.size() &&
           (relief == plan.reliefs.end() || outline.levels[level].error.mean_box > relief->error.mean_box)) {
        ++level;
    }
    return level;
}

FrozenWindows::FrozenWindows(const settings::ProjectorSettings& projector, bool waits)
    : projector_(projector.pinhole), table_from_projector_(projector.table_from_projector), waits_(waits) {}

void FrozenWindows::forget(std::uint32_t number) {
    is_new_ =
        std::erase_if(windows_, [&](const Window& each) { return each.number == number; }) > 0 || is_new_;
}

void FrozenWindows::freeze(const FrozenWindow& window) {
    forget(window.number);
    if (!cost_ || window.parts.size() != 1 || window.known.world ||
        window.parts.front().level.light != glm::vec3(1.0F) || scene::if_it_bends(projector_)) {
        return;
    }
    const scene::PlacedLevel& part = window.parts.front().level;
    const PatchView view = patch_view({.view = window.view,
                                       .projector = projector_,
                                       .table_from_projector = table_from_projector_,
                                       .eye_m = window.eye_m,
                                       .samples = part.samples});
    if (!patches_are_quicker(*cost_, part, view)) {
        return;
    }
    ToRead read{.file = window.known.file,
                .outline = window.known.outline,
                .level = level_for(window.known.outline, window.known.plan, window.shown),
                .window_from_box = part.prop_from_box(),
                .samples_per_m = view.samples_per_m};
    begin(window.number, {.make_world = [read = std::move(read)] { return read_world(read); },
                          .radius_m = view.radius_m,
                          .view = view.cameras,
                          .samples = view.samples});
}

void FrozenWindows::begin(std::uint32_t number, PatchJobSetUp set_up) {
    set_up.number = ++last_number_;
    windows_.push_back(
        {.number = number, .job = std::make_shared<PatchJob>(std::move(set_up)), .patch = std::nullopt});
    is_new_ = true;
}

const scene::WindowPatches* FrozenWindows::look(std::uint32_t number, std::span<const glm::dvec3> eyes) {
    const auto found = std::find_if(windows_.begin(), windows_.end(),
                                    [number](const Window& window) { return window.number == number; });
    if (found == windows_.end()) {
        return nullptr;
    }
    if (!eyes.empty()) {
        const std::optional<std::size_t> patch = found->job->patches().hemisphere.patch_of(eyes.front());
        looks_elsewhere_ = looks_elsewhere_ || patch != found->patch;
        found->patch = patch;
        found->job->look_from(eyes.front());
    }
    if (waits_) {
        while (!found->job->is_done()) {
            found->job->step();
        }
    }
    found->job->update();
    return &found->job->patches();
}

void FrozenWindows::give_work() {
    PatchJobs jobs;
    for (const Window& window : windows_) {
        if (!window.job->is_done()) {
            jobs.push_back(window.job);
        }
    }
    if (!jobs.empty() && !worker_) {
        worker_ = std::make_unique<PatchWorker>();
    }
    if (worker_) {
        worker_->work_on(std::move(jobs));
    }
}

void FrozenWindows::step(std::span<const exhibit::PresentedWindow> windows) {
    const auto is_gone = [&](const Window& window) {
        return std::none_of(windows.begin(), windows.end(),
                            [&](const auto& presented) { return presented.number == window.number; });
    };
    is_new_ = std::erase_if(windows_, is_gone) > 0 || is_new_;
    if (waits_) {
        return;
    }
    if (is_new_) {
        give_work();
    } else if (looks_elsewhere_ && worker_) {
        worker_->look_again();
    }
    is_new_ = looks_elsewhere_ = false;
    if (windows_.empty() && worker_ && worker_->rests()) {
        worker_.reset();
    }
}

void FrozenWindows::clear() {
    windows_.clear();
    is_new_ = true;
}

} // namespace frustumscreen::show
