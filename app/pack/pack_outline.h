/// The levels that a pack offers, from its manifest alone: enough to choose what to read.
///
/// Units    errors in box units, as LevelError.
/// Threads  values; any.
/// Errors   those of the choice: the pack does not have the level.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace frustumscreen::pack {

struct LevelOutline {
    LevelTechnique technique = LevelTechnique::Mesh;
    LevelError error;
    std::uint64_t triangles = 0;
    std::uint64_t vertices = 0;
    std::uint32_t texture = 0; ///< index into Pack::textures

    [[nodiscard]] bool operator==(const LevelOutline&) const = default;
};

struct PackOutline {
    PackDescription description;
    std::vector<LevelOutline> levels;

    [[nodiscard]] bool operator==(const PackOutline&) const = default;
};
[[nodiscard]] PackOutline outline_of(const Pack& pack);

/// Indices of the levels to read; their textures are read with them, and the relief if one of them needs it.
using ChooseLevels = std::function<Result<std::vector<std::uint32_t>>(const PackOutline&)>;

} // namespace frustumscreen::pack
