#include "app/scene/part_cost.h"

#include "app/pack/pack_relief.h"
#include "app/scene/error_estimate.h"

#include <algorithm>
#include <vector>

namespace frustumscreen::scene {

Result<PartWay> quickest_way(const pack::PackOutline& part, double mm_per_box, double tolerance_mm,
                             const PartCosts& costs) {
    TRY(const SeenByEyes seen, seen_by_eyes(part));
    TRY(const std::vector<pack::ReliefOutline> reliefs, pack::reliefs_of(part.description));
    PartWay best;
    const auto offer = [&](const PartWay& way) {
        const bool is_better = way.way.enough && (!best.way.enough || way.cost < best.cost);
        best = is_better ? way : best;
    };
    for (std::size_t level = 0; level < part.levels.size(); ++level) {
        const pack::LevelOutline& outline = part.levels[level];
        const bool enough =
            within_tolerance(outline.error, worst_of(seen.levels[level]), mm_per_box, tolerance_mm);
        const PartWay way{{.level = static_cast<std::uint32_t>(level), .enough = enough},
                          costs.per_triangle * static_cast<double>(outline.triangles)};
        best = level + 1 == part.levels.size() && !best.way.enough ? way : best;
        offer(way);
    }
    for (std::size_t k = 0; k < reliefs.size(); ++k) {
        const bool enough =
            within_tolerance(reliefs[k].error, worst_of(seen.reliefs[k]), mm_per_box, tolerance_mm);
        offer({{.level = reliefs[k].texels, .enough = enough, .relief = true},
               costs.per_block * static_cast<double>(reliefs[k].blocks)});
    }
    return best;
}

double frame_cost(std::span<const PartWay> parts, const PartCosts& costs) {
    double sum = costs.picture;
    for (const PartWay& part : parts) {
        sum += part.cost;
    }
    return sum + costs.per_part * static_cast<double>(std::max<std::size_t>(parts.size(), 1) - 1);
}

bool cells_pay(double whole, double in_cells) {
    constexpr double max_share = 0.9;
    return in_cells < max_share * whole; // false for NaN
}

} // namespace frustumscreen::scene
