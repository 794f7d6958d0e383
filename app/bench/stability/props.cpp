// Variations of the prop's pose: at the picture's edge, across it, outside, lifted, tilted; and poses that
// are refused: mirrored, sheared, not finite.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/settings/settings.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::bench {

namespace {

/// Smallest sine at which faces of a standing and of a tilted prop are seen.
constexpr double min_sine_upright = 0.1;
constexpr double min_sine_tilted = 0.05;

std::vector<StabilityRow> rows_at(double sine, const PictureFigures& figures, const std::string& where,
                                  double min_points = 100.0) {
    return rows_of(figures, where, bound_px / sine, gpu_bound_px / sine, min_points);
}

/// The usual picture covers 0.8 x 0.5 m of the table; the prop is 0.16 m wide.
StabilityResult edges(const StabilityOptions&) {
    StabilityResult result;
    const auto add = [&result](const std::string& where, const std::vector<glm::dvec2>& places) {
        PictureFigures figures;
        for (const glm::dvec2& place : places) {
            for (const double turn : {0.0, 0.6}) {
                exact::SetUp set_up = usual_set_up();
                set_up.table_from_prop = {glm::angleAxis(turn, glm::dvec3(0, 0, 1)), glm::dvec3(place, 0.0)};
                figures.include(figures_of(set_up));
            }
        }
        append(result, rows_at(min_sine_upright, figures, where));
    };
    add("at the edge: ", {{0.32, 0.0}, {-0.32, 0.0}, {0.0, 0.17}, {0.0, -0.17}, {0.31, 0.16}});
    add("straddling it: ", {{0.40, 0.0}, {-0.39, 0.02}, {0.02, 0.25}, {-0.05, -0.26}, {0.40, 0.25}});
    return result;
}

StabilityResult outside(const StabilityOptions&) {
    double pixels = 0.0;
    double not_finite = 0.0;
    for (const glm::dvec3& place :
         {glm::dvec3(0.7, 0, 0), glm::dvec3(-3, 2, 0), glm::dvec3(0, 1e3, 0), glm::dvec3(0, 0, 5.0),
          glm::dvec3(1e6, -1e6, 0), glm::dvec3(1e15, 0, 0)}) {
        exact::SetUp set_up = usual_set_up();
        set_up.table_from_prop.translation = place;
        const SeenArtifact artifact = seen_artifact(set_up);
        const scene::FramePlan plan = plan_of(set_up, artifact);
        pixels += static_cast<double>(plan.lit.pixels());
        not_finite += figures_of(set_up, artifact, plan).not_finite;
    }
    return {{{"pixels lit", 0.0, pixels}, {"numbers in the plan that are not finite", 0.0, not_finite}}};
}

/// Up to just below the lens, and around it.
StabilityResult lifted(const StabilityOptions&) {
    StabilityResult result;
    for (const double height_m : {0.1, 0.5, 1.0, 1.05}) {
        exact::SetUp set_up = usual_set_up();
        set_up.eye_m = {0.0, -0.55, height_m + 0.5};
        set_up.table_from_prop.translation = {0.0, 0.0, height_m};
        const SeenArtifact artifact = seen_artifact(set_up, 40000);
        append(result, rows_at(min_sine_upright, figures_of(set_up, artifact, plan_of(set_up, artifact)),
                               fmt::format("{:g} m: ", height_m)));
    }
    PictureFigures figures;
    for (const double height_m : {1.08, 1.1, 1.19, 1.2, 1.3, 10.0}) { // the lens is inside the prop, or below
                                                                      // it
        exact::SetUp set_up = usual_set_up();
        set_up.eye_m = {0.0, -0.55, height_m + 0.5};
        set_up.table_from_prop.translation = {0.0, 0.0, height_m};
        const SeenArtifact artifact = seen_artifact(set_up);
        figures.include(figures_of(set_up, artifact, plan_of(set_up, artifact)));
    }
    append(result, rows_at(min_sine_upright, figures, "about the lens: ", 0.0));
    return result;
}

StabilityResult tilted(const StabilityOptions&) {
    PictureFigures figures;
    for (int degrees = 0; degrees <= 180; degrees += 5) {
        for (const glm::dvec3& axis :
             {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0.64, 0.48)}) {
            exact::SetUp set_up = usual_set_up();
            set_up.table_from_prop = {glm::angleAxis(degrees * std::numbers::pi / 180.0, axis),
                                      {0.0, 0.0, 0.2}};
            figures.include(figures_of(set_up));
        }
    }
    return {rows_at(min_sine_tilted, figures, "", 10000.0)};
}

/// Only a rigid matrix has a rigid transform.
StabilityResult refused(const StabilityOptions&) {
    const glm::dmat4 good =
        geometry::RigidTransform{glm::angleAxis(1.0, glm::dvec3(0, 0.6, 0.8)), {1, 2, 3}}.matrix();
    std::vector<glm::dmat4> bad(7, good);
    bad[0][0] = -bad[0][0];                                  // mirrored
    bad[1] = glm::dmat4(-glm::dmat3(good));                  // through the origin
    bad[2][1] += 0.01 * good[0];                             // sheared
    bad[3][2] *= 1.001;                                      // stretched
    bad[4][3][3] = 2.0;                                      // projective
    bad[5][3][0] = std::numeric_limits<double>::quiet_NaN(); // not a number
    bad[6][1][2] = std::numeric_limits<double>::infinity();  // infinite
    double taken = 0.0;
    for (const glm::dmat4& matrix : bad) {
        taken += geometry::rigid_from_matrix(matrix) ? 1.0 : 0.0;
    }
    const auto back = geometry::rigid_from_matrix(good);
    double off = back ? 0.0 : 1.0;
    for (int column = 0; back && column < 4; ++column) {
        off = std::fmax(off, glm::length(back->matrix()[column] - good[column]));
    }
    const std::string mirrored = "[projector]\ntable_from_projector = "
                                 "[-1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,1.2,1]\n";
    taken += settings::parse_settings(mirrored, "kiosk.toml") ? 1.0 : 0.0;
    return {{{"taken: mirrored, sheared, stretched, projective, not finite", 0.0, taken},
             {"a rigid one and back, off", 1e-15, off}}};
}

} // namespace

std::vector<StabilityCase> prop_cases() {
    const std::string theme = "prop";
    return {{theme, "at the picture's edge and across it", FloatingPoint::Strict, edges},
            {theme, "outside the picture, up to 1e15 m", FloatingPoint::Strict, outside},
            {theme, "lifted, up to and past the lens", FloatingPoint::Strict, lifted},
            {theme, "tilted 0 to 180 degrees about three axes", FloatingPoint::Strict, tilted},
            {theme, "mirrored and other matrices that are no pose", FloatingPoint::Free, refused}};
}

} // namespace frustumscreen::bench
