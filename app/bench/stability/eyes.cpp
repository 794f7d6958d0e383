// Variations of the eye: at a grazing angle to a face, on its plane, behind it, in the prop, in the artifact,
// at the projector, far away.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/geometry/collineation.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// `degrees` above the plane of a face, at a distance from its middle, along the face's lower edge.
glm::dvec3 eye_above(const exact::SetUp& set_up, std::size_t face, double degrees, double distance_m) {
    const geometry::PropFace& f = set_up.prop.faces[face];
    const glm::dvec3 middle = f.middle();
    const glm::dvec3 along = glm::normalize(f.corners[1] - f.corners[0]);
    return set_up.table_from_prop.point(middle + distance_m * (std::cos(radians(degrees)) * along +
                                                               std::sin(radians(degrees)) * f.plane.normal));
}

StabilityResult slanting(const StabilityOptions&) {
    StabilityResult result;
    for (const double degrees : {90.0, 45.0, 10.0, 3.0, 1.0, 0.5, 0.2, 0.1}) {
        PictureFigures figures;
        for (std::size_t face = 0; face < 5; ++face) {
            for (const double distance_m : {0.35, 0.6, 2.0}) {
                exact::SetUp set_up = usual_set_up();
                set_up.eye_m = eye_above(set_up, face, degrees, distance_m);
                figures.include(figures_of(set_up, face));
            }
        }
        const double per_sine = 1.0 / std::sin(radians(degrees));
        for (StabilityRow& row : rows_of(figures, fmt::format("{:g} deg: ", degrees), bound_px * per_sine,
                                         gpu_bound_px * per_sine)) {
            result.rows.push_back(std::move(row));
        }
    }
    return result;
}

/// The sine of the lowest elevation at which a face is lit, found by bisection.
double darkest_sine(std::size_t face) {
    exact::SetUp set_up = usual_set_up();
    const SeenArtifact artifact = seen_artifact(set_up);
    const geometry::PropFace& f = set_up.prop.faces[face];
    const glm::dvec3 centre(0.0, 0.0, 0.5 * seen_box_size.z * artifact.placed.metres_per_box);
    const glm::dvec3 foot = centre - f.plane.distance(centre) * f.plane.normal;
    const glm::dvec3 along = glm::normalize(f.corners[1] - f.corners[0]);
    const geometry::Box box{{-0.08, -0.08, 0.0}, {0.08, 0.08, 0.12}};
    const glm::dmat4 clip =
        set_up.projector.clip_from_point() * set_up.table_from_projector.inverse().matrix();
    double low = 0.0;
    double high = 0.01;
    for (int k = 0; k < 40; ++k) {
        const double height = 0.5 * (low + high);
        const bool lit =
            geometry::collineation(f.plane, foot + along + height * f.plane.normal, clip, box).has_value();
        (lit ? high : low) = height;
    }
    return high / glm::distance(foot + along + high * f.plane.normal, centre);
}

StabilityResult dark_limit(const StabilityOptions&) {
    double off = 0.0;
    for (std::size_t face = 0; face < 5; ++face) {
        off = std::fmax(off, std::abs(darkest_sine(face) / 1e-3 - 1.0));
    }
    return {{{"sine at which a face goes dark, off 0.001 (0.057 deg), relative", 1e-10, off}}};
}

/// With the eye on or behind a face's plane, that face is dark and the others are correct.
StabilityResult on_and_behind(const StabilityOptions&) {
    PictureFigures figures;
    double lit = 0.0;
    for (std::size_t face = 0; face < 5; ++face) {
        for (const double degrees : {0.05, 1e-3, 1e-9, 0.0, -1e-9, -0.1, -10.0, -60.0}) {
            exact::SetUp set_up = usual_set_up();
            set_up.eye_m = eye_above(set_up, face, degrees, 0.6);
            const SeenArtifact artifact = seen_artifact(set_up);
            const scene::FramePlan plan = plan_of(set_up, artifact);
            figures.include(figures_of(set_up, artifact, plan));
            for (const scene::FacePlan& planned : plan.faces) {
                lit += planned.face == static_cast<int>(face) ? 1.0 : 0.0;
            }
        }
    }
    StabilityResult result{
        rows_of(figures, "the other faces: ", bound_px, gpu_bound_px)}; // the eye sees these at a steep angle
    result.rows.push_back({"times that the face itself was lit", 0.0, lit});
    return result;
}

/// An eye inside the prop sees no face from outside.
StabilityResult inside_the_prop(const StabilityOptions&) {
    double faces = 0.0;
    for (const double height : {0.0, 1e-9, 0.03, 0.06, 0.119999999, 0.12}) {
        for (const double across : {0.0, 1e-3, 0.04}) {
            exact::SetUp set_up = usual_set_up();
            set_up.eye_m = {across, -across / 2.0, height};
            faces += static_cast<double>(plan_of(set_up, seen_artifact(set_up)).faces.size());
        }
    }
    return {{{"faces lit", 0.0, faces}}};
}

/// The artifact is larger than the prop, and the eye is among its triangles.
StabilityResult inside_the_artifact(const StabilityOptions&) {
    PictureFigures figures;
    for (const glm::dvec3& eye : {glm::dvec3(0.15, 0.1, 0.2), glm::dvec3(0.0, 0.0, 0.3),
                                  glm::dvec3(-0.2, -0.25, 0.01), glm::dvec3(0.0, -0.12, 0.06)}) {
        exact::SetUp set_up = usual_set_up();
        set_up.eye_m = eye;
        const SeenArtifact artifact = seen_artifact(set_up, 4000, 0.8);
        figures.include(figures_of(set_up, artifact, plan_of(set_up, artifact)));
    }
    constexpr double min_seen_sine = 0.125; // of triangles next to the eye
    return {rows_of(figures, "", bound_px / min_seen_sine, gpu_bound_px / min_seen_sine)};
}

/// With the eye at the projector, every point is drawn where the projector sees it, on any face.
StabilityResult at_the_projector(const StabilityOptions&) {
    exact::SetUp set_up = usual_set_up();
    set_up.table_from_prop = {glm::angleAxis(0.3, glm::dvec3(0, 0, 1)), {0.1, -0.05, 0.0}};
    set_up.eye_m = set_up.table_from_projector.translation;
    const SeenArtifact artifact = seen_artifact(set_up);
    double off_px = 0.0;
    const exact::Rigid table_from_prop(set_up.table_from_prop);
    for (const geometry::PropFace& face : set_up.prop.faces) {
        for (std::uint32_t k = 0; k < artifact.level.vertices.size(); ++k) {
            const auto seen = set_up.see(face, artifact.corner(k));
            const exact::Vector x = table_from_prop.point(artifact.corner(k));
            const exact::Real depth = 1.2L - x.z;
            off_px = std::fmax(off_px,
                               static_cast<double>(std::hypot(seen->u - (640.0L + 1920.0L * x.x / depth),
                                                              seen->v - (400.0L - 1920.0L * x.y / depth))));
        }
    }
    StabilityResult result{
        rows_of(figures_of(set_up, artifact, plan_of(set_up, artifact)), "", bound_px, gpu_bound_px)};
    result.rows.push_back({"the exact picture, off the projector's own view, px", 1e-13, off_px});
    return result;
}

StabilityResult far_away(const StabilityOptions&) {
    StabilityResult result;
    for (const double distance_m : {10.0, 1e3, 1e6}) {
        PictureFigures figures;
        for (const double elevation : {0.1, 0.5, 1.2}) {
            exact::SetUp set_up = usual_set_up();
            set_up.eye_m = distance_m * glm::dvec3(0.3 * std::cos(elevation), -0.95 * std::cos(elevation),
                                                   std::sin(elevation));
            figures.include(figures_of(set_up));
        }
        // At a thousand metres, in units of the prop's height, the 64-bit eye loses two more roundings.
        for (StabilityRow& row : rows_of(figures, fmt::format("{:g} m: ", distance_m),
                                         bound_px * (2.0 + distance_m / 1e3), 2.0 * gpu_bound_px)) {
            result.rows.push_back(std::move(row));
        }
    }
    return result;
}

} // namespace

std::vector<StabilityCase> eye_cases() {
    const std::string theme = "eye";
    return {{theme, "90 down to 0.1 degrees above a face's plane", FloatingPoint::Strict, slanting},
            {theme, "the slant at which a face goes dark", FloatingPoint::Strict, dark_limit},
            {theme, "on a face's plane and behind it", FloatingPoint::Strict, on_and_behind},
            {theme, "inside the prop", FloatingPoint::Strict, inside_the_prop},
            {theme, "inside the artifact", FloatingPoint::Strict, inside_the_artifact},
            {theme, "at the projector", FloatingPoint::Strict, at_the_projector},
            {theme, "10 m, 1 km, 1000 km away", FloatingPoint::Strict, far_away}};
}

} // namespace frustumscreen::bench
