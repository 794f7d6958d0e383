/// A relief of a synthetic pack's only level, in a frustum's directions, or in all.
#pragma once

#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/level.h"
#include "tests/render/synthetic_pack.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {

/// The bytes of all that a relief is made of.
inline std::string relief_source(const pack::Pack& pack, int texels, bool from_below) {
    std::string bytes;
    const auto add = [&](const void* begin, std::size_t size) {
        bytes.append(static_cast<const char*>(begin), size);
    };
    const pack::PackLevel& level = pack.levels[0];
    const image::Image8& texture = pack.textures[0];
    const std::array<double, 6> numbers{pack.box_size.x,        pack.box_size.y,
                                        pack.box_size.z,        static_cast<double>(texels),
                                        from_below ? 1.0 : 0.0, static_cast<double>(texture.width)};
    add(numbers.data(), sizeof(numbers));
    add(level.vertices.data(), level.vertices.size() * sizeof(level.vertices[0]));
    add(level.indices.data(), level.indices.size() * sizeof(level.indices[0]));
    add(texture.texels.data(), texture.texels.size() * sizeof(texture.texels[0]));
    return bytes;
}

/// One that was made before in this process is the same again: making them was up to half of what a test took.
inline std::shared_ptr<const relief::BlockRelief> relief_of(const pack::Pack& pack, int texels,
                                                            bool from_below = false) {
    static std::map<std::string, std::shared_ptr<const relief::BlockRelief>> made;
    std::shared_ptr<const relief::BlockRelief>& relief = made[relief_source(pack, texels, from_below)];
    if (relief == nullptr) {
        const bake::SourceMesh mesh = bake::textured_source(pack.levels[0], pack.textures[0], pack.box_size);
        const bake::SourceScene surface(mesh, mesh.positions, bake::Sides::Front);
        std::vector<pack::ReliefDirection> directions{
            pack::ReliefDirection::PlusX, pack::ReliefDirection::MinusX, pack::ReliefDirection::PlusY,
            pack::ReliefDirection::MinusY, pack::ReliefDirection::PlusZ};
        if (from_below) {
            directions.push_back(pack::ReliefDirection::MinusZ);
        }
        relief = std::make_shared<const relief::BlockRelief>(
            bake::bake_blocks({surface, pack.box_size, directions, texels}));
    }
    return relief;
}

} // namespace frustumscreen::synthetic
