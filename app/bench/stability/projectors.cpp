// Variations of the projector: grazing a face, near-singular intrinsics.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/themes.h"
#include "app/geometry/collineation.h"
#include "app/scene/light.h"
#include "app/settings/lit_zone.h"
#include "app/settings/settings.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// A projector `degrees` above the plane of a face, along its lower edge, looking at its middle; the eye
/// looks straight at the face.
exact::SetUp grazing_set_up(std::size_t face, double degrees) {
    exact::SetUp set_up = usual_set_up();
    const geometry::PropFace& f = set_up.prop.faces[face];
    const glm::dvec3 middle = f.middle();
    const glm::dvec3 along = glm::normalize(f.corners[1] - f.corners[0]);
    const glm::dvec3 n = f.plane.normal;
    const glm::dvec3 back = std::cos(radians(degrees)) * along + std::sin(radians(degrees)) * n;
    const glm::dvec3 down = std::sin(radians(degrees)) * along - std::cos(radians(degrees)) * n;
    const glm::dmat3 axes(glm::cross(down, -back), down, -back);
    set_up.table_from_projector = {glm::normalize(glm::quat_cast(axes)), middle + 1.2 * back};
    set_up.eye_m = middle + 0.6 * n;
    return set_up;
}

StabilityResult grazing(const StabilityOptions&) {
    StabilityResult result;
    for (const double degrees : {90.0, 45.0, 10.0, 1.0, 0.1, 0.06}) {
        PictureFigures figures;
        for (std::size_t face = 0; face < 5; ++face) {
            figures.include(figures_of(grazing_set_up(face, degrees), face));
        }
        for (StabilityRow& row :
             rows_of(figures, fmt::format("{:g} deg: ", degrees), 4.0 * bound_px, 0.5 * gpu_bound_px)) {
            result.rows.push_back(std::move(row));
        }
    }
    return result;
}

/// Below the limit the face is dark.
StabilityResult below_the_limit(const StabilityOptions&) {
    double lit = 0.0;
    for (std::size_t face = 0; face < 5; ++face) {
        for (const double degrees : {0.05, 1e-3, 1e-9, 0.0, -1e-9, -1.0, -45.0}) {
            const exact::SetUp set_up = grazing_set_up(face, degrees);
            for (const scene::FacePlan& planned : plan_of(set_up, seen_artifact(set_up)).faces) {
                lit += planned.face == static_cast<int>(face) ? 1.0 : 0.0;
            }
        }
    }
    return {{{"faces lit at 0.05 degrees and below", 0.0, lit}}};
}

/// The gain at a point of the face, computed in the ordinary way: faded out where the light grazes the face.
exact::Real exact_gain(const exact::SetUp& set_up, const geometry::PropFace& face, const exact::Vector& point,
                       exact::Real reference) {
    const exact::Vector lens = set_up.lens_in_prop();
    const exact::Real d = exact::length(lens - point);
    const exact::Real height = set_up.height(face, lens);
    const exact::Real sine = height / exact::length(lens - exact::of(face.middle()));
    const exact::Real lit =
        std::clamp((sine - exact::Real(settings::min_sine_of_light)) /
                       (exact::Real(scene::full_sine_of_light) - exact::Real(settings::min_sine_of_light)),
                   exact::Real(0), exact::Real(1));
    return lit * lit * (3 - 2 * lit) * std::min(exact::Real(1), reference * d * d * d / height);
}

/// The compensation's gain at points of a face, in the shader's 32-bit numbers.
StabilityResult light(const StabilityOptions&) {
    StabilityResult result;
    for (const double degrees : {90.0, 10.0, 4.0, 2.2, 1.0, 0.06}) {
        double off = 0.0;
        double largest = 0.0;
        for (std::size_t k = 0; k < 5; ++k) {
            const exact::SetUp set_up = grazing_set_up(k, degrees);
            const geometry::PropFace& face = set_up.prop.faces[k];
            const geometry::RigidTransform projector_from_prop =
                set_up.table_from_projector.inverse() * set_up.table_from_prop;
            const glm::dvec3 lens = projector_from_prop.inverse().translation;
            const std::array seen{scene::SeenFace{&face, set_up.eye_m}};
            const double reference = scene::reference_light(seen, lens, {});
            const scene::FaceLight planned = scene::face_light(face, projector_from_prop.matrix(), reference);
            for (int j = 0; j < 100; ++j) {
                const int row = j / 10;
                const double a = (j % 10 + 0.5) / 10.0;
                const double b = (row + 0.5) / 10.0;
                const glm::dvec3 s = glm::mix(glm::mix(face.corners[0], face.corners[1], a),
                                              glm::mix(face.corners[3], face.corners[2], a), b);
                const exact::Vector q = exact::Rigid(set_up.table_from_projector).inverse_point(exact::of(s));
                const glm::dvec2 pixel(static_cast<double>(1920 * q.x / q.z + 640),
                                       static_cast<double>(1920 * q.y / q.z + 400));
                const auto exact = static_cast<double>(exact_gain(set_up, face, exact::of(s), reference));
                largest = std::fmax(largest, exact);
                off = std::fmax(off, std::abs(scene::gain(planned, set_up.projector, pixel) - exact));
            }
        }
        // Two factors of the gain are rounded to 32 bits. Below the smallest sine the face is exactly dark.
        result.rows.push_back(
            {fmt::format("{:g} deg: gain off the exact one, of 1", degrees), 0x1p-23 * largest, off});
    }
    return result;
}

/// Focal lengths and shifts at the limits of the settings, and far beyond them.
StabilityResult intrinsics(const StabilityOptions&) {
    StabilityResult result;
    struct Lens {
        std::string name;
        geometry::Pinhole pinhole;
        double height_m;
        glm::dvec3 prop_m{0.0}; ///< moved to where the picture is
    };
    const std::vector<Lens> lenses{
        {"shortest lens allowed: ", {1280, 800, 50, 50, 640, 400}, 1.2},
        {"longest: ", {8192, 8192, 200000, 200000, 4096, 4096}, 3.0},
        {"one axis shortest, one longest: ", {1280, 800, 50, 200000, 640, 400}, 1.2},
        {"shift of one and a half pictures: ", {1280, 800, 1920, 1920, 2560, -800}, 1.2, {-1.2, -0.7, 0.0}},
        {"smallest picture: ", {64, 64, 96, 96, 32, 32}, 1.2},
        {"fx 1e-3: ", {1280, 800, 1e-3, 1920, 640, 400}, 1.2},
        {"fx and fy 1e9: ", {1280, 800, 1e9, 1e9, 640, 400}, 1.2}};
    for (const Lens& lens : lenses) {
        exact::SetUp set_up = usual_set_up();
        set_up.projector = lens.pinhole;
        set_up.table_from_projector.translation.z = lens.height_m;
        set_up.table_from_prop.translation = lens.prop_m;
        set_up.eye_m += lens.prop_m;
        // With a focal length of f pixels, rounding to 32 bits is f x 2^-24 pixels.
        const double size =
            std::fmax(lens.pinhole.width, 0.5 * std::fmax(lens.pinhole.fx, lens.pinhole.fy)) / 1280.0;
        for (StabilityRow& row :
             rows_of(figures_of(set_up), lens.name, 2.0 * size * bound_px, 2.0 * size * gpu_bound_px, 0.0)) {
            result.rows.push_back(std::move(row));
        }
    }
    return result;
}

StabilityResult refused_intrinsics(const StabilityOptions&) {
    double taken = 0.0;
    for (const std::string value : {"0.0", "-1920.0", "nan", "inf", "1e-300", "49.9", "200001.0"}) {
        taken += settings::parse_settings("[projector]\nfx = " + value + "\n", "kiosk.toml") ? 1.0 : 0.0;
    }
    for (const std::string shift : {"nan", "inf", "-1281.0", "2561.0"}) {
        taken += settings::parse_settings("[projector]\ncx = " + shift + "\n", "kiosk.toml") ? 1.0 : 0.0;
    }
    taken += settings::parse_settings("[projector]\nfx = 1920.0\n", "kiosk.toml") ? 0.0 : 1.0;
    return {{{"taken, or a usual one refused", 0.0, taken}}};
}

} // namespace

std::vector<StabilityCase> projector_cases() {
    const std::string theme = "projector";
    return {{theme, "grazing a face, 90 down to 0.06 degrees", FloatingPoint::Strict, grazing},
            {theme, "below the slant at which a face goes dark", FloatingPoint::Strict, below_the_limit},
            {theme, "light on a grazed face", FloatingPoint::Strict, light},
            {theme, "near-singular intrinsics", FloatingPoint::Strict, intrinsics},
            {theme, "intrinsics that are none", FloatingPoint::Free, refused_intrinsics}};
}

} // namespace frustumscreen::bench
