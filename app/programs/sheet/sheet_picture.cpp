#include "app/programs/sheet/sheet_picture.h"

#include "app/exhibit/canvas.h"
#include "app/simulation/visitor_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

constexpr Colour background{14, 15, 18};
constexpr Colour bright{232, 232, 228};
constexpr Colour quiet{138, 142, 150};
constexpr Colour outline_colour{66, 96, 100};

constexpr int margin = 28;
constexpr int gap = 22;
constexpr int header_height = 84;
constexpr int label_height = 46;
constexpr glm::ivec2 projector_tile{400, 340};
constexpr glm::ivec2 visitor_tile{544, 340};
constexpr glm::ivec2 cell(projector_tile.x + 4 + visitor_tile.x, projector_tile.y + label_height);

constexpr double most_zoom = 1.5; ///< of a view that shows the prop alone
constexpr double least_zoom = 0.5;
constexpr double filled = 0.94;  ///< share of the tile
constexpr int lit_code = 40;     ///< letters in a picture are brighter
constexpr int between_looks = 4; ///< pixels from one that is looked at to the next
constexpr double beside_the_prop_px = 4.0;

/// A part of the projector's picture, in its pixels.
struct Crop {
    glm::dvec2 low{0.0};
    glm::dvec2 size{1.0};
};

std::vector<std::array<glm::dvec2, 4>> face_outlines(const VisitorScene& scene) {
    const RigidTransform projector_from_prop = scene.table_from_projector.inverse() * scene.table_from_prop;
    std::vector<std::array<glm::dvec2, 4>> outlines;
    for (const PropFace& face : scene.prop.faces) {
        std::array<glm::dvec2, 4> outline{};
        bool visible = true;
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const std::optional<glm::dvec2> pixel =
                scene.projector.pixel(projector_from_prop.point(face.corners[k]));
            visible = visible && pixel.has_value();
            outline[k] = pixel.value_or(glm::dvec2(0.0));
        }
        if (visible) {
            outlines.push_back(outline);
        }
    }
    return outlines;
}

/// A crop around the prop, in the tile's shape, a little wider.
Crop around(const std::vector<std::array<glm::dvec2, 4>>& outlines, const Image8& picture) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const auto& outline : outlines) {
        for (const glm::dvec2& corner : outline) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    if (outlines.empty()) {
        low = glm::dvec2(0.0);
        high = glm::dvec2(picture.width, picture.height);
    }
    const glm::dvec2 wanted = 1.12 * (high - low);
    const double scale = std::max(wanted.x / projector_tile.x, wanted.y / projector_tile.y);
    const glm::dvec2 size = scale * glm::dvec2(projector_tile);
    return {(low + high) / 2.0 - size / 2.0, size};
}

std::string where(const Situation& situation) {
    const glm::dvec3& prop = situation.table_from_prop.translation;
    const glm::dvec3 ahead = situation.table_from_prop.direction({1.0, 0.0, 0.0});
    const glm::dvec3 sight = situation.eye_m - prop;
    const double elevation = std::atan2(sight.z, std::hypot(sight.x, sight.y));
    return fmt::format(
        "prop at {:+.0f}, {:+.0f} cm, turned {:.0f}\u00b0; eye {:.0f} cm away, {:.0f}\u00b0 up",
        prop.x * 100.0, prop.y * 100.0, glm::degrees(std::atan2(ahead.y, ahead.x)),
        glm::length(sight) * 100.0, glm::degrees(elevation));
}

bool inside(const std::array<glm::dvec2, 4>& outline, const glm::dvec2& pixel) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec2 edge = outline[(k + 1) % outline.size()] - outline[k];
        const glm::dvec2 to = pixel - outline[k];
        const double beside = (edge.x * to.y - edge.y * to.x) / std::max(glm::length(edge), 1e-9);
        least = std::min(least, beside);
        most = std::max(most, beside);
    }
    return least >= -beside_the_prop_px || most <= beside_the_prop_px;
}

/// Where the picture lights the table itself: the caption.
std::vector<glm::dvec3> lit_on_table(const VisitorScene& scene, const Image8& picture,
                                     const std::vector<std::array<glm::dvec2, 4>>& outlines) {
    std::vector<glm::dvec3> points;
    for (int y = 0; y < picture.height; y += between_looks) {
        for (int x = 0; x < picture.width; x += between_looks) {
            const glm::u8vec4 code = picture.at(x, y);
            const glm::dvec2 pixel(x + 0.5, y + 0.5);
            if (std::max({code.r, code.g, code.b}) < lit_code ||
                std::any_of(outlines.begin(), outlines.end(),
                            [&](const auto& outline) { return inside(outline, pixel); })) {
                continue;
            }
            const glm::dvec3 lens = scene.table_from_projector.translation;
            const glm::dvec3 ray = scene.table_from_projector.direction(scene.projector.ray(pixel));
            if (ray.z < 0.0) {
                points.push_back(lens - ray * (lens.z / ray.z));
            }
        }
    }
    return points;
}

/// The visitor's camera, turned a little and as wide as the prop and its caption need.
VisitorCamera framed(const VisitorScene& scene, const Image8& picture,
                     const std::vector<std::array<glm::dvec2, 4>>& outlines) {
    VisitorCamera camera =
        visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, visitor_tile.x, visitor_tile.y);
    std::vector<glm::dvec3> points = lit_on_table(scene, picture, outlines);
    for (const PropFace& face : scene.prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            points.push_back(scene.table_from_prop.point(corner));
        }
    }
    const RigidTransform camera_from_table = camera.table_from_camera.inverse();
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec3& point : points) {
        if (const auto pixel = camera.pinhole.pixel(camera_from_table.point(point)); pixel) {
            low = glm::min(low, *pixel);
            high = glm::max(high, *pixel);
        }
    }
    const glm::dvec2 size = glm::max(high - low, glm::dvec2(1.0));
    const double scale = std::clamp(filled * std::min(visitor_tile.x / size.x, visitor_tile.y / size.y),
                                    least_zoom, most_zoom);
    const glm::dvec2 centre(camera.pinhole.cx, camera.pinhole.cy);
    const glm::dvec2 moved = glm::dvec2(visitor_tile) / 2.0 + scale * (centre - (low + high) / 2.0);
    camera.pinhole.fx = camera.pinhole.fy = camera.pinhole.fx * scale;
    camera.pinhole.cx = moved.x;
    camera.pinhole.cy = moved.y;
    return camera;
}

void draw_frame(Canvas& canvas, const Settings& settings, const SheetFrame& frame, const Image8& picture,
                const glm::ivec2& corner, const Typesetter& typesetter) {
    const VisitorScene scene = visitor_scene(settings, frame.situation, picture.width, picture.height);
    const std::vector<std::array<glm::dvec2, 4>> outlines = face_outlines(scene);
    const Crop crop = around(outlines, picture);
    Canvas tile(projector_tile.x, projector_tile.y, Colour(0));
    tile.picture(picture, crop.low, crop.size, {0, 0}, projector_tile);
    for (std::array<glm::dvec2, 4> outline : outlines) {
        for (glm::dvec2& point : outline) {
            point = (point - crop.low) / crop.size * glm::dvec2(projector_tile);
        }
        tile.outline(outline, 1.0, outline_colour, 0.55);
    }
    canvas.picture(tile.image(), {0, 0}, glm::dvec2(projector_tile), corner, projector_tile);

    const VisitorCamera camera = framed(scene, picture, outlines);
    const glm::ivec2 right = corner + glm::ivec2(projector_tile.x + 4, 0);
    canvas.picture(visitor_view(scene, picture, camera), {0, 0}, glm::dvec2(visitor_tile), right,
                   visitor_tile);

    const double baseline = corner.y + projector_tile.y + 8.0;
    canvas.text(typesetter, frame.label, {corner.x, baseline}, 17.0, bright, {}, true);
    canvas.text(typesetter, where(frame.situation), {right.x + visitor_tile.x, baseline + 2.0}, 14.0, quiet,
                {1.0, 0.0});
}

} // namespace

Result<Image8> contact_sheet(const Settings& settings, const std::vector<SheetFrame>& frames,
                             const SheetOptions& options, const Typesetter& typesetter,
                             const std::function<void(std::size_t, std::size_t)>& progress) {
    const int count = static_cast<int>(frames.size());
    const int columns =
        std::clamp(options.columns > 0 ? options.columns : (count > 3 ? 2 : 1), 1, std::max(count, 1));
    const int rows = (count + columns - 1) / columns;
    Canvas canvas(2 * margin + columns * cell.x + (columns - 1) * gap,
                  header_height + rows * cell.y + (rows - 1) * gap / 2 + margin / 2, background);
    canvas.text(typesetter, options.title, {margin, 20.0}, 26.0, bright, {}, true);
    canvas.text(
        typesetter,
        "left: the projector\u2019s picture around the prop    right: what the visitor\u2019s eye sees",
        {margin, 52.0}, 15.0, quiet);
    for (int k = 0; k < count; ++k) {
        const SheetFrame& frame = frames[static_cast<std::size_t>(k)];
        const Result<Image8> picture = read_picture(frame, settings.projector.pinhole);
        if (!picture) {
            return tl::unexpected<Error>(picture.error());
        }
        const glm::ivec2 corner(margin + (k % columns) * (cell.x + gap),
                                header_height + (k / columns) * (cell.y + gap / 2));
        draw_frame(canvas, settings, frame, *picture, corner, typesetter);
        progress(static_cast<std::size_t>(k) + 1, frames.size());
    }
    return canvas.take();
}

} // namespace frustumscreen
