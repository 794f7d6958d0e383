// A site in the prop: zooms from 1 to the largest, the way into a region and back, a place where four regions meet,
// regions without height or extent, depths behind a face that differ a millionfold, what the face cuts off, 32 bits
// of a region at any size, and eyes on a face's plane.

#include "app/bench/stability/picture.h"
#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/exhibit/site_travel.h"
#include "app/geometry/collineation.h"
#include "app/scene/cell_plan.h"
#include "app/world/site_view.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

using exact::Real;

constexpr double rounding = 0x1p-53;

/// Places of the box: some corners and a few more.
std::vector<glm::dvec3> site_places() {
    std::vector<glm::dvec3> places{
        {0.0, 0.0, 0.0}, {-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}, {0.5, -0.5, 0.3}, {1e-9, -1e-12, 1e-15}};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.5, 0.5);
    for (int k = 0; k < 20; ++k) {
        places.emplace_back(any(random), any(random), 0.5 + any(random));
    }
    return places;
}

std::vector<double> zooms() {
    std::vector<double> zooms = sweep(1.0, world::max_zoom, 2);
    zooms.insert(zooms.end(), {1.0 + 1e-15, 1.0 + 1e-10, 1.0 + 1e-8, 1.0 + 1e-4});
    return zooms;
}

/// On the way the size is exp(L share), L the logarithm of the last one. With w = (exp(L share) - 1) / (exp(L) - 1) a place is at
/// (1 - w) X + w z (X - c).
StabilityResult way_there_and_back(const StabilityOptions&) {
    double off_size = 0.0, off_line = 0.0, off_back = 0.0, backwards = 0.0, off_place = 0.0;
    constexpr int steps = 64;
    for (const double zoom : zooms()) {
        const Real log_zoom = std::log(static_cast<Real>(zoom));
        for (const glm::dvec3& middle : site_places()) {
            const world::SiteView goal = world::view_of(middle, zoom);
            for (const glm::dvec3& place : site_places()) {
                const exact::Vector begin = exact::of(place);
                const exact::Vector end = static_cast<Real>(zoom) * (begin - exact::of(middle));
                const exact::Vector way = end - begin;
                const Real length2 = exact::dot(way, way);
                Real last = -1.0L;
                for (int step = 0; step <= steps; ++step) {
                    const double share = static_cast<double>(step) / steps;
                    const world::SiteView view = world::between({}, goal, share);
                    const exact::Vector at = exact::of(view.point(place)) - begin;
                    if (length2 > 0.0L) {
                        const Real along = exact::dot(at, way) / length2;
                        const Real away = exact::length(at - along * way);
                        off_line = std::fmax(off_line, static_cast<double>(away) / zoom);
                        const bool is_far =
                            std::sqrt(length2) > 1e-6L; // else roundings are as long as the way
                        backwards += is_far && along < last ? 1.0 : 0.0;
                        last = along;
                    }
                    const Real size = std::exp(log_zoom * static_cast<Real>(share));
                    off_size = std::fmax(off_size, std::fabs(static_cast<double>(view.zoom / size - 1.0L)));
                    const glm::dvec3 back = world::between(goal, {}, 1.0 - share).point(place);
                    off_back = std::fmax(off_back, glm::distance(back, view.point(place)) / zoom);
                    off_place = std::fmax(off_place, glm::distance(view.place_at(view.point(place)), place));
                }
            }
        }
    }
    // The weight's two exponents round by L roundings each, and so do a few products; a place moves by up to 2 zooms.
    const double bound = (4.0 * std::log(world::max_zoom) + 4.0) * rounding;
    return {{{"size, relative", bound, off_size},
             {"off the straight line, of the zoom", 8.0 * rounding, off_line},
             {"steps back", 0.0, backwards},
             {"there against back, of the zoom", 4.0 * bound, off_back},
             {"place at its own picture, box", 8.0 * rounding, off_place}}};
}

/// Places beside the corner that four regions share, and rays down at them.
StabilityResult where_four_regions_meet(const StabilityOptions&) {
    const glm::dvec2 corner(0.125, -0.25);
    std::vector<world::RegionBox> regions;
    for (const glm::dvec2& to :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::dvec2 other = corner + 0.25 * to;
        regions.push_back({{glm::min(corner, other), 0.0}, {glm::max(corner, other), 0.2}});
    }
    double none = 0.0, none_on_ray = 0.0, other = 0.0;
    for (const double away : {0.0, 1e-300, 1e-17, 1e-12, 1e-6}) {
        for (int k = 0; k < 16; ++k) {
            const double angle = 0.4 * k;
            const glm::dvec2 place = corner + away * glm::dvec2(std::cos(angle), std::sin(angle));
            const std::optional<std::size_t> found = world::region_at(regions, place);
            none += found ? 0.0 : 1.0;
            other += found && (glm::any(glm::lessThan(place, glm::dvec2(regions[*found].low))) ||
                               glm::any(glm::greaterThan(place, glm::dvec2(regions[*found].high))))
                         ? 1.0
                         : 0.0;
            for (const double slant : {0.0, 1e-300, 1e-9, 0.5}) {
                const glm::dvec3 along(slant, -slant, -1.0);
                none_on_ray +=
                    world::region_on_ray(regions, glm::dvec3(place, 0.1) - 3.0 * along, along) ? 0.0 : 1.0;
            }
        }
    }
    return {{{"places in no region", 0.0, none},
             {"places in another region", 0.0, other},
             {"rays that come down on none", 0.0, none_on_ray}}};
}

/// A region that is one point, a line, or flat; and a flat site.
StabilityResult without_extent(const StabilityOptions&) {
    const std::vector<world::RegionBox> regions{{{0.1, 0.1, 0.0}, {0.1, 0.1, 0.0}},
                                                {{-0.5, 0.2, 0.0}, {0.5, 0.2, 0.0}},
                                                {{-0.5, -0.5, 0.0}, {0.0, 0.0, 0.0}},
                                                {{0.2, -0.5, 0.3}, {0.5, 0.0, 0.3}}};
    const exhibit::SiteGround ground =
        exhibit::site_ground(regions, {1.0, 1.0, 0.3}, 0.16, geometry::make_frustum({}));
    double not_finite = 0.0, beyond = 0.0;
    for (const world::SiteView& view : ground.views) {
        const double sum = view.zoom + view.offset.x + view.offset.y + view.offset.z;
        not_finite += std::isfinite(sum) ? 0.0 : 1.0;
        beyond += view.zoom >= 1.0 && view.zoom <= world::max_zoom ? 0.0 : 1.0;
    }
    double passed = 0.0;
    for (const glm::dvec3& from : {glm::dvec3(-0.2, -0.3, 4.0), glm::dvec3(3.0, -0.3, 3.3)}) {
        const glm::dvec3 along = glm::dvec3(-0.25, -0.25, 0.0) - from;
        passed += world::region_on_ray(regions, from, along) == 2U ? 0.0 : 1.0;
    }
    return {{{"views that are not finite", 0.0, not_finite},
             {"zooms beyond the limits", 0.0, beyond},
             {"flat regions that a ray passes", 0.0, passed}}};
}

/// Points on eye rays through each face that the eye looks through, from a ten thousandth of a millimetre behind it to 100 m.
StabilityResult depths_behind_faces(const StabilityOptions&) {
    const exact::SetUp set_up = usual_set_up();
    const geometry::RigidTransform projector_from_prop =
        set_up.table_from_projector.inverse() * set_up.table_from_prop;
    const glm::dmat4 clip_from_prop = set_up.projector.clip_from_point() * projector_from_prop.matrix();
    const glm::dvec3 eye = set_up.table_from_prop.inverse().point(set_up.eye_m);
    double error_px = 0.0, outside = 0.0, backwards = 0.0, points = 0.0, not_cut = 0.0;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0.05, 0.95);
    for (const geometry::PropFace& face : set_up.prop.faces) {
        const std::optional<glm::dmat4> clip = geometry::collineation_behind(
            face.plane, eye, clip_from_prop, std::span(face.corners.data(), face.corners.size()));
        const double sine = face.plane.distance(eye) / glm::distance(eye, face.middle());
        for (int ray = 0; clip && ray < 50; ++ray) {
            const glm::dvec3 on_face = glm::mix(glm::mix(face.corners[0], face.corners[1], any(random)),
                                                face.corners[2], 0.5 * any(random));
            const double to_eye = glm::distance(on_face, eye);
            for (const double before : {1e-12, 1e-9, 1e-6, 1e-3, 0.5 * to_eye, (1.0 - 1e-15) * to_eye, to_eye,
                                        (1.0 + 1e-15) * to_eye, 2.0 * to_eye, 100.0}) {
                const glm::dvec4 at =
                    *clip * glm::dvec4(on_face - before * glm::normalize(on_face - eye), 1.0);
                not_cut += at.z < -at.w ? 0.0 : 1.0;
            }
            double last = -1.0;
            for (const double behind : sweep(1e-7, 100.0, 1)) {
                const glm::dvec3 x = on_face + behind * glm::normalize(on_face - eye);
                const std::optional<exact::Seen> seen = set_up.see(face, exact::of(x));
                const glm::dvec4 at = *clip * glm::dvec4(x, 1.0);
                const double depth = at.z / at.w;
                outside += at.w > 0.0 && depth >= -1.0 && depth <= 1.0 ? 0.0 : 1.0;
                backwards += depth < last ? 1.0 : 0.0;
                last = depth;
                if (seen && seen->in_picture) {
                    const double u = (at.x / at.w + 1.0) / 2.0 * set_up.projector.width;
                    const double v = (at.y / at.w + 1.0) / 2.0 * set_up.projector.height;
                    error_px = std::fmax(error_px, sine * std::hypot(u - static_cast<double>(seen->u),
                                                                     v - static_cast<double>(seen->v)));
                    points += 1.0;
                }
            }
        }
    }
    return {{{"64-bit, px, times the sine of the eye", bound_px, error_px},
             {"depths outside of the range", 0.0, outside},
             {"depths that fall along a ray", 0.0, backwards},
             {"places before the face that it does not cut off", 0.0, not_cut},
             {"points compared, short of 1000", 0.0, std::fmax(0.0, 1000.0 - points)}}};
}

constexpr double region_box = 1.0 / 16.0; ///< along the site's longer side
constexpr double site_m = 0.16;

/// A region of a site, `zoom` times as large, and places of it that the eye sees through the prop's faces.
SeenArtifact region_behind_faces(const exact::SetUp& set_up, const glm::dvec3& middle, double zoom) {
    SeenArtifact region;
    const world::SiteView view = world::view_of(middle, zoom);
    const glm::dvec3 eye = set_up.table_from_prop.inverse().point(set_up.eye_m);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0.05, 0.95);
    for (int k = 0; k < 6000; ++k) {
        const geometry::PropFace& face =
            set_up.prop.faces[static_cast<std::size_t>(k) % set_up.prop.faces.size()];
        const glm::dvec3 on_face = glm::mix(glm::mix(face.corners[0], face.corners[1], any(random)),
                                            face.corners[2], 0.5 * any(random));
        const glm::dvec3 x = on_face + std::pow(10.0, -4.0 * any(random)) * glm::normalize(on_face - eye);
        const glm::dvec3 unit = (view.place_at(x / site_m) - middle) / region_box + glm::dvec3(0.5, 0.5, 0.0);
        if (glm::any(glm::lessThan(unit, glm::dvec3(0.0))) ||
            glm::any(glm::greaterThan(unit, glm::dvec3(1.0)))) {
            continue;
        }
        pack::PackVertex vertex;
        for (int axis = 0; axis < 3; ++axis) {
            vertex.position[static_cast<std::size_t>(axis)] =
                static_cast<std::uint16_t>(std::lround(65535.0 * unit[axis]));
        }
        region.level.indices.push_back(static_cast<std::uint32_t>(region.level.vertices.size()));
        region.level.vertices.push_back(vertex);
    }
    region.level.indices.resize(region.level.indices.size() / 3 * 3);
    region.level.clusters.push_back({.first_index = 0,
                                     .index_count = static_cast<std::uint32_t>(region.level.indices.size()),
                                     .centre = {0.0F, 0.0F, 0.5F},
                                     .radius = 1.0F});
    constexpr glm::dvec3 cube(1.0);
    region.placed = {.triangles =
                         std::make_shared<scene::LevelTriangles>(scene::triangles_of(region.level, cube)),
                     .box_size = cube,
                     .metres_per_box = region_box * site_m,
                     .drawable = {},
                     .samples = 4};
    world::CellPose pose;
    pose.box_from_geometry =
        view.matrix() * glm::scale(glm::translate(glm::dmat4(1.0), middle), glm::dvec3(region_box));
    scene::set_pose(region.placed, pose, site_m);
    region.placed.beyond = true;
    return region;
}

/// The stored positions of a region that is far larger than the prop, with the plan's 32-bit matrix.
StabilityResult regions_of_any_size(const StabilityOptions&) {
    StabilityResult result;
    const exact::SetUp set_up = usual_set_up();
    const glm::dvec3 middle(0.3, -0.2, 0.05);
    for (const double zoom : {16.0, 100.0, 1000.0}) {
        const SeenArtifact region = region_behind_faces(set_up, middle, zoom);
        const scene::FramePlan plan = plan_of(set_up, region);
        double error_px = 0.0, points = 0.0;
        for (const scene::Draw& draw : plan.draws) {
            const geometry::PropFace& face =
                set_up.prop
                    .faces[static_cast<std::size_t>(plan.faces[static_cast<std::size_t>(draw.face)].face)];
            const double sine =
                static_cast<double>(set_up.height(face, set_up.eye_in_prop()) /
                                    exact::length(set_up.eye_in_prop() - exact::of(face.middle())));
            for (const pack::PackVertex& vertex : region.level.vertices) {
                const auto along = [&](std::size_t axis, Real from) {
                    return static_cast<Real>(zoom * region_box * site_m) *
                           (vertex.position[axis] / 65535.0L - from);
                };
                const exact::Vector x{along(0, 0.5L), along(1, 0.5L), along(2, 0.0L)};
                const std::optional<exact::Seen> seen = set_up.see(face, x);
                if (!seen || !seen->on_face || !seen->in_picture || !(set_up.height(face, x) < 0.0L)) {
                    continue;
                }
                const glm::vec3 unit =
                    glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / 65535.0F;
                const glm::vec4 at = draw.clip_from_unit * glm::vec4(unit, 1.0F);
                const double u = (static_cast<double>(at.x / at.w) + 1.0) / 2.0 * set_up.projector.width;
                const double v = (static_cast<double>(at.y / at.w) + 1.0) / 2.0 * set_up.projector.height;
                error_px = std::fmax(error_px, sine * std::hypot(u - static_cast<double>(seen->u),
                                                                 v - static_cast<double>(seen->v)));
                points += 1.0;
            }
        }
        const double size = zoom * region_box; // of the prop's
        append(result, {{fmt::format("{:g} times: 32-bit, px, times the sine of the eye", zoom),
                         (1.0 + size) * gpu_bound_px, error_px},
                        {fmt::format("{:g} times: points compared, short of 100", zoom), 0.0,
                         std::fmax(0.0, 100.0 - points)}});
    }
    return result;
}

/// Eyes on the plane of a face, and a little above and below it, at and beside the face.
StabilityResult eyes_on_a_face(const StabilityOptions&) {
    double wrong = 0.0, not_finite = 0.0, drawn = 0.0;
    for (std::size_t number = 0; number < usual_set_up().prop.faces.size(); ++number) {
        for (const double height_m : {0.0, 1e-300, -1e-300, 1e-15, -1e-15, 1e-6, -1e-6, -1e-3}) {
            for (const double beside_m : {0.01, 0.3}) {
                exact::SetUp set_up = usual_set_up();
                const geometry::PropFace& face = set_up.prop.faces[number];
                set_up.eye_m = face.middle() + height_m * face.plane.normal +
                               beside_m * glm::normalize(face.corners[0] - face.corners[1]);
                const SeenArtifact region = region_behind_faces(usual_set_up(), {0.3, -0.2, 0.05}, 16.0);
                const scene::FramePlan plan = plan_of(set_up, region);
                for (const scene::Draw& draw : plan.draws) {
                    wrong += plan.faces[static_cast<std::size_t>(draw.face)].face == static_cast<int>(number)
                                 ? 1.0
                                 : 0.0;
                    drawn += 1.0;
                }
                not_finite += figures_of(set_up, region, plan).not_finite;
            }
        }
    }
    return {{{"draws on that face", 0.0, wrong},
             {"numbers in the plans that are not finite", 0.0, not_finite},
             {"draws on others, short of 10", 0.0, std::fmax(0.0, 10.0 - drawn)}}};
}

} // namespace

std::vector<StabilityCase> site_cases() {
    const std::string theme = "site";
    return {
        {theme, "zooms of 1 to 1000, there and back", FloatingPoint::Strict, way_there_and_back},
        {theme, "a place where four regions meet", FloatingPoint::Strict, where_four_regions_meet},
        {theme, "regions without height or extent", FloatingPoint::Strict, without_extent},
        {theme, "depths of 100 nm to 100 m behind a face", FloatingPoint::Strict, depths_behind_faces},
        {theme, "regions as large as the prop to 60 times it", FloatingPoint::Strict, regions_of_any_size},
        {theme, "an eye on a face's plane and behind it", FloatingPoint::Strict, eyes_on_a_face}};
}

} // namespace frustumscreen::bench
