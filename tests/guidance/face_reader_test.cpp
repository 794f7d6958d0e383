// Faces seen and lit, compared with the definition, corner by corner in table coordinates, and with a ray cast.
#include "guided_props.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace frustumscreen::guidance {
namespace {

constexpr double hair = 1e-9;

/// The least sine of a point's elevation over a face, over all corners; table coordinates.
double min_sine_over(const GuidedState& tracked_state, const geometry::PropFace& face,
                     const glm::dvec3& point) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec3& corner : face.corners) {
        corners.push_back(tracked_state.table_from_prop.point(corner));
    }
    const glm::dvec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners.back() - corners[0]));
    double least = 1.0;
    for (const glm::dvec3& corner : corners) {
        least = std::min(least, glm::dot(normal, glm::normalize(point - corner)));
    }
    return least;
}

bool in_picture(const GuidanceSetup& setup, const GuidedState& tracked_state,
                const geometry::PropFace& face) {
    const geometry::RigidTransform projector_from_table = setup.table_from_projector.inverse();
    return std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& corner) {
        const glm::dvec3 p = projector_from_table.point(tracked_state.table_from_prop.point(corner));
        const double u = setup.projector.fx * p.x / p.z + setup.projector.cx;
        const double v = setup.projector.fy * p.y / p.z + setup.projector.cy;
        return p.z > 0.0 && u >= 0.0 && v >= 0.0 && u <= setup.projector.width && v <= setup.projector.height;
    });
}

class FacesOf : public ::testing::TestWithParam<GuidanceSetup (*)()> {};
INSTANTIATE_TEST_SUITE_P(EveryProp, FacesOf,
                         ::testing::Values(&frustum_setup, &cube_setup, &wedge_setup, &solid_cube_setup,
                                           &hexagon_setup, &tetrahedron_setup, &gem_setup));

TEST_P(FacesOf, MatchTheDefinitionOfSeenAndLit) {
    const FaceReader reader(GetParam()());
    const GuidanceSetup& setup = reader.setup();
    bench::Seeded seeded(3);
    int lit = 0;
    int dark = 0;
    for (int k = 0; k < 5000; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(setup, seeded);
        const FaceSets sets = reader.read(tracked_state);
        bool every_seen_is_lit = true;
        bool close = false;
        for (std::size_t f = 0; f < setup.prop.faces.size(); ++f) {
            const geometry::PropFace& face = setup.prop.faces[f];
            const double eye =
                min_sine_over(tracked_state, face, tracked_state.eye_m) - FaceReader::min_sine_of_sight;
            const double lens = min_sine_over(tracked_state, face, setup.table_from_projector.translation) -
                                setup.min_sine_of_light;
            if (std::abs(eye) < hair || std::abs(lens) < hair) {
                close = true;
                continue;
            }
            EXPECT_EQ((sets.seen >> f & 1U) != 0, eye > 0.0);
            const bool is_lit = lens > 0.0 && in_picture(setup, tracked_state, face);
            EXPECT_EQ((sets.lit >> f & 1U) != 0, is_lit);
            ++(is_lit ? lit : dark);
            every_seen_is_lit = every_seen_is_lit && (is_lit || !(eye > 0.0));
        }
        EXPECT_TRUE(close || sets.valid() == every_seen_is_lit) << k;
        EXPECT_EQ(reader.valid(tracked_state), sets.valid()) << k;
    }
    EXPECT_GT(lit, 1000); // both occur
    EXPECT_GT(dark, 1000);
}

/// Counts the pixels of a pinhole at the eye whose rays enter the prop through one of the faces.
double traced_px(const GuidanceSetup& setup, const GuidedState& tracked_state, std::uint32_t faces) {
    const geometry::RigidTransform prop_from_table = tracked_state.table_from_prop.inverse();
    const glm::dvec3 eye = prop_from_table.point(tracked_state.eye_m);
    const glm::dvec3 forward = glm::normalize(setup.prop.middle - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, prop_from_table.direction({0.0, 0.0, 1.0})));
    const glm::dvec3 down = glm::cross(forward, right);
    constexpr int half = 800;
    constexpr int step = 4;
    int count = 0;
    for (int v = -half; v < half; v += step) {
        for (int u = -half; u < half; u += step) {
            geometry::PropHit hit;
            const glm::dvec3 ray =
                forward + (right * (u + 0.5) + down * (v + 0.5)) / FaceReader::pixels_per_radian;
            if (geometry::intersect(setup.prop, eye, ray, hit) && (faces >> hit.face & 1U) != 0) {
                ++count;
            }
        }
    }
    return static_cast<double>(count) * step * step;
}

TEST_P(FacesOf, AreaMatchesARayCast) {
    GuidanceSetup setup = GetParam()();
    // The ray cast uses the planes; the wedge's planes were not moved with its corners.
    setup.prop.bounds.resize(setup.prop.faces.size());
    for (std::size_t f = 0; f < setup.prop.faces.size(); ++f) {
        setup.prop.bounds[f] = setup.prop.faces[f].plane;
    }
    if (setup.prop.faces.size() == 5) {
        setup.prop.bounds.push_back({glm::dvec3(0.0, 0.0, -1.0), 0.0});
    }
    const FaceReader reader(setup);
    bench::Seeded seeded(5);
    int large = 0;
    for (int k = 0; k < 12; ++k) {
        const GuidedState tracked_state = bench::seeded_situation(setup, seeded);
        const std::uint32_t seen = reader.read(tracked_state).seen;
        const double traced = traced_px(setup, tracked_state, seen);
        const double area = reader.area_px(tracked_state, seen);
        // A raster of every fourth pixel errs by about its step along the outline.
        EXPECT_NEAR(area, traced, 0.03 * area + 200.0);
        large += traced > 2000.0 ? 1 : 0;
        const std::uint32_t largest = reader.largest_of(tracked_state, seen);
        for (std::size_t f = 0; f < setup.prop.faces.size(); ++f) {
            const std::uint32_t face = std::uint32_t{1} << f;
            EXPECT_TRUE((seen & face) == 0 ||
                        reader.area_px(tracked_state, face) <= reader.area_px(tracked_state, largest));
        }
    }
    EXPECT_GT(large, 6) << "the tolerance does not decide";
}

} // namespace
} // namespace frustumscreen::guidance
