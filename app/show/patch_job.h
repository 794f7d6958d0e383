/// The patches of one frozen window: the worker thread (patch_worker.h) makes them, the render thread draws those
/// that are made. A job may serve one window after the other.
///
/// Frames   window (scene/window_patches.h).
/// Threads  `step`: the worker thread, which frees all that it made. Everything else: the render thread, which never
///          waits and allocates nothing.
/// Memory   until all patches are made, the world's triangles and the cameras' pictures; then the patches, up to `max_bytes` of
///          `PatchJobSetUp`.
/// Errors   a world that cannot be read has no patches: its window is drawn as before.
#pragma once

#include "app/ldi/point_maker.h"
#include "app/scene/window_patches.h"
#include "app/show/frozen_world.h"
#include "firmware_host/base/result.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace frustumscreen::show {

/// The level that a window shows, and where.
struct LevelInWindow {
    std::uint32_t level = 0; ///< of the pack
    glm::dmat4 window_from_box{1.0};
    double samples_per_m = 1.0; ///< as PatchView::samples_per_m
};
/// Makes a window's world: slow; called on the worker thread.
using WorldMaker = std::function<Result<FrozenWorld>(const LevelInWindow&)>;

struct PatchJobSetUp {
    std::shared_ptr<const WorldMaker> make_world;
    LevelInWindow shown;
    double radius_m = 1.0;    ///< of the eye from the window's middle, when it was frozen
    ldi::CameraView view;     ///< its pixels are as fine as PatchView::cameras
    int samples = 1;          ///< a pixel
    std::uint64_t number = 0; ///< that no other job has had
    std::uint64_t max_bytes = std::uint64_t{32} << 20U;
};

class PatchJob {
public:
    /// True if `begin` may be called.
    [[nodiscard]] bool is_free() const { return state_.load(std::memory_order_acquire) == State::Free; }
    void begin(PatchJobSetUp set_up);
    /// Its patches are not drawn from now on. The worker thread frees the job.
    void leave() { state_.store(State::Left, std::memory_order_release); }

    /// Puts the eye's patch first.
    void look_from(const glm::dvec3& eye);
    /// Takes over what was made since the last call.
    void update();
    /// Sets the eyes that look, at most two, and the points that each is shown.
    void show(std::span<const scene::WindowPatches::OfEye> eyes);
    [[nodiscard]] const scene::WindowPatches& patches() const { return patches_; }
    /// True if all that can be made is made; on either thread.
    [[nodiscard]] bool is_done() const { return state_.load(std::memory_order_acquire) == State::Done; }
    /// True if the patch that is looked at is made, or none can be made any more.
    [[nodiscard]] bool has_first() const;
    [[nodiscard]] bool is_left() const { return state_.load(std::memory_order_acquire) == State::Left; }
    /// True if `step` has something to do.
    [[nodiscard]] bool needs_work() const;

    /// Does a piece of the work.
    void step();

private:
    enum class State : std::uint8_t { Free, Begun, Done, Left };
    void make_world();
    void hand_over();
    /// Marks the job as done, unless it was left in the meantime.
    void end();
    void free();

    std::atomic<State> state_{State::Free};
    PatchJobSetUp set_up_;
    scene::WindowPatches patches_{.hemisphere = ldi::Hemisphere(1.0), .box = {}};
    std::atomic<std::size_t> looked_at_{0}; ///< a patch
    /// Written once each by the worker thread, before its flag is set.
    std::array<std::shared_ptr<const ldi::PointPatch>, ldi::patch_count> made_;
    std::array<std::atomic<bool>, ldi::patch_count> is_made_{};
    geometry::Box box_{};
    std::optional<ldi::PointMaker> maker_; ///< used by the worker thread alone
};

} // namespace frustumscreen::show
