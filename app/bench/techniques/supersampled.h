/// A peer with several samples a pixel, as the exhibit takes them: drawn into a picture so many times larger, of which the
/// prop's part is averaged in linear light.
///
/// Grid     1 x 2, 2 x 2 or 2 x 4 samples, those of the exhibit (app/render/sample_grid.h).
/// Places   those of one sample at the pixel's centre, as for every technique.
/// Threads  the one whose context is current; the stage must outlive the technique.
/// Errors   as the peer's; a picture that the driver cannot hold.
#pragma once

#include "app/bench/techniques/technique.h"

#include <functional>
#include <memory>

namespace frustumscreen {

/// Makes the peer for a stage, which outlives it.
using MakePeer = std::function<Result<std::unique_ptr<Technique>>(const Stage& stage)>;

[[nodiscard]] Result<std::unique_ptr<Technique>> make_supersampled(const Stage& stage, int samples,
                                                                   const MakePeer& make);

} // namespace frustumscreen
