/// The torches' light in a window: as it lay on the artifact when the window was pinned, or, in a live window, as it lies there now.
///
/// Textures  pictures, films and layers stay for `fade_s` after their artifact was on show; in this time they fade
///           out in its windows.
/// Frames    table T; prop P; window: as scene::PinnedView.
/// Threads   values; one caller. Allocates nothing.
/// Errors    none.
#pragma once

#include "app/geometry/transform.h"
#include "app/scene/pinned_view.h"
#include "app/scene/placed_torch.h"
#include "firmware_host/base/time.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace frustumscreen::show {

/// The light on the prop in a frame.
struct LightInProp {
    std::span<const scene::PlacedTorch> torches; ///< table frame
    geometry::RigidTransform table_from_prop;
    double house_light = 1.0; ///< factor of the artifact's own light: it dims for a torch
};

class WindowLight {
public:
    static constexpr double fade_s = 0.5; ///< of what shows textures

    /// Keeps the light that lies on the prop now.
    void keep(const LightInProp& light);
    /// Leaves the torches out that do not meet this world, prop frame.
    void leave_out_beside(const scene::WorldBall& world);
    /// Call once a frame. Fades the torches that show textures of the artifact: down while another artifact is on
    /// show, up while it is. When they are dark, leaves them out and returns true.
    bool fade_textures(MonotonicTime now, bool is_on_show);
    void put_out() { *this = {}; }

    [[nodiscard]] bool is_lit() const { return count_ > 0; }
    /// Factor of the light of the artifact's own colours.
    [[nodiscard]] double house_light() const;
    /// True if a torch shows textures of the artifact.
    [[nodiscard]] bool shows_textures() const;
    /// True while the textures fade or are dark.
    [[nodiscard]] bool fades() const { return shows_textures() && share_ < 1.0; }
    /// The torches for a window of this view that stands at `table_from_window`; valid until the next call.
    [[nodiscard]] std::span<const scene::PlacedTorch>
    behind(const scene::PinnedView& view, const geometry::RigidTransform& table_from_window);

private:
    template <typename IsLeftOut> bool leave_out(const IsLeftOut& is_left_out);

    std::array<scene::PlacedTorch, torch::max_torches> in_prop_{}; ///< poses in the prop's frame
    std::array<scene::PlacedTorch, torch::max_torches> behind_{};
    std::size_t count_ = 0;
    double house_light_ = 1.0;
    double share_ = 1.0;                    ///< of the light that shows textures
    std::optional<MonotonicTime> faded_at_; ///< the latest step
};

} // namespace frustumscreen::show
