#include "app/show/frozen_windows.h"

#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"
#include "app/scene/scene_level.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::show {

namespace {

/// Time of a window by patches for each sample of its picture, measured on one core of a virtual machine: more than half of
/// it warps and draws the points, of which there are about three a sample; the rest averages the samples.
constexpr double patch_ms_per_sample = 2.3e-5;
/// Patches must be this many times quicker than the levels, because they make outlines grow by half a pixel.
constexpr double min_gain = 2.0;
/// The eye sees about half of a level's triangles.
constexpr double seen_share = 0.5;

/// Reads an artifact's levels. A level has no triangles if the pack is another one by now.
WorldMaker reader_of(const residency::KnownArtifact& known) {
    return [file = known.file,
            known_outline = known.outline](const LevelInWindow& shown) -> Result<FrozenWorld> {
        bool is_same = false;
        TRY(const pack::VerifiedPack pack,
            pack::load_pack(file,
                            [&](const pack::PackOutline& outline) -> Result<std::vector<std::uint32_t>> {
                                is_same = outline == known_outline;
                                return is_same ? std::vector{shown.level} : std::vector<std::uint32_t>();
                            }));
        FrozenWorld world;
        if (is_same) {
            const scene::SceneLevel level = scene::whole_level(*pack, shown.level);
            add_level(level, pack->textures[level.mesh.texture], pack->box_size, shown.window_from_box,
                      shown.samples_per_m, world);
        }
        return world;
    };
}

} // namespace

bool patches_are_quicker(const scene::FrameCost& cost, const scene::PlacedLevel& part,
                         const PatchView& view) {
    const double side = view.samples > 1 ? 2.0 : 1.0;
    const double samples =
        static_cast<double>(view.cameras.width) * view.cameras.height / (points_along * points_along);
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
    : projector_(projector.pinhole), table_from_projector_(projector.table_from_projector), waits_(waits) {
    windows_.reserve(settings::max_windows + 1); // a new one may come before the oldest goes
    if (!waits) {
        worker_ = std::make_unique<PatchWorker>(jobs_);
    }
}

void FrozenWindows::make_space(std::span<const residency::KnownArtifact* const> artifacts) {
    forget_if([](const Window& /*window*/) { return true; });
    makers_.clear();
    for (const residency::KnownArtifact* const known : artifacts) {
        makers_.push_back(std::make_shared<const WorldMaker>(reader_of(*known)));
    }
}

template <typename IsGone> void FrozenWindows::forget_if(const IsGone& is_gone) {
    std::erase_if(windows_, [&](const Window& window) {
        const bool goes = is_gone(window);
        if (goes && window.job != nullptr) {
            window.job->leave();
            has_news_ = true;
            if (waits_) {
                window.job->step();
            }
        }
        return goes;
    });
}

void FrozenWindows::forget(std::uint32_t number) {
    forget_if([number](const Window& window) { return window.number == number; });
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
    begin(window.number, {.make_world = makers_.at(window.artifact),
                          .shown = {.level = level_for(window.known.outline, window.known.plan, window.shown),
                                    .window_from_box = part.prop_from_box(),
                                    .samples_per_m = view.samples_per_m},
                          .radius_m = view.radius_m,
                          .view = view.cameras,
                          .samples = view.samples});
}

void FrozenWindows::begin(std::uint32_t number, PatchJobSetUp set_up) {
    set_up.number = ++last_number_;
    windows_.push_back({.number = number,
                        .job = nullptr,
                        .set_up = std::move(set_up),
                        .patch = std::nullopt,
                        .faded_to = std::nullopt});
    give_job(windows_.back());
}

void FrozenWindows::give_job(Window& window) {
    const auto free =
        std::find_if(jobs_.begin(), jobs_.end(), [](const PatchJob& job) { return job.is_free(); });
    if (free != jobs_.end()) {
        free->begin(std::move(window.set_up));
        window.job = &*free;
        has_news_ = true;
    }
}

void FrozenWindows::fade(Window& window, std::span<const glm::dvec3> eyes, MonotonicTime now, double fade_s) {
    const double passed_s = window.faded_to ? to_seconds(now - *window.faded_to) : 0.0;
    window.faded_to = now;
    std::array<scene::WindowPatches::OfEye, 2> seen{};
    const std::size_t count = std::min(eyes.size(), seen.size());
    for (std::size_t k = 0; k < count; ++k) {
        const ldi::PointPatch* const ready = scene::points_for(window.job->patches(), eyes[k]);
        window.fades[k].step(ready, waits_ ? 1.0 : passed_s / fade_s);
        seen[k] = {.eye = eyes[k], .shown = window.fades[k].shown()};
        fades_now_ = fades_now_ || window.fades[k].fades();
    }
    window.job->show(std::span(seen).first(count));
}

const scene::WindowPatches* FrozenWindows::look(std::uint32_t number, std::span<const glm::dvec3> eyes,
                                                MonotonicTime now, double fade_s) {
    const auto found = std::find_if(windows_.begin(), windows_.end(),
                                    [number](const Window& window) { return window.number == number; });
    if (found == windows_.end() || found->job == nullptr) {
        return nullptr;
    }
    PatchJob& job = *found->job;
    if (!eyes.empty()) {
        const std::optional<std::size_t> patch = job.patches().hemisphere.patch_of(eyes.front());
        has_news_ = has_news_ || patch != found->patch;
        found->patch = patch;
        job.look_from(eyes.front());
    }
    if (waits_) {
        while (!job.is_done()) {
            job.step();
        }
    }
    job.update();
    fade(*found, eyes, now, fade_s);
    return &job.patches();
}

void FrozenWindows::step(std::span<const exhibit::PresentedWindow> windows) {
    forget_if([&](const Window& window) {
        return std::none_of(windows.begin(), windows.end(),
                            [&](const auto& presented) { return presented.number == window.number; });
    });
    for (Window& window : windows_) {
        if (window.job == nullptr) {
            give_job(window);
        }
    }
    if (has_news_ && worker_) {
        worker_->look_again();
    }
    has_news_ = false;
    fades_ = std::exchange(fades_now_, false);
}

} // namespace frustumscreen::show
