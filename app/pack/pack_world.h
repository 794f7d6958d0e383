/// The sections `cells` and `behaviours` of a pack: the artifact as a world, a tree of cells, and what moves them.
///
/// Geometry   the pack itself holds the whole artifact at rest. Each cell's geometry is a pack of its own inside this
///            one, a part `cells/N.fspack`: its levels, reliefs and measured errors, in the cell's own box. So a
///            reader that does not know cells shows the artifact at rest. Cells that are quicker to draw than the
///            whole are drawn at rest, too.
/// Curves     of all behaviours are in one binary part, `behaviours/curves.bin`.
/// Units      box, as pack.h; seconds.
/// Errors     one line: data that FORMAT.md does not allow. Messages of `load_...` begin with the file's name. A pack
///            without the sections is no error: it has no cells.
/// Threads    pure; any.
#pragma once

#include "app/pack/pack.h"
#include "app/pack/pack_file.h"
#include "app/relief/block_relief.h"
#include "app/world/behaviour.h"
#include "app/world/cell.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::pack {

/// A cell as the manifest describes it.
struct PackCell {
    world::Cell cell;
    std::string part;               ///< its own pack; empty: no geometry
    std::uint64_t triangles = 0;    ///< of its source
    glm::dvec3 low{0.0}, high{0.0}; ///< of its geometry at rest, box frame

    [[nodiscard]] bool operator==(const PackCell&) const = default;
};
struct PackBehaviour {
    world::Behaviour behaviour;    ///< without its curves if read from the manifest alone
    std::vector<PackLabel> titles; ///< what the visitor is told ("turn the lid"), in each language

    [[nodiscard]] bool operator==(const PackBehaviour&) const = default;
};
/// Empty: an artifact without cells.
struct PackWorld {
    std::vector<PackCell> cells;
    std::vector<PackBehaviour> behaviours;
    /// The cells together are quicker to draw than the whole at the same error: they are drawn while nothing moves, too.
    bool drawn_at_rest = false;

    [[nodiscard]] bool operator==(const PackWorld&) const = default;
};

/// The tree that the cells form, for world::poses_at_rest and world::Player.
[[nodiscard]] std::vector<world::Cell> tree_of(const PackWorld& world);

/// From the manifest alone: the curves are empty.
[[nodiscard]] Result<PackWorld> world_outline_of(const PackDescription& pack);
/// The world with its curves; reads only their part and the manifest.
[[nodiscard]] Result<PackWorld> load_world(const std::filesystem::path& file);
/// A world of a pack that was read whole.
[[nodiscard]] Result<PackWorld> world_of(const Pack& pack);

/// A cell's own pack, with the levels that `choose` takes; reads only its part and the manifest.
[[nodiscard]] Result<VerifiedPack> load_cell(const std::filesystem::path& file, const PackCell& cell,
                                             const ChooseLevels& choose = {});

/// Call once for a pack. `geometry`: a pack for each cell, ignored for one without geometry; `part` is set here.
[[nodiscard]] Result<void> put_world(Pack& pack, PackWorld world, std::span<const Pack> geometry);
/// Checks both sections, the curves and each cell's own pack against FORMAT.md; `pack` was read whole.
[[nodiscard]] Result<void> check_world(const Pack& pack);

} // namespace frustumscreen::pack
