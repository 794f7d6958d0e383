/// Techniques that splat layered depth images on the processor (window_technique.h).
///
/// The splatted picture goes into the target's texture as it is: no quadrilateral is drawn for it.
#pragma once

#include "app/bench/ldi/window_set.h"
#include "app/bench/ldi/window_technique.h"

namespace frustumscreen::bench {

[[nodiscard]] std::unique_ptr<WindowTechnique> make_window_ours(WindowSet& set);
[[nodiscard]] std::unique_ptr<WindowTechnique> make_multi_ldi(WindowSet& set);
[[nodiscard]] std::unique_ptr<WindowTechnique> make_single_ldi(WindowSet& set);
[[nodiscard]] std::unique_ptr<WindowTechnique> make_image_based_object(WindowSet& set);
/// `points`: the same depth pixels as `multi_ldi_paper`, drawn by the GPU.
[[nodiscard]] Result<std::unique_ptr<WindowTechnique>> make_window_points(WindowSet& set);

} // namespace frustumscreen::bench
