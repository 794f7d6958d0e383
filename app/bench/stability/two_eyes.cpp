// A picture for each of two eyes: together and a metre apart, one in a face's plane, one in the prop, and in front of props
// with faces that almost coincide.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/scene/stereo.h"
#include "app/solid/prop_file.h"
#include "app/solid/shape_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace frustumscreen::bench {

namespace {

using Eyes = std::array<glm::dvec3, 2>;

struct EyePlan {
    PictureFigures figures;
    scene::FramePlan plan;

    [[nodiscard]] bool shows(std::size_t face) const {
        return std::any_of(plan.faces.begin(), plan.faces.end(), [face](const scene::FacePlan& planned) {
            return planned.face == static_cast<int>(face);
        });
    }
};

/// Each eye's plan in a layout, held against the exact picture of that eye.
std::array<EyePlan, 2> plans_of(const exact::SetUp& set_up, settings::Stereo stereo, const Eyes& eyes_m) {
    const scene::StereoLayout layout = scene::stereo_layout(set_up.projector, stereo);
    const scene::PlanView view{.projector = set_up.projector,
                               .table_from_projector = set_up.table_from_projector,
                               .table_from_prop = set_up.table_from_prop,
                               .eyes_m = {},
                               .light = scene::LightCompensation{}};
    const std::array<scene::PlanView, 2> views = scene::views_of(layout, view, eyes_m);
    std::array<EyePlan, 2> plans;
    for (std::size_t eye = 0; eye < plans.size(); ++eye) {
        exact::SetUp one = set_up;
        one.projector = layout.pinhole;
        one.eye_m = eyes_m[eye];
        const SeenArtifact artifact = seen_artifact(one);
        plans[eye].plan = scene::make_plan(one.prop, artifact.placed);
        scene::plan_frame(one.prop, artifact.placed, views[eye], plans[eye].plan);
        plans[eye].figures = figures_of(one, artifact, plans[eye].plan);
    }
    return plans;
}

constexpr double min_seen_sine = 0.05; ///< at which a face is seen here

StabilityResult apart(const StabilityOptions&) {
    StabilityResult result;
    for (const double interocular_m : {0.0, 0.063, 1.0}) {
        PictureFigures figures;
        for (const settings::Stereo stereo :
             {settings::Stereo::SideBySide, settings::Stereo::TopBottom, settings::Stereo::FrameSequential,
              settings::Stereo::Anaglyph}) {
            for (const glm::dvec3& across : {glm::dvec3(1, 0, 0), glm::dvec3(0.6, 0.64, 0.48)}) {
                const exact::SetUp set_up = usual_set_up();
                const glm::dvec3 half = 0.5 * interocular_m * across;
                for (const EyePlan& eye :
                     plans_of(set_up, stereo, {set_up.eye_m - half, set_up.eye_m + half})) {
                    figures.include(eye.figures);
                }
            }
        }
        append(result, rows_of(figures, fmt::format("{:g} m apart: ", interocular_m),
                               bound_px / min_seen_sine, gpu_bound_px / min_seen_sine));
    }
    return result;
}

/// The left eye lies in the plane of a face, the right one above it.
StabilityResult one_in_a_plane(const StabilityOptions&) {
    StabilityResult result;
    PictureFigures figures;
    double lit = 0.0;
    double dark = 0.0;
    for (std::size_t face = 0; face < 5; ++face) {
        const exact::SetUp set_up = usual_set_up();
        const geometry::PropFace& f = set_up.prop.faces[face];
        const glm::dvec3 left = f.middle() + 0.6 * glm::normalize(f.corners[1] - f.corners[0]);
        const std::array<EyePlan, 2> eyes =
            plans_of(set_up, settings::Stereo::SideBySide, {left, left + 0.063 * f.plane.normal});
        lit += eyes[0].shows(face) ? 1.0 : 0.0;
        dark += eyes[1].shows(face) ? 0.0 : 1.0;
        figures.include(eyes[0].figures);
        figures.include(eyes[1].figures);
    }
    append(result, rows_of(figures, "both: ", bound_px / min_seen_sine, gpu_bound_px / min_seen_sine));
    result.rows.push_back({"times that the face was lit for the eye in its plane", 0.0, lit});
    result.rows.push_back({"times that it was dark for the other", 0.0, dark});
    return result;
}

StabilityResult one_in_the_prop(const StabilityOptions&) {
    StabilityResult result;
    PictureFigures other;
    double lit = 0.0;
    double not_finite = 0.0;
    for (const glm::dvec3& inside : {glm::dvec3(0.0, 0.0, 0.06), glm::dvec3(0.03, -0.02, 0.0),
                                     glm::dvec3(0.0, 0.0, 0.12), glm::dvec3(0.02, 0.01, 1e-9)}) {
        const exact::SetUp set_up = usual_set_up();
        const std::array<EyePlan, 2> eyes =
            plans_of(set_up, settings::Stereo::TopBottom, {inside, set_up.eye_m});
        lit += static_cast<double>(eyes[0].plan.faces.size());
        not_finite += eyes[0].figures.not_finite;
        other.include(eyes[1].figures);
    }
    append(result, rows_of(other, "the other eye: ", bound_px, gpu_bound_px));
    result.rows.push_back({"faces lit for the eye in it", 0.0, lit});
    result.rows.push_back({"numbers in its plan that are not finite", 0.0, not_finite});
    return result;
}

/// A slab whose upper face leans by a degree: it ends in an edge of one degree.
constexpr std::string_view blade = "v -80 -50 0\nv 80 -50 0\nv 80 50 0\nv -80 50 0\nv 80 50 1.74550649\n"
                                   "v -80 50 1.74550649\nf 1 4 3 2\nf 1 2 5 6\nf 4 6 5 3\nf 2 3 5\nf 1 6 4\n";
/// A block whose top is folded by a degree.
constexpr std::string_view roof =
    "v -80 -80 0\nv 80 -80 0\nv 80 80 0\nv -80 80 0\nv -80 -80 100\nv 80 -80 100\nv 80 80 100\nv -80 80 100\n"
    "v -80 0 100.698148\nv 80 0 100.698148\nf 1 4 3 2\nf 1 2 6 5\nf 3 4 8 7\nf 5 6 10 9\nf 9 10 7 8\n"
    "f 2 3 7 10 6\nf 1 5 9 8 4\n";

StabilityResult edges_of_a_degree(const StabilityOptions&) {
    StabilityResult result;
    for (const auto& [name, text] :
         {std::pair("an edge of 1 deg: ", blade), std::pair("faces turned by 1 deg: ", roof)}) {
        const Result<solid::PropFile> file = solid::parse_prop_file(text, solid::LengthUnit::Millimetre);
        if (!file) {
            result.rows.push_back({name + ("refused: " + file.error().message), 0.0, 1.0});
            continue;
        }
        exact::SetUp set_up = usual_set_up();
        set_up.prop = solid::shape_of(file->solid, solid::Underside::Dark);
        PictureFigures figures;
        for (const double interocular_m : {0.0, 0.063}) {
            const glm::dvec3 half(0.5 * interocular_m, 0.0, 0.0);
            for (const EyePlan& eye :
                 plans_of(set_up, settings::Stereo::SideBySide, {set_up.eye_m - half, set_up.eye_m + half})) {
                figures.include(eye.figures);
            }
        }
        append(result, rows_of(figures, name, bound_px / min_seen_sine, gpu_bound_px / min_seen_sine));
    }
    return result;
}

} // namespace

std::vector<StabilityCase> two_eyes_cases() {
    const std::string theme = "two eyes";
    return {{theme, "0 to 1 m apart, in every layout", FloatingPoint::Strict, apart},
            {theme, "one in a face's plane", FloatingPoint::Strict, one_in_a_plane},
            {theme, "one in the prop", FloatingPoint::Strict, one_in_the_prop},
            {theme, "before edges of a degree", FloatingPoint::Strict, edges_of_a_degree}};
}

} // namespace frustumscreen::bench
