/// One direction's layers, before they are packed: samples on a grid, linked into charts.
///
/// Frame    box; grid coordinates in texels across the direction.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/pack/pack.h"
#include "assets_baked/bake/source_scene.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace frustumscreen {

/// A box face that rays start from. Axes and sign as in ReliefDirection.
struct DirectionFrame {
    int axis_u, axis_v, axis_n;
    float sign;

    [[nodiscard]] glm::vec3 normal() const {
        glm::vec3 n(0.0F);
        n[axis_n] = sign;
        return n;
    }
};
[[nodiscard]] DirectionFrame frame_of(ReliefDirection direction);

struct ReliefSample {
    std::int32_t x = 0, y = 0;
    float height = 0.0F; ///< box coordinate along the direction's axis
    bool core = false;   ///< this direction sees the sample best
    glm::vec3 colour{0.0F};
};

/// The pieces of one direction. Charts are indices into `samples`; no two of a chart share a texel.
struct DirectionLayers {
    std::vector<ReliefSample> samples;
    std::vector<std::vector<std::uint32_t>> charts;
};

/// What all directions share.
struct LayerInput {
    const SourceScene& source;
    const SourceScene& visible_scene;
    glm::vec3 box_size;
    float texel_box;
    std::vector<glm::vec3> normals; ///< of all directions
};

[[nodiscard]] DirectionLayers make_layers(const LayerInput& input, ReliefDirection direction);

} // namespace frustumscreen
