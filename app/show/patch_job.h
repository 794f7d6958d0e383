/// The patches of one frozen window: one thread makes them, another one draws those that are made.
///
/// Frames   window (scene/window_patches.h).
/// Threads  `look_from`, `update`, `patches` and `is_done`: the thread that draws; they never wait. `step`: the thread that makes.
/// Memory   until all patches are made, the world's triangles and the cameras' pictures; then the patches, up to `max_bytes` of
///          `PatchJobSetUp`.
/// Errors   a world that cannot be read has no patches: its window goes on as it was drawn.
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

namespace frustumscreen::show {

struct PatchJobSetUp {
    std::function<Result<FrozenWorld>()> make_world; ///< slow; called on the thread that makes
    double radius_m = 1.0;    ///< of the eye from the window's middle, when it was frozen
    ldi::CameraView view;     ///< its pixels are the samples of the window's picture
    int samples = 1;          ///< a pixel
    std::uint64_t number = 0; ///< that no other job has had
    std::uint64_t max_bytes = std::uint64_t{32} << 20U;
};

class PatchJob {
public:
    explicit PatchJob(PatchJobSetUp set_up);

    /// Puts the eye's patch first.
    void look_from(const glm::dvec3& eye);
    /// Takes over what was made since the last call.
    void update();
    [[nodiscard]] const scene::WindowPatches& patches() const { return patches_; }
    /// All that can be made is made. True on either thread.
    [[nodiscard]] bool is_done() const { return done_.load(std::memory_order_acquire); }
    /// The patch that is looked at is made, or none can be made any more.
    [[nodiscard]] bool has_first() const;

    /// Does a piece of the work.
    void step();

private:
    void begin();
    void hand_over();

    PatchJobSetUp set_up_;
    scene::WindowPatches patches_;
    std::atomic<std::size_t> looked_at_{0}; ///< a patch
    /// Written once each by the thread that makes, before its flag is set.
    std::array<std::shared_ptr<const ldi::PointPatch>, ldi::patch_count> made_;
    std::array<std::atomic<bool>, ldi::patch_count> is_made_{};
    std::atomic<bool> done_{false}, has_box_{false};
    geometry::Box box_{};
    std::optional<ldi::PointMaker> maker_; ///< of the thread that makes
};

} // namespace frustumscreen::show
