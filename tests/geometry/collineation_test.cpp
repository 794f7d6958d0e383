#include "app/geometry/collineation.h"
#include "app/geometry/pinhole.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace frustumscreen::geometry {
namespace {

using Real = long double;
struct Real3 {
    Real x, y, z;
};
Real3 real(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
Real dot(const Real3& a, const Real3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Real3 along(const Real3& from, const Real3& to, Real t) {
    return {from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t, from.z + (to.z - from.z) * t};
}

/// A projector's pose as matrix rows: projector = rotation * prop + translation, in long double.
struct PlainProjector {
    Pinhole pinhole;
    std::array<Real3, 3> rows{};
    Real3 translation{};

    PlainProjector(const Pinhole& p, const RigidTransform& projector_from_prop) : pinhole(p) {
        const glm::dquat& q = projector_from_prop.rotation;
        const Real w = q.w, x = q.x, y = q.y, z = q.z;
        rows = {Real3{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                Real3{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                Real3{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
        translation = real(projector_from_prop.translation);
    }
    [[nodiscard]] Real3 see(const Real3& p) const {
        return {dot(rows[0], p) + translation.x, dot(rows[1], p) + translation.y,
                dot(rows[2], p) + translation.z};
    }
};

/// The ordinary way: eye ray onto the plane, then the pinhole. Gives the pixel, and whether the point is
/// visible.
struct Truth {
    bool seen = false;
    Real u = 0, v = 0;
};
Truth by_rays(const Plane& plane, const glm::dvec3& eye, const glm::dvec3& x,
              const PlainProjector& projector) {
    const Real eye_height = dot(real(plane.normal), real(eye)) - plane.offset;
    const Real x_height = dot(real(plane.normal), real(x)) - plane.offset;
    if (!(eye_height - x_height > 0)) {
        return {}; // the ray from the eye through x does not reach the plane from above
    }
    const Real3 s = along(real(eye), real(x), eye_height / (eye_height - x_height));
    const Real3 lens = projector.see(s);
    const Pinhole& p = projector.pinhole;
    return {lens.z > 0, p.fx * lens.x / lens.z + p.cx, p.fy * lens.y / lens.z + p.cy};
}

struct Case {
    PropShape prop;
    glm::dvec3 eye{0.0};
    PlainProjector projector;
    glm::dmat4 clip_from_prop{1.0};
    Box box;
    double scale = 1.0;
};

glm::dmat4 clip_of(const Pinhole& pinhole, const RigidTransform& projector_from_prop) {
    return pinhole.clip_from_point() * projector_from_prop.matrix();
}

/// A projector at a random place above, slightly tilted, its picture shifted off the axis.
RigidTransform random_projector(Random& random, double scale) {
    const RigidTransform look_down{glm::dquat(0, 1, 0, 0), {0, 0, 0}};
    const glm::dquat tilt = glm::normalize(
        glm::dquat(1, random.between(-0.15, 0.15), random.between(-0.15, 0.15), random.between(-1, 1)));
    const glm::dvec3 lens(random.between(-0.4, 0.4), random.between(-0.4, 0.4), random.between(0.8, 2.0));
    const RigidTransform prop_from_projector = RigidTransform{tilt, lens * scale} * look_down;
    return prop_from_projector.inverse();
}

Case random_case(Random& random, double eye_distance, double scale) {
    FrustumSize size = random.prop();
    size.base_m *= scale;
    size.top_m *= scale;
    size.height_m *= scale;
    const Pinhole pinhole{1280,
                          800,
                          random.between(1000, 3000),
                          random.between(1000, 3000),
                          random.between(-200, 1500),
                          random.between(-200, 1000)};
    const RigidTransform projector_from_prop = random_projector(random, scale);
    glm::dvec3 direction = random.direction();
    direction.z = std::abs(direction.z);
    const glm::dvec3 eye = direction * eye_distance * scale + glm::dvec3(0, 0, size.height_m / 2);
    const double reach = size.base_m * random.between(0.1, 0.5);
    return {
        make_frustum(size),
        eye,
        PlainProjector(pinhole, projector_from_prop),
        clip_of(pinhole, projector_from_prop),
        {glm::dvec3(-reach, -reach, 0.0), glm::dvec3(reach, reach, size.height_m * random.between(0.2, 1.0))},
        scale};
}

glm::dvec3 point_in(Random& random, const Box& box) {
    return {random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y),
            random.between(box.low.z, box.high.z)};
}

/// Compares one point; returns whether it is visible.
bool expect_same_pixel(const Case& c, const Plane& plane, const glm::dmat4& clip_from_prop,
                       const glm::dvec3& x, double tolerance_px) {
    const Truth truth = by_rays(plane, c.eye, x, c.projector);
    const glm::dvec4 clip = clip_from_prop * glm::dvec4(x, 1.0);
    if (!truth.seen) {
        return false;
    }
    EXPECT_GT(clip.w, 0.0);
    const Pinhole& p = c.projector.pinhole;
    const double u = (clip.x / clip.w + 1.0) / 2.0 * p.width;
    const double v = (clip.y / clip.w + 1.0) / 2.0 * p.height;
    // Far outside the picture only the relative position matters.
    const double far = 1.0 + static_cast<double>(std::max(std::abs(truth.u), std::abs(truth.v))) / 2000.0;
    EXPECT_NEAR(u, static_cast<double>(truth.u), tolerance_px * far);
    EXPECT_NEAR(v, static_cast<double>(truth.v), tolerance_px * far);
    return true;
}

/// Compares `points` points on every face; returns the number of visible points.
int expect_same_picture(Random& random, const Case& c, int points, double tolerance_px) {
    int seen = 0;
    for (const PropFace& face : c.prop.faces) {
        const auto clip = collineation(face.plane, c.eye, c.clip_from_prop, c.box);
        const double height = face.plane.distance(c.eye);
        if (height <= 1e-3 * glm::distance(c.eye, (c.box.low + c.box.high) * 0.5)) {
            EXPECT_FALSE(clip);
            continue;
        }
        for (int k = 0; k < points; ++k) {
            const glm::dvec3 x = point_in(random, c.box);
            if (clip) {
                seen += expect_same_pixel(c, face.plane, *clip, x, tolerance_px) ? 1 : 0;
            } else { // no part of the box appears in front of the projector
                EXPECT_FALSE(by_rays(face.plane, c.eye, x, c.projector).seen);
            }
        }
    }
    return seen;
}

TEST(Collineation, LandsWhereTheEyesRayMeetsTheFace) {
    Random random(31);
    int seen = 0;
    for (int k = 0; k < 2000; ++k) {
        seen += expect_same_picture(random, random_case(random, random.between(0.8, 3.0), 1.0), 10, 1e-6);
    }
    EXPECT_GT(seen, 40000);
}

TEST(Collineation, HoldsFromAMillimetreToAKilometre) {
    Random random(32);
    int seen = 0;
    for (int k = 0; k < 2000; ++k) {
        seen += expect_same_picture(
            random, random_case(random, random.between(0.8, 3.0), random.scale(1e-3, 1e3)), 5, 1e-6);
    }
    EXPECT_GT(seen, 20000);
}

TEST(Collineation, HoldsForAnEyeVeryFarAway) {
    Random random(33);
    int seen = 0;
    for (int k = 0; k < 1000; ++k) {
        seen += expect_same_picture(random, random_case(random, random.scale(10.0, 1000.0), 1.0), 5, 1e-6);
    }
    EXPECT_GT(seen, 5000);
}

TEST(Collineation, HoldsForAnEyeHalfADegreeAboveAFace) {
    Random random(34);
    int seen = 0;
    for (int k = 0; k < 1000; ++k) {
        Case c = random_case(random, 1.0, 1.0);
        const PropFace& face = c.prop.faces[static_cast<std::size_t>(k % 5)];
        const glm::dvec3 middle = (face.corners[0] + face.corners[2]) * 0.5;
        const double turn = random.between(0.0, 6.28);
        const glm::dvec3 u = glm::normalize(face.corners[1] - face.corners[0]);
        const glm::dvec3 in_plane = u * std::cos(turn) + glm::cross(face.plane.normal, u) * std::sin(turn);
        const double distance = random.between(0.5, 3.0);
        c.eye = middle + distance * (in_plane * std::cos(glm::radians(0.5)) +
                                     face.plane.normal * std::sin(glm::radians(0.5)));
        const auto clip = collineation(face.plane, c.eye, c.clip_from_prop, c.box);
        for (int p = 0; p < 10; ++p) {
            const glm::dvec3 x = point_in(random, c.box);
            if (clip) {
                seen += expect_same_pixel(c, face.plane, *clip, x, 1e-6) ? 1 : 0;
            } else { // an eye above the projector: no part of the box appears in front of it
                EXPECT_FALSE(by_rays(face.plane, c.eye, x, c.projector).seen);
            }
        }
    }
    EXPECT_GT(seen, 5000);
}

TEST(Collineation, GivesNothingForAnEyeBehindOrOnTheFacesPlane) {
    Random random(35);
    for (int k = 0; k < 1000; ++k) {
        const Case c = random_case(random, 1.0, random.scale(1e-3, 1e3));
        for (const PropFace& face : c.prop.faces) {
            const glm::dvec3 middle = (face.corners[0] + face.corners[2]) * 0.5;
            const glm::dvec3 beside = glm::normalize(face.corners[1] - face.corners[0]) * c.scale;
            for (const double height : {-10.0, -0.1, -1e-6, 0.0, 1e-4}) {
                const glm::dvec3 eye = middle + beside + face.plane.normal * (height * c.scale);
                EXPECT_FALSE(collineation(face.plane, eye, c.clip_from_prop, c.box));
            }
        }
    }
}

TEST(Collineation, GivesNothingForAnEyeThatIsNotANumber) {
    Random random(36);
    const Case c = random_case(random, 1.0, 1.0);
    EXPECT_FALSE(
        collineation(c.prop.faces[4].plane, glm::dvec3(0, 0, std::nan("")), c.clip_from_prop, c.box));
    EXPECT_FALSE(collineation(c.prop.faces[4].plane, glm::dvec3(0, 0, INFINITY), c.clip_from_prop, c.box));
}

double depth_of(const glm::dmat4& clip_from_prop, const glm::dvec3& x) {
    const glm::dvec4 clip = clip_from_prop * glm::dvec4(x, 1.0);
    return clip.z / clip.w;
}

TEST(Collineation, DepthFillsTheRangeOverTheBoxInFrontOfTheEye) {
    Random random(37);
    int faces = 0;
    for (int k = 0; k < 2000; ++k) {
        const Case c = random_case(random, random.between(1.2, 5.0), random.scale(1e-3, 1e3));
        for (const PropFace& face : c.prop.faces) {
            const auto clip = collineation(face.plane, c.eye, c.clip_from_prop, c.box);
            if (!clip) {
                continue;
            }
            double nearest = 1.0;
            double farthest = -1.0;
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 x((corner & 1) != 0 ? c.box.high.x : c.box.low.x,
                                   (corner & 2) != 0 ? c.box.high.y : c.box.low.y,
                                   (corner & 4) != 0 ? c.box.high.z : c.box.low.z);
                const double w = ((*clip) * glm::dvec4(x, 1.0)).w;
                if (w < 2e-3) { // above the eye's own plane, or almost in it
                    continue;
                }
                const double depth = depth_of(*clip, x);
                EXPECT_GE(depth, -1.0);
                EXPECT_LE(depth, 1.0);
                nearest = std::min(nearest, depth);
                farthest = std::max(farthest, depth);
            }
            EXPECT_GT(farthest, 0.8);
            EXPECT_LT(nearest, farthest);
            ++faces;
        }
    }
    EXPECT_GT(faces, 2000);
}

TEST(Collineation, DepthOrdersPointsOfAnEyeRayByTheirDistance) {
    Random random(38);
    int ordered = 0;
    for (int k = 0; k < 3000; ++k) {
        const Case c = random_case(random, random.between(0.8, 3.0), random.scale(1e-3, 1e3));
        for (const PropFace& face : c.prop.faces) {
            const auto clip = collineation(face.plane, c.eye, c.clip_from_prop, c.box);
            if (!clip) {
                continue;
            }
            // Two points on one ray, the nearer first; they are as little as a millionth of the distance
            // apart.
            const glm::dvec3 x = point_in(random, c.box);
            const glm::dvec3 farther = c.eye + (x - c.eye) * (1.0 + random.scale(1e-6, 1e-1));
            if (!by_rays(face.plane, c.eye, x, c.projector).seen) {
                continue;
            }
            EXPECT_LT(depth_of(*clip, x), depth_of(*clip, farther));
            ++ordered;
        }
    }
    EXPECT_GT(ordered, 1000);
}

TEST(Collineation, APointOfTheFaceItselfIsDrawnWhereTheProjectorSeesIt) {
    Random random(39);
    int drawn = 0;
    for (int k = 0; k < 500; ++k) {
        const Case c = random_case(random, random.between(0.8, 3.0), 1.0);
        for (const PropFace& face : c.prop.faces) {
            const auto clip = collineation(face.plane, c.eye, c.clip_from_prop, c.box);
            for (std::size_t corner = 0; clip && corner < 4; ++corner) {
                const Real3 lens = c.projector.see(real(face.corners[corner]));
                const Pinhole& p = c.projector.pinhole;
                const glm::dvec4 at = *clip * glm::dvec4(face.corners[corner], 1.0);
                EXPECT_NEAR((at.x / at.w + 1) / 2 * p.width,
                            static_cast<double>(p.fx * lens.x / lens.z + p.cx), 1e-6);
                EXPECT_NEAR((at.y / at.w + 1) / 2 * p.height,
                            static_cast<double>(p.fy * lens.y / lens.z + p.cy), 1e-6);
                ++drawn;
            }
        }
    }
    EXPECT_GT(drawn, 2000);
}

/// A point before the face is nearer than the nearest depth, a point behind it is within the depths, and farther along an eye ray is
/// farther in depth; each point is on the pixel that `collineation` has for it.
TEST(CollineationBehind, CutsAtTheFaceAndReachesToInfinity) {
    Random random(36);
    int before = 0;
    int behind = 0;
    for (int k = 0; k < 500; ++k) {
        const Case c = random_case(random, random.between(0.8, 3.0), 1.0);
        for (const PropFace& face : c.prop.faces) {
            const auto clip = collineation_behind(face.plane, c.eye, c.clip_from_prop,
                                                  {face.corners.data(), face.corners.size()});
            const glm::dvec3 on_face =
                glm::mix(glm::mix(face.corners[0], face.corners[1], random.between(0.0, 1.0)),
                         face.corners[2], random.between(0.0, 1.0));
            if (!clip || !by_rays(face.plane, c.eye, on_face, c.projector).seen) {
                continue;
            }
            double nearer = -2.0;
            for (const double share : {0.5, 0.9, 0.999, 1.001, 1.1, 2.0, 10.0, 1e3, 1e6, 1e9}) {
                const glm::dvec3 x = c.eye + share * (on_face - c.eye);
                expect_same_pixel(c, face.plane, *clip, x, share < 1e4 ? 1e-5 : 1e-2);
                const glm::dvec4 at = *clip * glm::dvec4(x, 1.0);
                const double depth = at.z / at.w;
                EXPECT_EQ(share > 1.0, depth > -1.0) << share;
                EXPECT_LT(depth, 1.0) << share;
                EXPECT_TRUE(share < 1.0 || depth > nearer) << share;
                nearer = depth;
                (share > 1.0 ? behind : before) += 1;
            }
        }
    }
    EXPECT_GT(before, 1000);
    EXPECT_GT(behind, 2000);
}

TEST(CollineationBehind, GivesNothingForAnEyeNotInFrontOfTheFace) {
    Random random(37);
    for (int k = 0; k < 100; ++k) {
        Case c = random_case(random, 1.0, 1.0);
        const PropFace& face = c.prop.faces[static_cast<std::size_t>(k % 5)];
        const glm::dvec3 middle = 0.5 * (face.corners[0] + face.corners[2]);
        for (const double above : {0.0, -0.3}) {
            c.eye = middle + above * face.plane.normal + 0.5 * (face.corners[1] - face.corners[0]);
            EXPECT_FALSE(collineation_behind(face.plane, c.eye, c.clip_from_prop,
                                             {face.corners.data(), face.corners.size()}));
        }
    }
}

} // namespace
} // namespace frustumscreen::geometry
