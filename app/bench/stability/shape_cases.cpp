// Degenerate shapes: slivers, coplanar duplicates, a rod and a sheet, one triangle, nothing.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/shapes.h"
#include "app/bench/stability/themes.h"
#include "app/pack/pack_file.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/level.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen::bench {

namespace {

Result<pack::Pack> baked(const bake::SourceMesh& mesh) {
    bake::BakeOptions options;
    options.size = 64;
    options.unlit = true;
    return bake::bake(mesh, options);
}

/// Checks properties of every pack: it can be written and verified, its error figures are numbers, its
/// picture is finite.
void add_soundness(const Result<pack::Pack>& pack, StabilityResult& result) {
    if (!pack) {
        result.rows.push_back({"refused: " + pack.error().message, 0.0, 1.0});
        return;
    }
    const Result<Bytes> bytes = pack::write_pack(*pack);
    result.rows.push_back(
        {"pack not written or not verified", 0.0, bytes && pack::verify_pack(*bytes) ? 0.0 : 1.0});
    double not_finite = 0.0;
    PictureFigures picture;
    for (std::uint32_t level = 0; level < pack->levels.size(); ++level) {
        const pack::LevelError& error = pack->levels[level].error;
        for (const float figure : {error.mean_box, error.p95_box, error.max_box, error.colour_rmse}) {
            not_finite += std::isfinite(figure) ? 0.0 : 1.0;
        }
        for (const glm::dvec3& eye : {glm::dvec3(0.1, -0.55, 0.5), glm::dvec3(-0.5, 0.3, 0.2)}) {
            exact::SetUp set_up = usual_set_up();
            set_up.eye_m = eye;
            const SeenArtifact artifact = seen_level(set_up, *pack, level);
            picture.include(figures_of(set_up, artifact, plan_of(set_up, artifact)));
        }
    }
    result.rows.push_back({"error figures that are not finite", 0.0, not_finite});
    for (StabilityRow& row : rows_of(picture, "", bound_px, gpu_bound_px, 1.0)) {
        result.rows.push_back(std::move(row));
    }
}

/// Largest distance of the finest level's corners from a box that stands on z = 0, box units.
double off_box(const pack::Pack& pack, const glm::dvec3& size) {
    double off = 0.0;
    for (const glm::vec3& p : bake::surface_of(pack.levels.back(), pack.box_size).positions) {
        const glm::dvec3 q = glm::abs(glm::dvec3(p) - glm::dvec3(0.0, 0.0, 0.5 * size.z)) - 0.5 * size;
        const double outside = glm::length(glm::max(q, glm::dvec3(0.0)));
        const double inside = std::fmin(std::fmax(q.x, std::fmax(q.y, q.z)), 0.0);
        off = std::fmax(off, std::fmax(outside, -inside));
    }
    return off;
}

/// Largest distance of the finest level's corners from the sphere of radius 1/2 in the box.
double off_sphere(const pack::Pack& pack) {
    double off = 0.0;
    for (const glm::vec3& p : bake::surface_of(pack.levels.back(), pack.box_size).positions) {
        off = std::fmax(off, std::abs(glm::distance(glm::dvec3(p), glm::dvec3(0.0, 0.0, 0.5)) - 0.5));
    }
    return off;
}

constexpr double bake_bound = 6e-5 + 1.0 / 65535.0; ///< the finest level's tolerance, and its 16 bits

/// A sphere covered with slivers of 1e-9 of its width.
StabilityResult slivers(const StabilityOptions&) {
    bake::SourceMesh mesh = sphere({0, 0, 0}, 0.5, 12);
    const std::size_t count = mesh.triangles.size();
    for (std::size_t k = 0; k < count; k += 2) {
        const auto [a, b, c] = mesh.triangles[k];
        const glm::dvec3 from = mesh.positions[a];
        const glm::dvec3 to = mesh.positions[b];
        const double to_side = k % 4 == 0 ? 1e-9 : -1e-9;
        add_triangle(mesh, from, to, from + to_side * glm::normalize(mesh.positions[c] - from));
    }
    StabilityResult result;
    const Result<pack::Pack> pack = baked(mesh);
    add_soundness(pack, result);
    if (pack) {
        result.rows.push_back({"finest level off the sphere, box units", bake_bound, off_sphere(*pack)});
    }
    return result;
}

/// Every triangle three times: two copies and one with reversed winding.
StabilityResult duplicates(const StabilityOptions&) {
    bake::SourceMesh mesh = sphere({0, 0, 0}, 0.5, 12);
    const std::size_t count = mesh.triangles.size();
    for (std::size_t k = 0; k < count; ++k) {
        const auto [a, b, c] = mesh.triangles[k];
        add_triangle(mesh, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
        add_triangle(mesh, mesh.positions[a], mesh.positions[c], mesh.positions[b]);
    }
    StabilityResult result;
    const Result<pack::Pack> pack = baked(mesh);
    const Result<pack::Pack> single = baked(sphere({0, 0, 0}, 0.5, 12));
    add_soundness(pack, result);
    if (pack && single) {
        result.rows.push_back({"finest level off the sphere, box units", bake_bound, off_sphere(*pack)});
        const auto triangles = [](const pack::Pack& p) {
            return static_cast<double>(p.levels.back().indices.size());
        };
        result.rows.push_back(
            {"triangles more than without, share", 0.0, triangles(*pack) / triangles(*single) - 1.0});
    }
    return result;
}

StabilityResult long_and_thin(const glm::dvec3& size) {
    StabilityResult result;
    const Result<pack::Pack> pack = baked(box_mesh(size));
    add_soundness(pack, result);
    if (pack) {
        result.rows.push_back({"finest level off the box, box units", bake_bound, off_box(*pack, size)});
    }
    return result;
}

StabilityResult one_triangle(const StabilityOptions&) {
    StabilityResult result;
    bake::SourceMesh mesh;
    mesh.materials.resize(1);
    mesh.default_up = 'z';
    const std::array corners{glm::dvec3(-0.5, 0.1, 0.0), glm::dvec3(0.5, 0.1, 0.0),
                             glm::dvec3(0.0, 0.1, 0.9)};
    add_triangle(mesh, corners[0], corners[1], corners[2]);
    const Result<pack::Pack> pack = baked(mesh);
    add_soundness(pack, result);
    double off = pack ? 0.0 : 1.0;
    for (const glm::dvec3& corner : corners) { // the box is 1 wide, flat, and stands on the lowest corner
        double nearest = 1.0;
        for (std::size_t k = 0; pack && k < pack->levels.back().vertices.size(); ++k) {
            const glm::dvec3 p(bake::surface_of(pack->levels.back(), pack->box_size).positions[k]);
            nearest = std::fmin(nearest, glm::length(glm::dvec2(p.x - corner.x, p.z - corner.z)));
        }
        off = std::fmax(off, nearest);
    }
    result.rows.push_back({"its corners off, box units", 1.0 / 65535.0, off});
    return result;
}

/// A mesh without surface is refused with a sentence; it is neither baked nor a cause of division by zero.
StabilityResult no_surface(const StabilityOptions&) {
    std::vector<bake::SourceMesh> none(5, box_mesh(glm::dvec3(1.0)));
    for (bake::SourceMesh& mesh : none) {
        mesh.positions.clear();
        mesh.triangles.clear();
        mesh.triangle_materials.clear();
    }
    const glm::dvec3 p(1e6, 2.0, -3.0);
    add_triangle(none[1], p, p, p);                       // a point
    add_triangle(none[2], p, p + glm::dvec3(1, 0, 0), p); // a line, there and back
    add_triangle(none[3], glm::dvec3(0.0), glm::dvec3(1e-320),
                 glm::dvec3(0, 1e-320, 0)); // too small to divide by
    add_triangle(none[4], glm::dvec3(-1e300), glm::dvec3(1e300), glm::dvec3(1e300, 0, 0)); // too large
    double taken = 0.0;
    for (const bake::SourceMesh& mesh : none) {
        taken += baked(mesh) ? 1.0 : 0.0;
    }
    return {{{"baked: nothing, a point, a line, 1e-320, 1e300", 0.0, taken}}};
}

} // namespace

std::vector<StabilityCase> shape_cases() {
    const std::string theme = "shape";
    const auto thin = [](const glm::dvec3& size) {
        return [size](const StabilityOptions&) { return long_and_thin(size); };
    };
    return {{theme, "slivers 1e-9 wide", FloatingPoint::Free, slivers},
            {theme, "coplanar duplicates, both ways round", FloatingPoint::Free, duplicates},
            {theme, "a rod, 1e7:1", FloatingPoint::Free, thin({1.0, 1e-7, 1e-7})},
            {theme, "an upright rod, 1e7:1", FloatingPoint::Free, thin({1e-7, 1e-7, 1.0})},
            {theme, "a sheet, 1e7:1", FloatingPoint::Free, thin({1.0, 1e-7, 0.8})},
            {theme, "one triangle", FloatingPoint::Free, one_triangle},
            {theme, "no surface", FloatingPoint::Free, no_surface}};
}

} // namespace frustumscreen::bench
