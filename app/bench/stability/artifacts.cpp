// Variations of the authored artifact: its scale, its distance from the origin, its shape and its size.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/shapes.h"
#include "app/bench/stability/themes.h"
#include "app/pack/pack_file.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/level.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace frustumscreen::bench {

namespace {

constexpr std::array scales{1e-6, 1e-3, 1.0, 1e3, 1e6};

/// Bounds of the mesh, in long double.
struct Bounds {
    exact::Vector low{1e30L, 1e30L, 1e30L}, high{-1e30L, -1e30L, -1e30L};

    explicit Bounds(const bake::SourceMesh& mesh) {
        for (const glm::dvec3& p : mesh.positions) {
            low = {std::min<exact::Real>(low.x, p.x), std::min<exact::Real>(low.y, p.y),
                   std::min<exact::Real>(low.z, p.z)};
            high = {std::max<exact::Real>(high.x, p.x), std::max<exact::Real>(high.y, p.y),
                    std::max<exact::Real>(high.z, p.z)};
        }
    }
    [[nodiscard]] exact::Real longest() const {
        const exact::Vector size = high - low;
        return std::max({size.x, size.y, size.z});
    }
    [[nodiscard]] exact::Vector in_box(const glm::dvec3& p) const {
        const exact::Vector foot{0.5L * (low.x + high.x), 0.5L * (low.y + high.y), low.z};
        return (1 / longest()) * (exact::of(p) - foot);
    }
};

/// The largest scale that keeps every point in the prop; tests all points against all planes.
exact::Real exact_scale(const geometry::PropShape& prop, const bake::SourceMesh& mesh, const Bounds& bounds) {
    exact::Real scale = std::numeric_limits<exact::Real>::infinity();
    for (const geometry::PropFace& face : prop.faces) {
        const exact::Vector a = exact::of(face.corners[0]);
        const exact::Vector normal =
            exact::cross(exact::of(face.corners[1]) - a, exact::of(face.corners[2]) - a);
        for (const glm::dvec3& p : mesh.positions) {
            const exact::Real reach = exact::dot(normal, bounds.in_box(p));
            scale = reach > 0 ? std::min(scale, exact::dot(normal, a) / reach) : scale;
        }
    }
    return scale;
}

struct PlacingErrors {
    double box = 1.0;    ///< error of in_box, box units
    double scale = 1.0;  ///< error of the placement, relative
    double matrix = 1.0; ///< error of prop_from_artifact, box units
};
PlacingErrors placing_errors(const bake::SourceMesh& mesh) {
    const Result<bake::BoxFrame> frame = bake::make_box_frame(mesh, {"z"});
    if (!frame) {
        return {};
    }
    PlacingErrors errors{0.0, 0.0, 0.0};
    const Bounds bounds(mesh);
    const std::vector<glm::dvec3> points = bake::in_box(mesh, *frame);
    pack::Pack pack;
    pack.box_size = frame->box_size;
    pack.box_from_file = frame->box_from_file;
    pack.extremes = bake::profile_extremes(points);
    const geometry::PropShape prop = geometry::make_frustum({});
    const pack::Placement placement = pack::place(pack, prop);
    const exact::Real scale = exact_scale(prop, mesh, bounds);
    errors.scale = static_cast<double>(std::abs(placement.metres_per_box / scale - 1));
    for (std::size_t k = 0; k < points.size(); ++k) {
        const exact::Vector truth = bounds.in_box(mesh.positions[k]);
        errors.box = std::fmax(errors.box, static_cast<double>(exact::length(exact::of(points[k]) - truth)));
        const glm::dvec3 placed(placement.prop_from_artifact * glm::dvec4(mesh.positions[k], 1.0));
        errors.matrix = std::fmax(
            errors.matrix, static_cast<double>(exact::length((1 / scale) * exact::of(placed) - truth)));
    }
    return errors;
}

StabilityResult placing(const StabilityOptions&) {
    StabilityResult result;
    for (const double offset : {0.0, 1e6}) {
        for (const double scale : scales) {
            bake::SourceMesh mesh = sphere(glm::dvec3(0.0), scale, 24);
            for (glm::dvec3& p : mesh.positions) { // flattened, so that a side of the prop limits the scale
                p = p * glm::dvec3(1.0, 0.9, 0.5) + glm::dvec3(offset, -offset, 0.7 * offset);
            }
            const PlacingErrors errors = placing_errors(mesh);
            const std::string where = fmt::format("radius {:g}, offset {:g}: ", scale, offset);
            // Rounding of a number of the box's size; the matrix rounds at the magnitude of the origin's
            // distance.
            const double away = 1.0 + offset / scale;
            result.rows.push_back({where + "points in the box, box units", 4 * 0x1p-53, errors.box});
            result.rows.push_back({where + "scale into the prop, relative", 4 * 0x1p-53, errors.scale});
            result.rows.push_back(
                {where + "points by the one matrix, box units", 8 * 0x1p-53 * away, errors.matrix});
        }
    }
    return result;
}

/// Largest distance of a level's corners from a sphere that fills the box, box units.
double off_sphere(const pack::Pack& pack, const pack::PackLevel& level) {
    exact::Real off = 0.0L;
    const bake::TriangleMesh surface = bake::surface_of(level, pack.box_size);
    for (const glm::vec3& p : surface.positions) {
        const exact::Vector from_centre{p.x, p.y, static_cast<exact::Real>(p.z) - 0.5L};
        off = std::max(off, std::abs(exact::length(from_centre) - 0.5L));
    }
    return static_cast<double>(off);
}

StabilityResult baked(const StabilityOptions&) {
    StabilityResult result;
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const auto& [scale, offset] : {std::pair{1.0, 0.0}, std::pair{1e-6, 0.0}, std::pair{1e6, 0.0},
                                        std::pair{1e-6, 1e6}, std::pair{1.0, 1e6}}) {
        bake::BakeOptions options;
        options.size = 32;
        options.unlit = true;
        const Result<pack::Pack> pack = bake::bake(sphere(glm::dvec3(offset), scale, 12), options);
        const std::string where = fmt::format("radius {:g}, offset {:g}: ", scale, offset);
        if (!pack) {
            result.rows.push_back({where + "refused: " + pack.error().message, 0.0, 1.0});
            continue;
        }
        const Result<Bytes> bytes = pack::write_pack(*pack);
        const bool written = bytes && pack::verify_pack(*bytes);
        const double metres = pack::place(*pack, geometry::make_frustum({})).metres_per_box;
        least = std::fmin(least, metres);
        most = std::fmax(most, metres);
        result.rows.push_back({where + "pack not written or not verified", 0.0, written ? 0.0 : 1.0});
        // The finest level's own tolerance, half a 16-bit step each way, and the rounding of the input
        // itself.
        const double input = offset * 0x1p-53 / (2.0 * scale) * 4.0;
        result.rows.push_back({where + "finest level off the sphere, box units", 6e-5 + 1.0 / 65535.0 + input,
                               off_sphere(*pack, pack->levels.back())});
    }
    result.rows.push_back(
        {"scale into the prop, between all of them, relative", 0x1p-50, most / least - 1.0});
    return result;
}

/// An artifact of any size makes an identical plan, which does not depend on the number of triangles.
StabilityResult many_triangles(const StabilityOptions& options) {
    const exact::SetUp set_up = usual_set_up();
    const SeenArtifact artifact = seen_artifact(set_up, options.triangles);
    return {rows_of(figures_of(set_up, artifact, plan_of(set_up, artifact)),
                    fmt::format("{} triangles: ", options.triangles), bound_px / 0.2, gpu_bound_px / 0.2)};
}

} // namespace

std::vector<StabilityCase> artifact_cases() {
    const std::string theme = "artifact";
    return {{theme, "scale 1e-6 to 1e6, offset 1e6: placed", FloatingPoint::Strict, placing},
            {theme, "scale 1e-6 to 1e6, offset 1e6: baked", FloatingPoint::Free, baked},
            {theme, "many triangles", FloatingPoint::Strict, many_triangles}};
}

} // namespace frustumscreen::bench
