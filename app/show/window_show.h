/// The windows that visitors have pinned, in the picture: what each shows, frozen when it was pinned, and a thin frame around it.
///
/// Frozen   the levels or cells that the prop showed, as they stood then; they are drawn anew for each frame's eye, or their
///          patches are (frozen_windows.h). The governor's later choices do not change them. A window whose artifact leaves
///          the cache shows nothing any more.
/// States   a window of a state shows its cells or its layer. All windows of an artifact with states are as large as all of its
///          states together need, so that they compare. Until the layer has come, the window is dark.
/// Time     the windows' time is part of the frame's, which the governor bounds by the level in the prop; frames that miss their
///          deadline nevertheless draw windows with one sample a pixel (window_samples.h), and then a fade from geometry to
///          patches or back takes `short_fade_s`.
/// Live     the cells of a live window stand as those in the prop do, and torches light it as the prop, while the artifact is on show;
///          a part of a site while it stands in the prop.
/// Torches  another window, also of a state, keeps the light that lay on the artifact when it was pinned (window_light.h).
/// Slant    a window is seen from within 60 degrees of its normal; beyond `full_deg` it fades, and is dark at the limit. Its
///          frame stays.
/// Memory   one plan for each window and eye, for the largest level of any artifact of the set; the plan of the frame
///          borrows them while it is drawn. Nothing without windows.
/// Frames   table T, metres.
/// Threads  the render thread. Allocates only in `make_space`.
/// Errors   the driver has no memory.
#pragma once

#include "app/exhibit/presentation.h"
#include "app/render/gpu_store.h"
#include "app/residency/artifact_cache.h"
#include "app/residency/on_table.h"
#include "app/scene/frame_plan.h"
#include "app/scene/pinned_view.h"
#include "app/scene/window_samples.h"
#include "app/settings/settings.h"
#include "app/show/frozen_windows.h"
#include "app/show/window_light.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::show {

class WindowShow {
public:
    static constexpr double full_deg = 56.0,
                            limit_deg = 60.0; ///< of the eye's direction from the window's normal
    static constexpr double short_fade_s = 0.2;
    static constexpr double min_frame_m = 0.0015, max_frame_m = 0.005; ///< width of its lines
    static constexpr double frame_px = 1.3;          ///< or as many of the projector's pixels
    static constexpr double frame_brightness = 0.35; ///< of the texts' light

    /// `eyes`: of the layout. `waits`: patches (frozen_windows.h) are made at once, so that a run of simulated time is repeatable.
    WindowShow(const settings::Settings& settings, const geometry::PropShape& prop, std::size_t eyes,
               bool waits);
    /// `cost`: of frames on this GPU.
    void set_cost(const scene::FrameCost& cost) { frozen_.set_cost(cost); }
    /// Uploads the texel that the windows' frames are drawn with.
    [[nodiscard]] Result<void> prepare(render::GpuStore& store);
    [[nodiscard]] std::uint64_t planned_gpu_bytes() const;
    /// Makes space for all that the artifacts of this set may show, and forgets the windows of another one.
    void make_space(const residency::ArtifactCache& cache);

    /// The layers that the states of the artifact on show need, once for each.
    [[nodiscard]] std::span<const std::size_t> layers_of(const residency::KnownArtifact& artifact);
    void place_frames(const exhibit::Presentation& presentation, double brightness,
                      residency::OnTable& on_table) const;
    /// Freezes new windows, and returns the windows that are seen; valid until the next call. `torches`: that light the prop.
    [[nodiscard]] std::span<const scene::PlacedWindow>
    place(MonotonicTime now, const exhibit::Presentation& presentation, std::span<const glm::dvec3> eyes_m,
          const residency::ArtifactCache& cache, std::span<const scene::PlacedTorch> torches);
    /// True if a window in the latest picture fades: from one level to another, from its parts to points, or its light.
    [[nodiscard]] bool fades() const;
    /// True if torches in a window throw pictures, films or layers of the artifact, which must stay until it has faded.
    [[nodiscard]] bool shows_contents_of(std::size_t artifact) const;
    /// A frame took `ms` until it was complete.
    void record_time(MonotonicTime now, double ms) { samples_.record(now, ms, shows_); }
    /// The level in a window at a place, to draw one frame with.
    [[nodiscard]] std::span<const scene::PlacedWindow>
    sample(const scene::PlacedLevel& level, const glm::dvec2& place_m, const glm::dvec3& eye_m);

    /// Gives the plans, one for each eye, space for windows, or takes it back.
    void swap_space(std::span<scene::FramePlan> plans);

private:
    struct Held {
        std::uint32_t number = 0, comings = 0;
        std::size_t artifact = 0;
        double turn_rad = 0.0, zoom = 1.0; ///< as aimed
        bool is_frozen = false;            ///< false: its layer has not come yet
        bool follows = false;              ///< as PresentedWindow::follows
        bool lost = false;                 ///< its artifact has left the cache
        std::vector<scene::Part> parts;    ///< prop frame, as the prop showed them
        std::vector<scene::Part> moved;    ///< window's frame
        scene::PinnedView view;
        bool is_aimed = false;
        WindowLight light;
        std::optional<world::SiteView> part;               ///< of a site, that it shows
        std::vector<residency::RunCells::SeenRegion> seen; ///< of that part
        /// Drops the copies of the levels, so that these may leave the memory.
        void let_go();
    };
    /// Drops the copies in windows that are not presented any more.
    void let_go(const exhibit::PresentedWindows& presented);
    [[nodiscard]] Held& held_of(MonotonicTime now, const exhibit::PresentedWindow& window,
                                const exhibit::PresentedWindows& presented,
                                const residency::ArtifactCache& cache, const LightInProp& light);
    /// Leaves out the light that does not meet what the window shows.
    void limit_light(Held& held) const;
    /// Sets `parts` once all that they need is loaded.
    void freeze(MonotonicTime now, const exhibit::PresentedWindow& window,
                const residency::ArtifactCache& cache, Held& held) const;
    void aim(const exhibit::PresentedWindow& window, const std::optional<scene::WorldBall>& states,
             Held& held) const;
    /// Sets what the window shows in this frame.
    void update(MonotonicTime now, const exhibit::PresentedWindow& window, bool is_on_show,
                const residency::ArtifactCache& cache, const LightInProp& light, Held& held);
    /// Patches show a frozen window in its level's own colours; other windows are drawn by their parts.
    void begin_patches(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
                       Held& held);
    [[nodiscard]] const scene::WindowPatches* patches_for(std::uint32_t number,
                                                          const geometry::RigidTransform& table_from_window,
                                                          std::span<const glm::dvec3> eyes_m,
                                                          MonotonicTime now);
    /// Places a window with the marked region of a site, as the prop will show it. False: none is marked, or it is
    /// not seen.
    [[nodiscard]] bool place_preview(MonotonicTime now, const exhibit::Presentation& presentation,
                                     std::span<const glm::dvec3> eyes_m,
                                     const residency::ArtifactCache& cache, scene::PlacedWindow& placed);
    void set_samples(Held& held) const;
    /// Sets the parts of a window that shows a part of a site to the best levels that are there, of all regions: its
    /// eye sees other regions than the prop's faces show.
    static void refresh(MonotonicTime now, const residency::RunCells& cells, Held& held);
    /// Tells each site which parts of it windows show.
    void expect_parts(const exhibit::Presentation& presentation, const residency::ArtifactCache& cache) const;
    /// Sets the parts and the light of a live window to what the prop shows now.
    void go_on(const exhibit::PresentedWindow& window, const residency::ArtifactCache& cache,
               const LightInProp& light, Held& held) const;

    settings::WindowSettings windows_;
    bool torches_; ///< there may be some
    double frame_m_;
    glm::dvec3 prop_middle_m_;
    scene::WorldBall prop_ball_; ///< around the prop
    scene::WindowSamples samples_;
    bool shows_ = false; ///< a window is in the latest picture
    scene::TextureId white_ = scene::TextureId::None;
    std::array<Held, settings::max_windows + 1> held_{};
    std::vector<scene::FramePlan> spaces_; ///< one for each eye: of these, the windows
    std::array<scene::PlacedWindow, settings::max_windows> placed_{};
    std::array<std::size_t, pack::max_states> layers_{};
    Held preview_;                  ///< of a site's marked region; `number`: the title of its place, 0: none
    glm::dvec3 preview_eye_m_{0.0}; ///< when it began
    geometry::RigidTransform preview_table_from_prop_;
    FrozenWindows frozen_;
};

/// Gives plans space for windows while a frame is drawn.
class LentSpace {
public:
    /// `windows`: null: there are none.
    LentSpace(WindowShow* windows, std::span<scene::FramePlan> plans) : windows_(windows), plans_(plans) {
        if (windows_ != nullptr) {
            windows_->swap_space(plans_);
        }
    }
    ~LentSpace() {
        if (windows_ != nullptr) {
            windows_->swap_space(plans_);
        }
    }
    LentSpace(const LentSpace&) = delete;
    LentSpace& operator=(const LentSpace&) = delete;

private:
    WindowShow* windows_;
    std::span<scene::FramePlan> plans_;
};

} // namespace frustumscreen::show
