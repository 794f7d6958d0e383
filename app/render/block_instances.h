/// The blocks of a plan's reliefs that the GPU draws, as instances, and their draw calls (block_shader.h).
///
/// The processor lists the blocks that may face the eye, or are turned away, and lie in the picture (relief/block_items.h), on
/// each face front to back. The GPU draws all 8 x 8 cells of each, two triangles a cell, split along the
/// diagonal from (1, 0) to (0, 1), as on the processor.
///
/// Threads  the render thread. `list` allocates nothing once it has listed a picture as full; `draw`
///          allocates nothing.
#pragma once

#include "app/relief/block_items.h"
#include "app/render/gpu_store.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace frustumscreen::render {

class BlockInstances {
public:
    BlockInstances();
    /// Lists the plan's reliefs that are in the store and that the GPU draws.
    void list(const scene::FramePlan& plan, const GpuStore& store, relief::Facing facing);
    /// Draws a relief's blocks for `draw`, one of the plan's draws, with `shader`, which must be in use.
    /// `places_from_box`: to the frame of the places that the shader takes.
    void draw(const scene::FramePlan& plan, const scene::Draw& draw, const glm::dmat4& places_from_box,
              const GpuStore::Blocks& blocks, const Shader& shader) const;

private:
    struct Run {
        std::size_t relief_draw = 0; ///< index into FramePlan::relief_draws
        int face = 0;                ///< index into the prop's faces
        std::size_t first = 0, count = 0;
    };
    relief::BlockItems items_;
    std::vector<glm::uvec2> instances_; ///< block, direction
    std::vector<Run> runs_;
    gl::GlVertexArray vertex_array_ = gl::GlVertexArray::generate();
    gl::GlBuffer corners_ = gl::GlBuffer::generate();         ///< indices of a block's triangles
    gl::GlBuffer instance_buffer_ = gl::GlBuffer::generate(); ///< refilled for each picture
};

} // namespace frustumscreen::render
