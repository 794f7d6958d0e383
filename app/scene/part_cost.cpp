#include "app/scene/part_cost.h"

#include "app/pack/pack_relief.h"
#include "app/scene/error_estimate.h"

#include <utility>

namespace frustumscreen::scene {

namespace {

enum class Kinds { Meshes, Reliefs, Both };

std::optional<PartFrame> frame_of(std::span<const PartWays> parts, Kinds kinds, const PartCosts& costs) {
    PartFrame frame{.cost = kinds == Kinds::Reliefs  ? costs.relief_picture
                            : kinds == Kinds::Meshes ? costs.mesh_picture
                                                     : costs.mesh_picture + costs.relief_picture,
                    .ways = {}};
    for (const PartWays& part : parts) {
        if (kinds == Kinds::Reliefs && !part.relief) {
            return std::nullopt;
        }
        const bool relief = kinds == Kinds::Reliefs ||
                            (kinds == Kinds::Both && part.relief && part.relief->cost < part.mesh.cost);
        const PartWay& way = relief ? *part.relief : part.mesh;
        frame.cost += way.cost + (frame.ways.empty() ? 0.0 : costs.per_part);
        frame.ways.push_back(way);
    }
    return frame;
}

} // namespace

Result<PartWays> good_ways(const pack::PackOutline& part, double mm_per_box, double tolerance_mm,
                           const PartCosts& costs) {
    TRY(const SeenByEyes seen, seen_by_eyes(part));
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(part.description));
    PartWays ways;
    for (std::size_t level = 0; level < part.levels.size(); ++level) {
        const pack::LevelOutline& outline = part.levels[level];
        const bool enough =
            within_tolerance(outline.error, worst_of(seen.levels[level]), mm_per_box, tolerance_mm);
        const double cost = costs.per_triangle * static_cast<double>(outline.triangles);
        if (!ways.mesh.way.enough || (enough && cost < ways.mesh.cost)) {
            ways.mesh = {{.level = static_cast<std::uint32_t>(level), .enough = enough}, cost};
        }
    }
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        const double cost = costs.per_block * static_cast<double>(reliefs[k].blocks);
        if (within_tolerance(reliefs[k].error, worst_of(seen.reliefs[k]), mm_per_box, tolerance_mm) &&
            (!ways.relief || cost < ways.relief->cost)) {
            ways.relief = PartWay{{.level = reliefs[k].texels, .enough = true, .relief = true}, cost};
        }
    }
    return ways;
}

PartFrame quickest_frame(std::span<const PartWays> parts, const PartCosts& costs) {
    PartFrame best = frame_of(parts, Kinds::Meshes, costs).value();
    for (const Kinds kinds : {Kinds::Reliefs, Kinds::Both}) {
        if (std::optional<PartFrame> frame = frame_of(parts, kinds, costs);
            frame && frame->cost < best.cost) {
            best = *std::move(frame);
        }
    }
    return best;
}

bool cells_pay(double whole, double in_cells) {
    constexpr double max_share = 0.9;
    return in_cells < max_share * whole; // false for NaN
}

} // namespace frustumscreen::scene
