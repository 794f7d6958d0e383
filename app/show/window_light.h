/// The torches' light in a window: as it lay on the artifact when the window was pinned, or, in a live window, as it lies there now.
///
/// Textures  pictures, films and layers are there while their artifact is on show; then their light leaves its windows.
/// Frames    table T; prop P; window: as scene::PinnedView.
/// Threads   values; one caller. Allocates nothing.
/// Errors    none.
#pragma once

#include "app/geometry/transform.h"
#include "app/scene/pinned_view.h"
#include "app/scene/placed_torch.h"

#include <array>
#include <cstddef>
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
    /// Keeps the light that lies on the prop now.
    void keep(const LightInProp& light);
    /// Leaves the torches out that do not meet this world, prop frame.
    void leave_out_beside(const scene::WorldBall& world);
    /// Leaves the torches out that show textures of the artifact. True: there were some.
    bool leave_out_textures();
    void put_out() { *this = {}; }

    [[nodiscard]] bool is_lit() const { return count_ > 0; }
    /// Factor of the light of the artifact's own colours.
    [[nodiscard]] double house_light() const { return is_lit() ? house_light_ : 1.0; }
    /// For a window of this view that stands at `table_from_window`; valid until the next call.
    [[nodiscard]] std::span<const scene::PlacedTorch>
    behind(const scene::PinnedView& view, const geometry::RigidTransform& table_from_window);

private:
    template <typename IsLeftOut> bool leave_out(const IsLeftOut& is_left_out);

    std::array<scene::PlacedTorch, torch::max_torches> in_prop_{}; ///< poses in the prop's frame
    std::array<scene::PlacedTorch, torch::max_torches> behind_{};
    std::size_t count_ = 0;
    double house_light_ = 1.0;
};

} // namespace frustumscreen::show
