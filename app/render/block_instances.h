/// Which blocks of a plan's reliefs the GPU draws, as instances, and the draw calls for them (block_shader.h).
///
/// The processor lists the blocks that may face the eye and lie in the picture (relief/block_items.h), on each face front to back; the
/// GPU draws all 8 x 8 cells of each, two triangles a cell, cut at the corners (1, 0) and (0, 1) as the cast cuts them.
///
/// Threads  the render thread; `list` allocates nothing once a picture as full was listed, and `draw` nothing.
#pragma once

#include "app/relief/block_items.h"
#include "app/render/gpu_store.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace frustumscreen {

class BlockInstances {
public:
    BlockInstances();
    /// Of all of the plan's reliefs that are in the store and that the GPU draws.
    void list(const FramePlan& plan, const GpuStore& store);
    /// What `draw`, one of the plan's of a relief, shows of it, with that shader, which is in use.
    void draw(const FramePlan& plan, const Draw& draw, const GpuStore::Blocks& blocks,
              const Shader& shader) const;

private:
    struct Run {
        std::size_t cast = 0; ///< of FramePlan::casts
        int face = 0;         ///< of the prop
        std::size_t first = 0, count = 0;
    };
    BlockItems items_;
    std::vector<glm::uvec2> instances_; ///< block, direction
    std::vector<Run> runs_;
    GlVertexArray vertex_array_ = GlVertexArray::generate();
    GlBuffer corners_ = GlBuffer::generate();         ///< indices of a block's triangles
    GlBuffer instance_buffer_ = GlBuffer::generate(); ///< renewed with each picture
};

} // namespace frustumscreen
