/// The reliefs of a pack's section `relief_blocks`: blocks at several resolutions, sampled from a level's
/// surface and measured.
///
/// Surface  that of the finest mesh level: the parts that visitors can see, oriented towards them, with the
///          light baked into its texture.
/// Frame    box.
/// Errors of a relief (LevelError): distances in both directions between points that eyes of the zone see on
/// it and on the source. A relief has no surface where none of its directions looks, which is invisible to
/// visitors.
/// Threads  uses every core; the result does not depend on their number.
/// Failures none: a surface that no line of the grid hits has no relief.
#pragma once

#include "app/pack/pack_relief.h"
#include "assets_baked/bake/level.h"

#include <functional>
#include <span>
#include <vector>

namespace frustumscreen::bake {

/// Resolutions for a bake of this size: 96, doubled repeatedly, up to the size itself; below 96 only the
/// size. At 384 a texel is about a pixel near the projector. `far`: 24 and 48 too, for artifacts far away in a room.
[[nodiscard]] std::vector<int> relief_texels(int size, bool far = false);

struct ReliefSource {
    const pack::PackLevel& finest;
    const image::Image8& texture; ///< of `finest`
    glm::dvec3 box_size{1.0};
    std::vector<pack::ReliefDirection> directions;
    const SourceScene& truth;
    const SourceSamples& samples; ///< of the source, for colour
    const ViewingZone& zone;
    bool compare_colour = false; ///< false for baked light, which is not an error
    bool far = false;            ///< as relief_texels
    std::function<void(double done)> progress = [](double) {}; ///< the share of the work, 0..1
};
[[nodiscard]] std::vector<pack::MeasuredRelief> bake_reliefs(const ReliefSource& source, int size);

/// The colours that a layer gives the corners of these reliefs, in their order. `layer`: of the size of the source's
/// texture, in its place; alpha as in source_layer.h. `made`: by bake_reliefs of the same source.
[[nodiscard]] std::vector<std::vector<glm::u8vec4>> layer_colours(const ReliefSource& source,
                                                                  const image::Image8& layer, int size,
                                                                  std::span<const pack::MeasuredRelief> made);

} // namespace frustumscreen::bake
