/// Techniques that the exhibit's own plan and renderer draw (window_technique.h).
#pragma once

#include "app/bench/ldi/window_set.h"
#include "app/bench/ldi/window_technique.h"

namespace frustumscreen::bench {

[[nodiscard]] std::unique_ptr<WindowTechnique> make_window_geometry(WindowSet& set);
[[nodiscard]] Result<std::unique_ptr<WindowTechnique>> make_window_lod(WindowSet& set);
[[nodiscard]] std::unique_ptr<WindowTechnique> make_window_relief(WindowSet& set);
/// The patch that the eye is in as a block relief; makes all nine patches.
[[nodiscard]] std::unique_ptr<WindowTechnique> make_window_patches(WindowSet& set, int pixels_per_texel);

} // namespace frustumscreen::bench
