#include "app/bench/setup/advice.h"

#include "app/geometry/collineation.h"
#include "app/geometry/corner_fan.h"
#include "app/settings/looking_at.h"
#include "app/settings/whole_zone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr int face_samples = 40; ///< samples along a face's edges
constexpr double margin = 1.001; ///< the picture extends slightly beyond the table

/// The largest upright box that stands on z = 0 and fits into the prop.
geometry::Box largest_box(const geometry::PropShape& prop, double width_by_height) {
    const double half = 0.5 * width_by_height;
    std::vector<glm::dvec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        corners.emplace_back((k & 1U) != 0 ? half : -half, (k & 2U) != 0 ? half : -half,
                             (k & 4U) != 0 ? 1.0 : 0.0);
    }
    const double height = geometry::largest_scale_inside(prop, corners);
    return {{-half * height, -half * height, 0.0}, {half * height, half * height, height}};
}

/// True if the line through two points meets the ellipsoid that fills the box.
bool meets_ellipsoid(const geometry::Box& box, const glm::dvec3& from, const glm::dvec3& through) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const glm::dvec3 half = 0.5 * (box.high - box.low);
    const glm::dvec3 o = (from - middle) / half;
    const glm::dvec3 d = (through - from) / half;
    const double along = glm::dot(o, d);
    return along * along - glm::dot(d, d) * (glm::dot(o, o) - 1.0) > 0.0;
}

/// An eye and a lens, prop frame, and what the eye looks at.
struct Sight {
    glm::dvec3 eye{0.0};
    geometry::Box artifact;
    const geometry::Pinhole& pinhole;
    geometry::RigidTransform projector_from_prop;
};

/// Projector pixels on the artifact, seen through a quadrilateral. At height h of the lens above a plane, a surface at
/// depth Z takes fx fy h / Z^3 pixels a square metre.
double pixels_through(const std::array<glm::dvec3, 4>& corners, double h, const Sight& sight) {
    double pixels = 0.0;
    for (int k = 0; k < face_samples * face_samples; ++k) {
        const double s = (k % face_samples + 0.5) / face_samples;
        const double t = (std::floor(k / face_samples) + 0.5) / face_samples;
        const glm::dvec3 point =
            glm::mix(glm::mix(corners[0], corners[1], s), glm::mix(corners[3], corners[2], s), t);
        if (!meets_ellipsoid(sight.artifact, sight.eye, point)) {
            continue;
        }
        const glm::dvec3 across = glm::mix(corners[1] - corners[0], corners[2] - corners[3], t);
        const glm::dvec3 up = glm::mix(corners[3] - corners[0], corners[2] - corners[1], s);
        const double area = glm::length(glm::cross(across, up)) / (face_samples * face_samples);
        const double depth = sight.projector_from_prop.point(point).z;
        pixels += sight.pinhole.fx * sight.pinhole.fy * h / (depth * depth * depth) * area;
    }
    return pixels;
}

double pixels_on(const geometry::PropShape& prop, const settings::ProjectorSettings& projector,
                 const glm::dvec3& eye_m, double yaw, const geometry::Box& artifact) {
    const geometry::RigidTransform table_from_prop{glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), glm::dvec3(0.0)};
    const Sight sight{.eye = table_from_prop.inverse().point(eye_m),
                      .artifact = artifact,
                      .pinhole = projector.pinhole,
                      .projector_from_prop = projector.table_from_projector.inverse() * table_from_prop};
    const glm::dvec3 lens = sight.projector_from_prop.inverse().translation;
    double pixels = 0.0;
    for (const geometry::PropFace& face : prop.faces) {
        const double h = face.plane.distance(lens);
        if (h <= 0.0 || face.plane.distance(sight.eye) <= 0.0) {
            continue;
        }
        const std::size_t count = face.corners.size();
        for (std::size_t quad = 0; quad < geometry::fan_quads(count); ++quad) {
            const auto [a, b, c, d] = geometry::fan_quad(count, quad);
            pixels += pixels_through({face.corners[a], face.corners[b], face.corners[c], face.corners[d]}, h,
                                     sight);
        }
    }
    return pixels;
}

/// The points that the picture must cover, table frame: the corners of the table, and those of the prop at its edges.
std::vector<glm::dvec3> to_cover(const settings::Settings& settings) {
    const glm::dvec2 table = 0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m);
    const glm::dvec2 reach = settings::reach_on_table(settings.prop, settings.table);
    const glm::dvec2 top = reach + settings.prop.top_m / std::numbers::sqrt2;
    std::vector<glm::dvec3> points;
    for (const glm::dvec2 side :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        points.emplace_back(side * table, 0.0);
        points.emplace_back(side * top, settings.prop.height_m);
    }
    return points;
}

bool covers(const settings::Settings& settings) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    const geometry::RigidTransform projector_from_table = settings.projector.table_from_projector.inverse();
    const std::vector<glm::dvec3> points = to_cover(settings);
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
        const auto pixel = pinhole.pixel(projector_from_table.point(point));
        const double spare = 0.5 * (margin - 1.0) * pinhole.width; // tolerance for rounding
        return pixel && pixel->x >= -spare && pixel->y >= -spare && pixel->x <= pinhole.width + spare &&
               pixel->y <= pinhole.height + spare;
    });
}

/// Zooms the lens, and shifts it for a shifted mount, so that the picture just covers the table.
void fit_picture(settings::Settings& settings, Mount mount, double wider) {
    geometry::Pinhole& pinhole = settings.projector.pinhole;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::dvec3& point : to_cover(settings)) {
        const glm::dvec3 seen = settings.projector.table_from_projector.inverse().point(point);
        low = glm::min(low, glm::dvec2(seen) / seen.z);
        high = glm::max(high, glm::dvec2(seen) / seen.z);
    }
    const glm::dvec2 size(pinhole.width, pinhole.height);
    const glm::dvec2 middle = mount == Mount::Shifted ? 0.5 * (low + high) : glm::dvec2(0.0);
    const glm::dvec2 half = glm::max(high - middle, middle - low);
    const double f = std::min(0.5 * size.x / half.x, 0.5 * size.y / half.y) / (margin * wider);
    pinhole.fx = pinhole.fy = f;
    pinhole.cx = 0.5 * size.x - f * middle.x;
    pinhole.cy = 0.5 * size.y - f * middle.y;
}

settings::Settings with_projector(settings::Settings settings, double height_m, double side_m, Mount mount) {
    const glm::dvec3 lens(0.0, side_m, height_m);
    const glm::dvec3 aim = mount == Mount::Tilted ? glm::dvec3(0.0) : glm::dvec3(0.0, side_m, 0.0);
    settings.projector.table_from_projector =
        settings::looking_at(lens, aim, 0.0).value_or(settings.projector.table_from_projector);
    return settings;
}

/// Lengths from `first` to `last` in steps, rounded to values for a carpenter.
std::vector<double> steps(double first, double last, double step) {
    std::vector<double> values;
    const int count = static_cast<int>(std::floor((last - first) / step + 1e-9));
    for (int k = 0; k <= count; ++k) {
        values.push_back(std::round(1e3 * (first + step * k)) / 1e3);
    }
    return values;
}

/// The value of a choice that works: space to slide, times perceived brightness, which is about the root of the light
/// (Stevens 1957: exponents of 0.33 to 0.5).
double worth(const SetUpFigures& figures) {
    return figures.reach_m.x * figures.reach_m.y * std::sqrt(figures.reference);
}

bool is_better(const SetUpChoice& a, const SetUpChoice& b) {
    if (a.works != b.works) {
        return a.works;
    }
    return a.works ? worth(a.figures) > worth(b.figures)
                   : a.figures.light.evenness > b.figures.light.evenness;
}

double height_of(const std::vector<glm::dvec3>& artifact) {
    double height = 0.0;
    for (const glm::dvec3& corner : artifact) {
        height = std::max(height, corner.z);
    }
    return height;
}

/// True if the artifacts in a prop have the required size.
bool is_large_enough(const geometry::PropShape& prop, const SetUpFigures& now, const AdviceOptions& options) {
    if (options.asks_for_zone()) {
        return height_of(settings::usual_artifact(prop)) >= options.artifact_m - 1e-9;
    }
    return largest_box(prop, 1.0).high.z >= 0.995 * now.wide_height_m &&
           largest_box(prop, 0.5).high.z >= 0.995 * now.slim_height_m;
}

std::vector<settings::PropSettings> props_to_try(const settings::Settings& settings, const SetUpFigures& now,
                                                 const AdviceOptions& options) {
    const double table = std::min(settings.table.width_m, settings.table.depth_m);
    std::vector<settings::PropSettings> props;
    for (const double base_m : steps(0.1, 0.65 * table, 0.01)) { // a larger prop could hardly be moved
        for (const double top_m : steps(0.03, 0.6 * base_m, 0.01)) {
            for (const double height_m : steps(0.06, base_m, 0.005)) {
                settings::PropSettings prop = settings.prop;
                prop.kind = settings::PropKind::Frustum;
                prop.base_m = base_m;
                prop.top_m = top_m;
                prop.height_m = height_m;
                if (is_large_enough(settings::make_prop(prop), now, options)) {
                    props.push_back(prop);
                }
            }
        }
    }
    return props;
}

SetUpFigures examine_without_zone(const settings::Settings& settings) {
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    SetUpFigures figures;
    figures.reach_m = settings::reach_on_table(settings.prop, settings.table);
    figures.light =
        settings::light_range(prop, settings.projector.table_from_projector.translation, figures.reach_m);
    figures.reference = settings::even_light(settings);
    figures.wide_height_m = largest_box(prop, 1.0).high.z;
    const geometry::Box slim = largest_box(prop, 0.5);
    figures.slim_height_m = slim.high.z;
    constexpr std::array turned{0.0, 0.25 * std::numbers::pi};
    for (const double yaw : turned) {
        figures.pixels +=
            pixels_on(prop, settings.projector, settings.eye.default_m, yaw, slim) / turned.size();
    }
    figures.covered = covers(settings);
    return figures;
}

void find_zone(const settings::Settings& settings, SetUpFigures& figures) {
    const std::vector<glm::dvec3> artifact = settings::usual_artifact(settings::make_prop(settings.prop));
    figures.usual_height_m = height_of(artifact);
    figures.zone_m =
        2.0 * settings::whole_zone(settings, settings::all_eyes(settings.eye), artifact).rectangle.half_m;
}

/// The best prop for a projector; nothing if there is no prop to try. `props` must be sorted, the smallest first.
std::optional<SetUpChoice> best_prop(const settings::Settings& projector, Mount mount, double wider,
                                     const std::vector<settings::PropSettings>& props,
                                     const AdviceOptions& options, double pixels) {
    std::optional<SetUpChoice> best;
    for (const settings::PropSettings& prop : props) {
        if (best && best->works && prop.base_m > best->settings.prop.base_m) {
            break;
        }
        SetUpChoice choice{
            .settings = projector, .mount = mount, .figures = {}, .works = false, .cost = std::nullopt};
        choice.settings.prop = prop;
        const glm::dvec3 lens = projector.projector.table_from_projector.translation;
        choice.figures.light = settings::light_range(settings::make_prop(prop), lens,
                                                     settings::reach_on_table(prop, projector.table));
        const bool even = choice.figures.light.evenness >= options.evenness;
        if (even || !best || choice.figures.light.evenness > best->figures.light.evenness) {
            fit_picture(choice.settings, mount, wider);
            choice.figures = examine_without_zone(choice.settings);
            choice.works = even && choice.figures.covered && choice.figures.pixels >= pixels;
            if (choice.works && options.asks_for_zone()) {
                find_zone(choice.settings, choice.figures);
                choice.works = choice.figures.zone_m.x >= options.zone_m.x &&
                               choice.figures.zone_m.y >= options.zone_m.y;
            }
        }
        if (!best || is_better(choice, *best)) {
            best = std::move(choice);
        }
    }
    if (best && !options.asks_for_zone()) {
        find_zone(best->settings, best->figures);
    }
    return best;
}

} // namespace

std::string_view name_of(Mount mount) {
    return mount == Mount::Tilted ? "tilted" : "shifted";
}

SetUpFigures examine(const settings::Settings& settings) {
    SetUpFigures figures = examine_without_zone(settings);
    find_zone(settings, figures);
    return figures;
}

SetUpChoice as_it_is(const settings::Settings& settings) {
    const SetUpFigures figures = examine(settings);
    return {.settings = settings,
            .mount = Mount::Tilted,
            .figures = figures,
            .works = figures.covered,
            .cost = std::nullopt};
}

std::vector<SetUpChoice> choices(const settings::Settings& settings, const AdviceOptions& options,
                                 const std::function<void(double)>& progress) {
    const SetUpFigures now = examine(settings);
    const std::vector<settings::PropSettings> props = props_to_try(settings, now, options);
    const std::vector<double> widths =
        options.asks_for_zone() ? std::vector{1.0, 1.1, 1.2, 1.3, 1.4} : std::vector{1.0};
    settings::Settings other = settings;
    if (options.width > 0) {
        other.projector.pinhole = other.projector.pinhole.scaled_to(options.width, options.height);
    }
    const std::vector<double> heights = steps(options.lowest_m, options.highest_m, 0.1);
    const std::vector<double> sides =
        steps(-options.sides_m, options.sides_m, std::max(options.sides_m, 1e-3));
    std::vector<SetUpChoice> found;
    for (std::size_t k = 0; k < heights.size() * sides.size(); ++k) {
        const double height_m = heights[k / sides.size()];
        const double side_m = sides[k % sides.size()];
        for (const Mount mount : {Mount::Tilted, Mount::Shifted}) {
            if (side_m == 0.0 && mount == Mount::Shifted) {
                continue; // equal to a tilt of zero
            }
            const settings::Settings projector = with_projector(other, height_m, side_m, mount);
            for (const double wider : widths) {
                if (auto choice =
                        best_prop(projector, mount, wider, props, options, options.pixels * now.pixels)) {
                    found.push_back(std::move(*choice));
                }
            }
        }
        progress(static_cast<double>(k + 1) / static_cast<double>(heights.size() * sides.size()));
    }
    return found;
}

const SetUpChoice* best_of(const std::vector<SetUpChoice>& choices) {
    const auto best = std::min_element(choices.begin(), choices.end(), is_better);
    return best != choices.end() ? &*best : nullptr;
}

std::vector<SetUpChoice*> best_working(std::vector<SetUpChoice>& choices, std::size_t most) {
    std::vector<SetUpChoice*> working;
    for (SetUpChoice& choice : choices) {
        if (choice.works) {
            working.push_back(&choice);
        }
    }
    std::stable_sort(working.begin(), working.end(),
                     [](const SetUpChoice* a, const SetUpChoice* b) { return is_better(*a, *b); });
    working.resize(std::min(working.size(), most));
    return working;
}

} // namespace frustumscreen::bench
