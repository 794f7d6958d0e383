#include "assets_baked/bake/scan_measures.h"

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

struct Unit {
    std::string_view name;
    double metres;
};
constexpr std::array<Unit, 3> units{{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}}; ///< the most usual first

/// In box units.
double area_of(const TriangleMesh& mesh) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        area += 0.5 * static_cast<double>(glm::length(mesh.area_normal(t)));
    }
    return area;
}

glm::dvec3 extents_of(const SourceMesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            low = glm::min(low, mesh.positions[vertex]);
            high = glm::max(high, mesh.positions[vertex]);
        }
    }
    return high - low;
}

bool is_painted(const SourceMesh& mesh) {
    return !mesh.textures.empty() || !mesh.colours.empty();
}

} // namespace

Result<ScanMeasures> measure_scan(const SourceMesh& mesh, const BakeOptions& options) {
    const std::string up = options.up.empty() ? std::string(1, mesh.default_up) : options.up;
    TRY(const BoxFrame frame, make_box_frame(mesh, {up, options.turn_deg, options.lift}));
    const TriangleMesh surface = weld(mesh, in_box(mesh, frame));
    TRY_VOID(check_surface(surface));
    ScanMeasures measures;
    measures.points = surface.positions.size();
    measures.extents = extents_of(mesh);
    return measures;
}

std::string_view guessed_unit(std::string_view format, double longest) {
    const auto fits = [&](const Unit& unit, double least_m, double most_m) {
        return longest * unit.metres >= least_m && longest * unit.metres <= most_m;
    };
    if (format.starts_with("gl") || format.starts_with("GL")) {
        if (fits(units[0], 0.005, 20.0)) {
            return units[0].name;
        }
    }
    // Most objects are between two centimetres and three metres.
    for (const auto& [least_m, most_m] : {std::pair(0.02, 3.0), std::pair(0.005, 20.0)}) {
        const auto unit = std::find_if(units.begin(), units.end(),
                                       [&](const Unit& each) { return fits(each, least_m, most_m); });
        if (unit != units.end()) {
            return unit->name;
        }
    }
    return {};
}

} // namespace frustumscreen
