/// Which of an artifact's clusters may show on one face of the prop.
///
/// Frames   box (pack.h).
/// Threads  pure; any. Allocates nothing if `ranges` has room.
#pragma once

#include "app/pack/pack.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen {

/// A run of a level's indices that is drawn with one call.
struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    [[nodiscard]] bool operator==(const IndexRange&) const = default;
};

/// What one face shows: the half spaces a.X + d >= 0 (a unit) of the face's pyramid and the picture's four
/// edges.
struct FaceVolume {
    std::array<glm::dvec4, 9> half_spaces{};
    std::size_t count = 0;
    glm::dvec3 eye{0.0};

    /// Scales to a unit normal; a degenerate or non-finite half space is left out.
    void add(const glm::dvec4& half_space);
};

/// Appends the ranges of the clusters that may show, runs of neighbours as one. Conservative: a cluster that
/// is left out has no front-facing point inside the volume, with `margin_box` to spare for the rasterizer's
/// rounding.
void append_visible(const FaceVolume& volume, std::span<const PackCluster> clusters,
                    std::vector<IndexRange>& ranges, double margin_box = 1e-3);

} // namespace frustumscreen
