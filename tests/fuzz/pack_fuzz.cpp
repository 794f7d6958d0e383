// A pack: refused in one line, or everything that a renderer relies on holds; written again it is an equal
// pack. pack_mutator.cpp corrects the hashes, so the fuzzer gets past them.
#include "app/pack/pack_contents.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_hull.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_texts.h"
#include "app/pack/pack_world.h"
#include "app/pack/seen_errors.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

void require_usable(const pack::Pack& pack, const pack::PackLevel& level) {
    fuzz::require(level.texture < pack.textures.size(), "a level's texture is there");
    const image::Image8& texture = pack.textures[level.texture];
    fuzz::require(!texture.texels.empty() &&
                      texture.texels.size() ==
                          static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height),
                  "a texture has its texels");
    fuzz::require(!level.indices.empty() && std::all_of(level.indices.begin(), level.indices.end(),
                                                        [&](auto i) { return i < level.vertices.size(); }),
                  "every index has its vertex");
    std::size_t next = 0;
    for (const pack::PackCluster& cluster : level.clusters) {
        fuzz::require(cluster.first_index == next && cluster.index_count % 3 == 0, "clusters have no gaps");
        next += cluster.index_count;
        fuzz::require(fuzz::is_finite(cluster.centre) && fuzz::is_finite(cluster.cone_apex) &&
                          fuzz::is_finite(cluster.cone_axis) && cluster.radius >= 0.0F &&
                          std::isfinite(cluster.radius) && std::isfinite(cluster.cone_cutoff),
                      "a cluster's numbers are finite");
    }
    fuzz::require(next == level.indices.size(), "clusters cover all indices");
}

void require_usable(const pack::Pack& pack) {
    fuzz::require(pack.default_level < pack.levels.size(), "the default level is there");
    const pack::Placement placement = pack::place(pack, geometry::make_frustum({}));
    fuzz::require(placement.metres_per_box > 0.0 && std::isfinite(placement.metres_per_box), "it has a size");
    for (int column = 0; column < 4; ++column) {
        fuzz::require(fuzz::is_finite(placement.prop_from_artifact[column]), "it has a place");
    }
    for (const pack::PackLevel& level : pack.levels) {
        require_usable(pack, level);
    }
    const Result<pack::SeenErrors> seen = pack::seen_errors_of(pack, pack.levels.size());
    fuzz::require(!seen || seen->eyes.empty() || seen->levels.size() == pack.levels.size(),
                  "what is seen is of every level");
    const auto hull = pack::hull_of(pack);
    fuzz::require(!hull || !hull->empty(), "a hull has corners");
}

/// A level read alone equals the level read with all others.
void require_same_chosen(std::span<const std::byte> bytes, const pack::Pack& pack) {
    const auto only_default = [](const pack::PackOutline& outline) {
        return Result<std::vector<std::uint32_t>>(std::vector{outline.description.default_level});
    };
    const auto chosen = pack::verify_pack(bytes, only_default);
    fuzz::require(chosen.has_value(), "a part of a good pack is good");
    const pack::PackLevel& a = pack.levels[pack.default_level];
    const pack::PackLevel& b = (*chosen)->levels[pack.default_level];
    fuzz::require(a.indices == b.indices && a.vertices.size() == b.vertices.size() && a.texture == b.texture,
                  "a level does not depend on the others");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    const auto parts = pack::list_pack_parts(bytes);
    const auto pack = pack::verify_pack(bytes);
    if (!parts) {
        fuzz::require_one_line(parts.error().message);
    }
    if (!pack) {
        fuzz::require_one_line(pack.error().message);
        return 0;
    }
    fuzz::require(parts.has_value(), "a pack's parts can be listed");
    require_usable(**pack);
    require_same_chosen(bytes, **pack);
    const Result<void> set_and_spoken = pack::check_set_and_spoken(**pack);
    if (!set_and_spoken) {
        fuzz::require_one_line(set_and_spoken.error().message);
    }
    fuzz::require(!set_and_spoken || pack::list_sounds(**pack).has_value(),
                  "sounds that are checked can be listed");
    if (const Result<void> reliefs = pack::check_reliefs(**pack); !reliefs) {
        fuzz::require_one_line(reliefs.error().message);
    }
    if (const Result<void> torches = pack::check_torches(**pack); !torches) {
        fuzz::require_one_line(torches.error().message);
    }
    if (const Result<void> world = pack::check_world(**pack); !world) {
        fuzz::require_one_line(world.error().message);
    }
    const auto written = pack::write_pack(**pack);
    fuzz::require(written.has_value(), "what was read can be written",
                  written ? std::string() : written.error().message);
    const auto again = pack::verify_pack(*written);
    fuzz::require(again.has_value(), "what was written is read",
                  again ? std::string() : again.error().message);
    fuzz::require(pack::write_pack(**again) == *written, "a pack written again is the same");
    return 0;
}
