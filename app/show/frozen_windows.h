/// The patches of the windows on the table: made by a thread that sleeps without work, drawn where they are ready.
///
/// Choice   a window is drawn by its patches if that takes at most half the time of its parts, by the costs that the governor measured; by
///          its parts until the eye's patch is ready, and for eyes beyond the patches (scene/window_patches.h). Parts of a world of
///          cells, and those in coloured light, are drawn as they are.
/// Fade     from its parts to points and back, an eye's picture changes evenly over `fade_s`, counted by the times of its frames. With
///          `waits` it changes at once.
/// Frames   table T; window: as scene::PinnedView.
/// Threads  the render thread; it never waits for the worker thread, but with `waits` it makes all patches itself.
///          Without `waits` it allocates only in `make_space`: there are jobs for twice as many windows as may lie on
///          the table. While all of them are taken, because the worker thread has not freed those of earlier windows
///          yet, a new window waits for one, drawn by its parts.
/// Memory   for each window PatchJobSetUp::max_bytes, and the world while patches are made.
/// Errors   none: a pack that cannot be read again has no patches.
#pragma once

#include "app/exhibit/presented_windows.h"
#include "app/residency/prepared_artifact.h"
#include "app/scene/frame_time_model.h"
#include "app/settings/settings.h"
#include "app/show/patch_view.h"
#include "app/show/patch_worker.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::show {

/// A view that a window froze.
struct FrozenWindow {
    std::uint32_t number = 0;
    std::size_t artifact = 0;
    const residency::KnownArtifact& known;
    scene::QualityLevel shown;          ///< of the whole artifact
    std::span<const scene::Part> parts; ///< in the window's frame
    const scene::PinnedView& view;
    glm::dvec3 eye_m{0.0};
};

/// True if the patches of a window take at most half the time of its part.
[[nodiscard]] bool patches_are_quicker(const scene::FrameCost& cost, const scene::PlacedLevel& part,
                                       const PatchView& view);

/// The level that patches show: the shown one, or of a relief the coarsest level that errs no more, otherwise the finest.
[[nodiscard]] std::uint32_t level_for(const pack::PackOutline& outline, const scene::ScenePlan& plan,
                                      const scene::QualityLevel& shown);

class FrozenWindows {
public:
    FrozenWindows(const settings::ProjectorSettings& projector, bool waits);

    FrozenWindows(const FrozenWindows&) = delete;
    FrozenWindows& operator=(const FrozenWindows&) = delete;

    /// Forgets all windows, and prepares for those of these artifacts.
    void make_space(std::span<const residency::KnownArtifact* const> artifacts);
    /// `cost`: of frames on this GPU; before, no patches are made.
    void set_cost(const scene::FrameCost& cost) { cost_ = cost; }
    /// Begins the window's patches, in place of those that it had.
    void freeze(const FrozenWindow& window);
    /// Forgets the window's patches.
    void forget(std::uint32_t number);
    /// As `freeze`, but makes patches of this world without the choice.
    void begin(std::uint32_t number, PatchJobSetUp set_up);
    /// The patches that are ready for a window, which these eyes look at, window's frame; null: it has none. `fade_s`: time of a fade
    /// from its parts to points or back.
    [[nodiscard]] const scene::WindowPatches* look(std::uint32_t number, std::span<const glm::dvec3> eyes,
                                                   MonotonicTime now,
                                                   double fade_s = scene::PointFade::fade_s);
    /// Call once a frame, after all `look`: forgets windows that are not among these, and gives the worker thread its
    /// work.
    void step(std::span<const exhibit::PresentedWindow> windows);
    /// True if a window of the frame of the latest `step` shows both its parts and points.
    [[nodiscard]] bool fades() const { return fades_; }

    [[nodiscard]] std::size_t size() const { return windows_.size(); }
    [[nodiscard]] bool has_thread() const { return worker_ != nullptr; }

private:
    struct Window {
        std::uint32_t number = 0;
        PatchJob* job = nullptr;                 ///< null: it waits for one
        PatchJobSetUp set_up;                    ///< of the job that it waits for
        std::optional<std::size_t> patch;        ///< that was looked at last
        std::array<scene::PointFade, 2> fades{}; ///< of its eyes
        std::optional<MonotonicTime> faded_to;
    };
    /// Sets what the eyes see. A window that waits is not faded.
    void fade(Window& window, std::span<const glm::dvec3> eyes, MonotonicTime now, double fade_s);
    /// Gives the window a job, if one is free.
    void give_job(Window& window);
    /// Forgets the windows for which `is_gone` is true.
    template <typename IsGone> void forget_if(const IsGone& is_gone);

    geometry::Pinhole projector_;
    geometry::RigidTransform table_from_projector_;
    bool waits_;
    std::optional<scene::FrameCost> cost_;
    std::vector<std::shared_ptr<const WorldMaker>> makers_; ///< one for each artifact
    std::vector<Window> windows_;
    std::uint64_t last_number_ = 0; ///< of jobs
    bool has_news_ = false;         ///< for the thread
    bool fades_ = false;            ///< in the latest frame
    bool fades_now_ = false;        ///< in this frame so far
    std::array<PatchJob, std::size_t{2} * settings::max_windows> jobs_{};
    std::unique_ptr<PatchWorker> worker_; ///< last: its thread uses the jobs
};

} // namespace frustumscreen::show
