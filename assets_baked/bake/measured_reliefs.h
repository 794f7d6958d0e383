/// The reliefs of a pack's section `relief_blocks`: blocks at several resolutions, sampled from a level's surface and measured.
///
/// Surface  the finest mesh level's: what visitors can see, turned towards them, with the light that was baked into its texture.
/// Frame    box.
/// Errors of a relief (LevelError): distances both ways of what eyes of the zone meet on it and on the source. A relief has no
///          surface where none of its directions looks, and nobody sees that.
/// Threads  uses every core; the same result with any number of them.
/// Failures none: a surface that no line of the grid meets has no relief.
#pragma once

#include "app/pack/pack_relief.h"
#include "assets_baked/bake/level.h"

#include <vector>

namespace frustumscreen {

/// Resolutions for a bake of this size: 96, each twice the one before, up to the size itself; the size alone below that. At 384 a
/// texel is about a pixel near the projector.
[[nodiscard]] std::vector<int> relief_texels(int size);

struct ReliefSource {
    const PackLevel& finest;
    const Image8& texture; ///< of `finest`
    glm::dvec3 box_size{1.0};
    std::vector<ReliefDirection> directions;
    const SourceScene& truth;
    const SourceSamples& samples; ///< of the truth, for colour
    const ViewingZone& zone;
    bool compare_colour = false; ///< baked light is no error
};
[[nodiscard]] std::vector<MeasuredRelief> bake_reliefs(const ReliefSource& source, int size);

} // namespace frustumscreen
