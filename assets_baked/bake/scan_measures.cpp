#include "assets_baked/bake/scan_measures.h"

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/measured_reliefs.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::bake {

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

// Each of the following is a rule whose numbers were fitted to fourteen scans of 600 to a million triangles
// (docs/measurements.md). Areas are in box units.
constexpr double manifest_bytes = 6e4; ///< and the picture for the table

/// All levels together; those of a large scan have not many more triangles than those of a medium one.
double level_bytes(double triangles) {
    constexpr double triangle_bytes = 10.5;
    constexpr double levels = 3.2; ///< triangles of all levels for each of the scan
    constexpr double medium = 1.5e5;
    const double counted = triangles <= medium ? triangles : medium * std::pow(triangles / medium, 0.4);
    return triangle_bytes * levels * counted;
}

double texture_bytes(double area, bool is_painted, int size) {
    return (is_painted ? 1.6 : 0.6) * area * size * size;
}

/// Blocks cover the area and lie along outlines; their number grows with the square of the resolution, and with the
/// resolution.
double relief_bytes(double area, int size) {
    constexpr double block_bytes = 190.0;
    double blocks = 0.0;
    for (const int texels : relief_texels(size)) {
        blocks += 0.5 * area * texels * texels / 64.0 + 8.0 * texels * std::sqrt(std::min(area, 1.0));
    }
    return block_bytes * blocks;
}

/// A small scan is shown nearly whole, a large one at a level of some ten thousand triangles.
double shown_triangles(double triangles) {
    constexpr double small = 6e3;
    constexpr double medium = 1e5;
    constexpr double medium_shown = 2.7e4;
    return triangles <= small
               ? 0.85 * triangles
               : medium_shown * std::pow(triangles / medium, triangles <= medium ? 0.59 : 0.25);
}

/// Two digits, as an estimate has no more.
std::uint64_t rounded(double value) {
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(std::max(value, 1.0))) - 1.0));
    return static_cast<std::uint64_t>(unit * std::round(value / unit));
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
    TRY(const BoxFrame frame, make_box_frame(mesh, {up, 0.0, options.lift}));
    const TriangleMesh surface = weld(mesh, in_box(mesh, frame));
    TRY_VOID(check_surface(surface));
    ScanMeasures measures;
    measures.points = surface.positions.size();
    measures.extents = extents_of(mesh);
    const auto triangles = static_cast<double>(surface.triangle_count());
    const double area = area_of(surface);
    const double bytes = manifest_bytes + level_bytes(triangles) +
                         texture_bytes(area, is_painted(mesh), options.size) +
                         (options.relief ? relief_bytes(area, options.size) : 0.0);
    measures.estimated_bytes = rounded(bytes);
    measures.estimated_triangles = rounded(shown_triangles(triangles));
    return measures;
}

std::string_view guessed_unit(std::string_view format, double longest) {
    const auto fits = [&](const Unit& unit, double min_m, double max_m) {
        return longest * unit.metres >= min_m && longest * unit.metres <= max_m;
    };
    if (format.starts_with("gl") || format.starts_with("GL")) {
        if (fits(units[0], 0.005, 20.0)) {
            return units[0].name;
        }
    }
    // Most objects are between two centimetres and three metres.
    for (const auto& [min_m, max_m] : {std::pair(0.02, 3.0), std::pair(0.005, 20.0)}) {
        const auto unit = std::find_if(units.begin(), units.end(),
                                       [&](const Unit& each) { return fits(each, min_m, max_m); });
        if (unit != units.end()) {
            return unit->name;
        }
    }
    return {};
}

} // namespace frustumscreen::bake
