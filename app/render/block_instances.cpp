#include "app/render/block_instances.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace frustumscreen::render {

namespace {

constexpr std::size_t cells = std::size_t{relief::block_cells} * relief::block_cells;
constexpr std::array<std::uint16_t, 6> corners_of_cell{0, 1, 2, 3, 2, 1};
constexpr std::size_t indices_of_block = cells * corners_of_cell.size();
constexpr std::size_t max_directions = 6;

std::array<std::uint16_t, indices_of_block> indices() {
    std::array<std::uint16_t, indices_of_block> made{};
    for (std::size_t k = 0; k < made.size(); ++k) {
        made[k] = static_cast<std::uint16_t>(4 * (k / corners_of_cell.size()) +
                                             corners_of_cell[k % corners_of_cell.size()]);
    }
    return made;
}

/// Sets the matrices of each direction's grid, computed in 64-bit arithmetic. `prop_from_box`: or into a torch's frame.
void set_grids(const relief::BlockRelief& relief, const scene::Draw& draw, const glm::dmat4& prop_from_box,
               const Shader& shader) {
    std::array<glm::mat4, max_directions> clip{};
    std::array<glm::mat4, max_directions> prop{};
    GLuint mirrored = 0;
    for (std::size_t k = 0; k < relief.grids.size(); ++k) {
        const glm::dmat4 box = relief::box_from_grid(relief.grids[k], static_cast<double>(relief.texel_box));
        clip[k] = glm::mat4(draw.clip_from_box * box);
        prop[k] = glm::mat4(prop_from_box * box);
        mirrored |= glm::determinant(glm::dmat3(prop_from_box * box)) < 0.0 ? 1U << k : 0U;
    }
    const auto count = static_cast<GLsizei>(relief.grids.size());
    glUniformMatrix4fv(shader.location(Uniform::ClipFromGrid), count, GL_FALSE, glm::value_ptr(clip[0]));
    glUniformMatrix4fv(shader.location(Uniform::PropFromGrid), count, GL_FALSE, glm::value_ptr(prop[0]));
    glUniform1ui(shader.location(Uniform::Mirrored), mirrored);
}

} // namespace

BlockInstances::BlockInstances() {
    const auto triangles = indices();
    glBindVertexArray(vertex_array_.get());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners_.get());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(sizeof triangles), triangles.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribDivisor(0, 1);
    glBindVertexArray(0);
}

void BlockInstances::list(const scene::FramePlan& plan, const GpuStore& store, relief::Facing facing) {
    instances_.clear();
    runs_.clear();
    for (std::size_t relief_draw = 0; relief_draw < plan.relief_draw_count; ++relief_draw) {
        const scene::ReliefDraw& planned = plan.relief_draws[relief_draw];
        const relief::BlockRelief* const relief =
            planned.on_gpu ? store.find_relief(planned.relief) : nullptr;
        if (relief == nullptr) {
            continue;
        }
        relief::list_blocks(items_, *relief, planned.view, relief::best_instructions(), facing);
        for (std::size_t face = 0; face < planned.view.faces.size(); ++face) {
            const std::size_t first = instances_.size();
            for (const relief::BlockItem& item : items_.sorted) {
                if (item.face == face) {
                    instances_.emplace_back(item.block, item.direction);
                }
            }
            runs_.push_back({.relief_draw = relief_draw,
                             .face = planned.view.faces[face].face,
                             .first = first,
                             .count = instances_.size() - first});
        }
    }
    if (!runs_.empty()) {
        glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.get());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances_.size() * sizeof(glm::uvec2)),
                     instances_.data(), GL_STREAM_DRAW);
    }
}

void BlockInstances::draw(const scene::FramePlan& plan, const scene::Draw& draw,
                          const glm::dmat4& places_from_box, const GpuStore::Blocks& blocks,
                          const Shader& shader) const {
    const int face = plan.faces[static_cast<std::size_t>(draw.face)].face;
    const auto run = std::find_if(runs_.begin(), runs_.end(), [&](const Run& each) {
        return each.relief_draw == draw.relief_draw && each.face == face;
    });
    if (run == runs_.end() || run->count == 0) {
        return;
    }
    set_grids(*blocks.relief, draw, places_from_box, shader);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, blocks.numbers.get());
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, blocks.covers.get());
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(vertex_array_.get());
    glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.get());
    const std::uintptr_t offset = run->first * sizeof(glm::uvec2);
    glVertexAttribIPointer(
        0, 2, GL_UNSIGNED_INT, sizeof(glm::uvec2),
        // OpenGL ES takes an offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
        reinterpret_cast<const void*>(offset));
    glDrawElementsInstanced(GL_TRIANGLES, indices_of_block, GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(run->count));
}

} // namespace frustumscreen::render
