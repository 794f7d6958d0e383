#include "app/pack/pack_world.h"

#include "app/pack/check_pack.h"
#include "app/pack/check_world.h"
#include "app/pack/container/limits.h"
#include "app/pack/curves_part.h"
#include "app/pack/pack_hull.h"
#include "app/pack/pack_reader.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_sections.h"
#include "app/pack/pack_site.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_torches.h"
#include "app/pack/world_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view curves_name = "behaviours/curves.bin";
/// Sections of the whole artifact, which a cell's own pack has not.
constexpr std::array<std::string_view, 5> of_the_whole{cells_section, behaviours_section, states_section,
                                                       "texts", "sounds"};

std::size_t channels_of(const PackWorld& world) {
    std::size_t channels = 0;
    for (const PackBehaviour& packed : world.behaviours) {
        channels += packed.behaviour.channels.size();
    }
    return channels;
}

/// The part of all curves; empty: no behaviour has one.
std::string part_of_curves(const PackDescription& pack) {
    const PackSection* const section = find_section(pack, behaviours_section);
    return section == nullptr || section->parts.empty() ? std::string() : section->parts.front();
}

/// Each section must name exactly its own parts.
Result<void> check_parts(const PackWorld& world, const PackDescription& pack) {
    std::vector<std::string> packs;
    for (const PackCell& cell : world.cells) {
        if (cell.cell.has_geometry) {
            packs.push_back(cell.part);
        }
    }
    const PackSection* const cells = find_section(pack, cells_section);
    const PackSection* const behaviours = find_section(pack, behaviours_section);
    const std::size_t curves = channels_of(world) == 0 ? 0 : 1;
    if ((cells != nullptr && cells->parts != packs) ||
        (behaviours != nullptr && behaviours->parts.size() != curves)) {
        return bad_input("world.parts",
                         "the sections {} and {} do not name exactly their own parts; bake the pack again",
                         cells_section, behaviours_section);
    }
    return {};
}

/// Refuses a world that is drawn at rest and has no geometry.
Result<void> check_rest(const PackWorld& world) {
    const bool has_geometry = std::any_of(world.cells.begin(), world.cells.end(),
                                          [](const PackCell& cell) { return cell.cell.has_geometry; });
    if (world.drawn_at_rest && !has_geometry) {
        return bad_input("world.nothing_at_rest",
                         "the cells are to be drawn at rest, and none has geometry; bake the pack again");
    }
    return {};
}

/// Gives each channel the next curve.
Result<void> add_curves(const std::string& part, std::span<const std::byte> bytes, PackWorld& world) {
    TRY(std::vector<StoredCurve> curves, at(part, decode_curves(bytes)));
    if (curves.size() != channels_of(world)) {
        return bad_input("world.curve_count", "{} has {} curves for {} channels; the pack is altered", part,
                         curves.size(), channels_of(world));
    }
    auto next = curves.begin();
    for (PackBehaviour& packed : world.behaviours) {
        for (world::Channel& channel : packed.behaviour.channels) {
            if (next->components != components_of(channel.path)) {
                return bad_input("world.curve_values",
                                 "{}: curve {} has values of {} numbers, its channel {}; the pack is altered",
                                 part, next - curves.begin(), next->components, components_of(channel.path));
            }
            channel.curve = std::move(next->curve);
            ++next;
        }
    }
    return {};
}

Bytes curves_of(const PackWorld& world) {
    std::vector<StoredCurve> curves;
    for (const PackBehaviour& packed : world.behaviours) {
        for (const world::Channel& channel : packed.behaviour.channels) {
            curves.push_back({channel.curve, components_of(channel.path)});
        }
    }
    return encode_curves(curves);
}

Result<void> check_nested(const PackDescription& pack) {
    const auto is_of_the_whole = [](const PackSection& section) {
        return std::find(of_the_whole.begin(), of_the_whole.end(), section.name) != of_the_whole.end();
    };
    if (!pack.captions.empty() || !pack.hotspots.empty() ||
        std::any_of(pack.sections.begin(), pack.sections.end(), is_of_the_whole)) {
        return bad_input("world.nested", "a cell's own pack has cells, behaviours, states, hotspots or "
                                         "texts; only the artifact's has these");
    }
    TRY(const PackTorches torches, torches_of(pack));
    if (!torches.contents.empty()) {
        return bad_input("world.nested_torches",
                         "a cell's own pack has contents for a torch; only the artifact's has these");
    }
    return {};
}

/// `part`: the cell's own pack.
Result<VerifiedPack> read_nested(std::span<const std::byte> part, const ChooseLevels& choose) {
    TRY(PackReader reader, PackReader::open(part));
    if (reader.zip().find(signature_name) != nullptr) {
        return bad_input("world.nested_signature",
                         "a cell's own pack is signed; the artifact's signature is for all of it");
    }
    TRY_VOID(check_nested(reader.manifest().description));
    return read_pack(reader, choose);
}

/// The box of a cell at rest must lie where its own pack puts its box.
Result<void> check_place(const PackCell& cell, const glm::dmat4& box_from_geometry,
                         const PackDescription& pack) {
    constexpr double tolerance = 1e-2; // box units
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::dvec3& corner : corners_of_box(pack)) {
        const glm::dvec3 there(box_from_geometry * glm::dvec4(corner, 1.0));
        low = glm::min(low, there);
        high = glm::max(high, there);
    }
    const glm::dvec3 beyond = glm::max(low - cell.low, cell.high - high);
    if (!(std::max({beyond.x, beyond.y, beyond.z}) <= tolerance)) {
        return bad_input("world.nested_box",
                         "cell '{}' has a box that its own pack does not reach at rest; bake the pack again",
                         printable(cell.cell.name, 40));
    }
    return {};
}

/// A torch finds a cell's layer by its number.
Result<void> check_same_layers(const PackCell& cell, const PackDescription& nested,
                               const PackDescription& whole) {
    TRY(const PackTorches its, torches_of(nested));
    TRY(const PackTorches all, torches_of(whole));
    const bool same = std::equal(its.layers.begin(), its.layers.end(), all.layers.begin(), all.layers.end(),
                                 [](const PackLayer& a, const PackLayer& b) { return a.name == b.name; });
    if (!same) {
        return bad_input("world.nested_layers",
                         "cell '{}' has other layers for a torch than the artifact; bake the pack again",
                         printable(cell.cell.name, 40));
    }
    return {};
}

Result<void> check_cell_pack(const PackCell& cell, const glm::dmat4& box_from_geometry, const Pack& pack) {
    TRY(const VerifiedPack nested, at(cell.part, read_nested(pack.section_parts.at(cell.part), {})));
    TRY_VOID(at(cell.part, check_reliefs(*nested)));
    TRY_VOID(at(cell.part, check_torches(*nested)));
    TRY_VOID(check_same_layers(cell, *nested, pack));
    return check_place(cell, box_from_geometry, *nested);
}

std::vector<world::CellPose> poses_of(const PackWorld& world) {
    return world::poses_at_rest(tree_of(world));
}

/// Puts the cells' packs among the parts of the pack, and their names into the cells.
Result<void> put_geometry(Pack& pack, PackWorld& world, std::span<const Pack> geometry,
                          PackSection& section) {
    const std::vector<world::CellPose> poses = poses_of(world);
    std::uint64_t together = 0;
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        PackCell& packed = world.cells[k];
        packed.part.clear();
        if (!packed.cell.has_geometry) {
            continue;
        }
        const std::string place = fmt::format("cell '{}'", printable(packed.cell.name, 40));
        TRY_VOID(at(place, check_nested(geometry[k])));
        TRY_VOID(check_place(packed, poses[k].box_from_geometry, geometry[k]));
        TRY(Bytes bytes, at(place, write_pack(geometry[k])));
        together += bytes.size();
        if (bytes.size() > max_part_bytes || together > max_parts_bytes) {
            return bad_input(
                "world.too_large",
                "{} has {} bytes, {} with the cells before it; allowed are {} for a cell and {} for "
                "all: bake with a smaller --size or fewer cells",
                place, bytes.size(), together, max_part_bytes, max_parts_bytes);
        }
        packed.part = fmt::format("{}/{}.fspack", cells_section, k);
        section.parts.push_back(packed.part);
        pack.section_parts[packed.part] = std::move(bytes);
    }
    return {};
}

} // namespace

std::vector<world::Cell> tree_of(const PackWorld& world) {
    std::vector<world::Cell> tree;
    for (const PackCell& cell : world.cells) {
        tree.push_back(cell.cell);
    }
    return tree;
}

Result<PackWorld> world_outline_of(const PackDescription& pack) {
    TRY(PackWorld world, read_world_sections(pack));
    TRY_VOID(check_parts(world, pack));
    TRY_VOID(check_cells(world.cells, pack));
    TRY_VOID(check_rest(world));
    TRY_VOID(check_behaviours(world, pack, Curves::NotRead));
    return world;
}

Result<PackWorld> load_world(const std::filesystem::path& file) {
    PackWorld world;
    PackDescription description;
    std::string part;
    const auto choose = [&](const PackDescription& pack) -> Result<std::vector<std::string>> {
        TRY(world, world_outline_of(pack));
        description = pack;
        part = part_of_curves(pack);
        return part.empty() ? std::vector<std::string>() : std::vector{part};
    };
    TRY(const auto parts, load_section_parts(file, choose));
    if (!part.empty()) {
        TRY_VOID(at(file.string(), add_curves(part, parts.at(part), world).and_then([&] {
            return check_behaviours(world, description, Curves::Read);
        })));
    }
    return world;
}

Result<PackWorld> world_of(const Pack& pack) {
    TRY(PackWorld world, world_outline_of(pack));
    if (const std::string part = part_of_curves(pack); !part.empty()) {
        TRY_VOID(add_curves(part, pack.section_parts.at(part), world));
        TRY_VOID(check_behaviours(world, pack, Curves::Read));
    }
    return world;
}

Result<VerifiedPack> load_cell(const std::filesystem::path& file, const PackCell& cell,
                               const ChooseLevels& choose) {
    const auto its_part = [&](const PackDescription& pack) -> Result<std::vector<std::string>> {
        TRY(const PackWorld world, world_outline_of(pack));
        if (cell.part.empty() ||
            std::find(world.cells.begin(), world.cells.end(), cell) == world.cells.end()) {
            return bad_input("world.cell_gone", "it no longer has the geometry of cell '{}'",
                             printable(cell.cell.name, 40));
        }
        return std::vector{cell.part};
    };
    TRY(const auto parts, load_section_parts(file, its_part));
    return at(file.string(), at(cell.part, read_nested(parts.at(cell.part), choose)));
}

Result<void> put_world(Pack& pack, PackWorld world, std::span<const Pack> geometry) {
    assert(geometry.size() == world.cells.size());
    assert(find_section(pack, cells_section) == nullptr && find_section(pack, behaviours_section) == nullptr);
    TRY_VOID(check_cells(world.cells, pack));
    TRY_VOID(check_rest(world));
    TRY_VOID(check_behaviours(world, pack, Curves::Read));
    PackSection cells{std::string(cells_section), {}, {}};
    PackSection behaviours{std::string(behaviours_section), {}, {}};
    TRY_VOID(put_geometry(pack, world, geometry, cells));
    if (channels_of(world) > 0) {
        behaviours.parts.emplace_back(curves_name);
        pack.section_parts[std::string(curves_name)] = curves_of(world);
    }
    cells.data = write_cells(world);
    behaviours.data = write_behaviours(world.behaviours);
    if (!world.cells.empty()) {
        pack.sections.push_back(std::move(cells));
    }
    if (!world.behaviours.empty()) {
        pack.sections.push_back(std::move(behaviours));
    }
    return {};
}

Result<void> check_world(const Pack& pack) {
    TRY(const PackWorld world, world_of(pack));
    TRY_VOID(without_value(site_regions_of(pack)));
    const std::vector<world::CellPose> poses = poses_of(world);
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        if (world.cells[k].cell.has_geometry) {
            TRY_VOID(check_cell_pack(world.cells[k], poses[k].box_from_geometry, pack));
        }
    }
    return {};
}

} // namespace frustumscreen::pack
