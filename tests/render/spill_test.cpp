// A prop in the hand, turned in any way: light falls on its seen and lit faces alone. The outlines are the faces'
// corners, projected one by one; the picture comes from the whole renderer.

#include "app/solid/prop_file.h"
#include "app/solid/shape_of.h"
#include "firmware_host/base/file.h"
#include "tests/folders.h"
#include "tests/render/relief_rig.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {
namespace {

using Outline = std::vector<glm::dvec2>; ///< pixels

geometry::PropShape held_prop(const std::string& name) {
    if (name == "cube") {
        return geometry::make_cube(0.12);
    }
    const auto bytes = read_file(std::filesystem::path(source_dir()) / "config" / (name + ".obj"));
    const auto file = solid::parse_prop_file(as_text(bytes.value()), solid::LengthUnit::Millimetre);
    return solid::shape_of(file.value().solid, solid::Underside::Lit);
}

bool looks_at(const geometry::PropFace& face, const glm::dvec3& point_in_prop) {
    return glm::dot(face.plane.normal, point_in_prop - face.corners[0]) > 0.0;
}

/// The outlines of the faces that lens and eye both see.
std::vector<Outline> lit_outlines(const TestTable& table) {
    const geometry::RigidTransform prop_from_table = table.table_from_prop.inverse();
    const geometry::RigidTransform projector_from_table = table.table_from_projector.inverse();
    const glm::dvec3 lens = prop_from_table.point(table.table_from_projector.translation);
    const glm::dvec3 eye = prop_from_table.point(table.eye_m);
    std::vector<Outline> outlines;
    for (const geometry::PropFace& face : table.prop.faces) {
        if (!looks_at(face, lens) || !looks_at(face, eye)) {
            continue;
        }
        outlines.emplace_back();
        for (const glm::dvec3& corner : face.corners) {
            const glm::dvec3 p = projector_from_table.point(table.table_from_prop.point(corner));
            outlines.back().emplace_back(table.projector.fx * p.x / p.z + table.projector.cx,
                                         table.projector.fy * p.y / p.z + table.projector.cy);
        }
    }
    return outlines;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// How far a point lies outside a convex outline, in pixels; 0 inside.
double outside_px(const Outline& outline, const glm::dvec2& point) {
    double area = 0.0;
    double nearest = 1e9;
    bool inside = true;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        area += cross(outline[k], outline[(k + 1) % outline.size()]);
    }
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec2 from = outline[k];
        const glm::dvec2 along = outline[(k + 1) % outline.size()] - from;
        inside = inside && cross(along, point - from) * area >= 0.0;
        const double share = std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
        nearest = std::fmin(nearest, glm::distance(point, from + share * along));
    }
    return inside ? 0.0 : nearest;
}

struct Spill {
    std::size_t lit = 0;
    std::size_t outside = 0;  ///< lit pixels none of which belongs to a lit face
    double farthest_px = 0.0; ///< of them
};

/// `allowed_px`: how far from the face a pixel's centre may lie whose samples still meet it.
void add_spill(const image::Image8& picture, const std::vector<Outline>& outlines, double allowed_px,
               Spill& spill) {
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::u8vec4& code = picture.at(x, y);
            if (code.r + code.g + code.b == 0) {
                continue;
            }
            double off_px = 1e9;
            for (const Outline& outline : outlines) {
                off_px = std::fmin(off_px, outside_px(outline, {x + 0.5, y + 0.5}));
            }
            ++spill.lit;
            spill.outside += off_px > allowed_px ? 1U : 0U;
            spill.farthest_px = std::fmax(spill.farthest_px, off_px);
        }
    }
}

TEST(Spill, NoPixelOutsideTheLitFacesOfAPropInTheHandIsLit) {
    constexpr double grid_px = 1.0 / 16.0; // vertices snap to it
    constexpr int poses = 16;
    for (const char* const name : {"cube", "prop_hexagon", "prop_tetrahedron", "prop_gem"}) {
        const geometry::PropShape prop = held_prop(name);
        for (const int samples : {1, 4}) {
            ReliefRig rig(samples, 256, white(rings()));
            rig.prop = prop;
            rig.relief = relief_of(rig.pack, 256, true);
            rig.raster = scene::placed(rig.pack, rig.relief, 0.0, rig.renderer->store().keep(rig.relief));
            for (scene::PlacedLevel* const each : {&rig.level, &rig.raster}) {
                each->metres_per_box = metres_per_box(rig.pack, prop);
                each->samples = samples;
            }
            rig.plan = scene::make_plan(prop, rig.level.triangles->indices.size(), 1);
            TestTable table = table_of({});
            table.prop = prop;
            std::mt19937 random(57);
            Spill spill;
            std::size_t dark = 0; // faces that the eye sees and the light does not reach
            for (int pose = 0; pose < poses; ++pose) {
                table.hold(random);
                const std::vector<Outline> outlines = lit_outlines(table);
                const glm::dvec3 eye = table.table_from_prop.inverse().point(table.eye_m);
                for (const geometry::PropFace& face : prop.faces) {
                    dark += looks_at(face, eye) ? 1U : 0U;
                }
                dark -= outlines.size();
                const double allowed_px = samples == 1 ? grid_px : std::sqrt(0.5) + grid_px;
                for (const scene::PlacedLevel* const each : {&rig.level, &rig.raster}) {
                    const image::Image8 picture =
                        rig.one(table, *each,
                                pose % 2 == 0 ? scene::LightCompensation{0.25} : scene::LightCompensation{});
                    add_spill(picture, outlines, allowed_px, spill);
                }
            }
            std::printf("%s, %d samples: %zu lit pixels, %zu outside, at most %.3f px; %zu dark faces\n",
                        name, samples, spill.lit, spill.outside, spill.farthest_px, dark);
            EXPECT_EQ(spill.outside, 0U) << name << ' ' << samples << ": " << spill.farthest_px << " px";
            EXPECT_GT(spill.lit, 1'000U);
            EXPECT_GT(dark, 3U) << "nothing is proved of dark faces";
        }
    }
}

} // namespace
} // namespace frustumscreen::synthetic
