/// How near to the eye is what a row of pixels shows, in one measure for all faces of the prop.
///
/// Units    1 / s of the point E + s (S - E), where E is the eye and S the place on the prop that the pixel lights; 0
///          without a hit. At the pixel's centre, between the hits on both sides of it that are nearest to it.
/// Threads  pure; any.
/// SIMD     as rasterize_blocks.h.
#pragma once

#include "app/relief/instructions.h"
#include "app/relief/pixel_lens.h"
#include "app/relief/raster_view.h"
#include "app/relief/rasterize_blocks.h"

#include <span>
#include <vector>

namespace frustumscreen::relief {

/// A face of the prop that shows some relief.
struct NearnessFace {
    int face = 0; ///< index into the prop's faces
    std::array<glm::vec3, 4> edges{};
    geometry::PerCorner<glm::vec3> more_edges{};
    glm::vec3 slant{0.0F}; ///< RasterFace::slant
};
struct NearnessView {
    PixelLens lens;
    std::vector<NearnessFace> faces;

    /// Begins with the faces of `view`; `add` adds those of another relief in the same frame.
    void begin(const RasterView& view);
    void add(const RasterView& view);
};

/// For row `y`, from pixel `first` on.
void nearness_row(const RasterSamples& samples, const NearnessView& view, int y, int first,
                  std::span<float> nearness, Instructions instructions = best_instructions());

} // namespace frustumscreen::relief
