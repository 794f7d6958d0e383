#include "app/programs/sheet/sheet_picture.h"

#include "app/programs/sheet/sheet_cameras.h"
#include "app/simulation/visitor_view.h"
#include "app/typography/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::programs {

namespace {

constexpr typography::Colour background{14, 15, 18};
constexpr typography::Colour bright{232, 232, 228};
constexpr typography::Colour quiet{138, 142, 150};
constexpr typography::Colour outline_colour{66, 96, 100};

constexpr int margin = 28;
constexpr int gap = 22;
constexpr int header_height = 84;
constexpr int label_height = 46;
constexpr int between_tiles = 4;

/// A frame's two pictures, of equal height.
struct Tiles {
    glm::ivec2 projector;
    glm::ivec2 visitor;
    [[nodiscard]] glm::ivec2 cell() const {
        return {projector.x + between_tiles + visitor.x, projector.y + label_height};
    }
};
constexpr Tiles around_prop{{400, 340}, {544, 340}};
constexpr Tiles whole_table{{832, 520}, {832, 520}}; // large enough to read the words

/// A part of the projector's picture, in its pixels.
struct Crop {
    glm::dvec2 low{0.0};
    glm::dvec2 size{1.0};
};

/// The part that a tile shows, in the tile's aspect ratio: the prop's outlines with a margin, or the whole
/// picture.
Crop crop_of(const std::vector<FaceOutline>& outlines, const image::Image8& picture, const glm::ivec2& tile) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const auto& outline : outlines) {
        for (const glm::dvec2& corner : outline) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    double margin_factor = 1.12;
    if (outlines.empty()) {
        low = glm::dvec2(0.0);
        high = glm::dvec2(picture.width, picture.height);
        margin_factor = 1.0;
    }
    const glm::dvec2 wanted = margin_factor * (high - low);
    const double scale = std::max(wanted.x / tile.x, wanted.y / tile.y);
    const glm::dvec2 size = scale * glm::dvec2(tile);
    return {(low + high) / 2.0 - size / 2.0, size};
}

std::string where(const tracking::TrackedState& tracked_state) {
    const glm::dvec3& prop = tracked_state.table_from_prop.translation;
    const glm::dvec3 ahead = tracked_state.table_from_prop.direction({1.0, 0.0, 0.0});
    const glm::dvec3 sight = tracked_state.eye_m - prop;
    const double elevation = std::atan2(sight.z, std::hypot(sight.x, sight.y));
    // Rounds to whole numbers, because a small negative value would be written as -0.
    return fmt::format("prop at {:+}, {:+} cm, turned {}\u00b0; eye {} cm away, {}\u00b0 up",
                       std::lround(prop.x * 100.0), std::lround(prop.y * 100.0),
                       std::lround(glm::degrees(std::atan2(ahead.y, ahead.x))),
                       std::lround(glm::length(sight) * 100.0), std::lround(glm::degrees(elevation)));
}

void draw_frame(typography::Canvas& canvas, const settings::Settings& settings, const SheetFrame& frame,
                const image::Image8& picture, bool whole, const glm::ivec2& corner,
                const typography::Typesetter& typesetter) {
    const Tiles& tiles = whole ? whole_table : around_prop;
    const simulation::VisitorScene scene =
        visitor_scene(settings, frame.tracked_state, picture.width, picture.height);
    std::vector<FaceOutline> outlines = face_outlines(scene);
    const Crop crop = crop_of(whole ? std::vector<FaceOutline>() : outlines, picture, tiles.projector);
    typography::Canvas tile(tiles.projector.x, tiles.projector.y, typography::Colour(0));
    tile.picture(picture, crop.low, crop.size, {0, 0}, tiles.projector);
    for (FaceOutline& outline : outlines) {
        for (glm::dvec2& point : outline) {
            point = (point - crop.low) / crop.size * glm::dvec2(tiles.projector);
        }
        tile.outline(outline, 1.0, outline_colour, 0.55);
    }
    canvas.picture(tile.image(), {0, 0}, glm::dvec2(tiles.projector), corner, tiles.projector);

    const simulation::VisitorCamera camera =
        whole ? table_camera(scene, tiles.visitor) : framed_camera(scene, tiles.visitor);
    const glm::ivec2 right = corner + glm::ivec2(tiles.projector.x + between_tiles, 0);
    canvas.picture(simulation::visitor_view(scene, picture, camera), {0, 0}, glm::dvec2(tiles.visitor), right,
                   tiles.visitor);

    const double baseline = corner.y + tiles.projector.y + 8.0;
    canvas.text(typesetter, frame.label, {corner.x, baseline}, 17.0, bright, {}, true);
    canvas.text(typesetter, where(frame.tracked_state), {right.x + tiles.visitor.x, baseline + 2.0}, 14.0,
                quiet, {1.0, 0.0});
}

} // namespace

Result<image::Image8> contact_sheet(const settings::Settings& settings, const std::vector<SheetFrame>& frames,
                                    const SheetOptions& options, const typography::Typesetter& typesetter,
                                    const std::function<void(std::size_t, std::size_t)>& progress) {
    const int count = static_cast<int>(frames.size());
    const int columns =
        std::clamp(options.columns > 0 ? options.columns : (count > 3 ? 2 : 1), 1, std::max(count, 1));
    const int rows = (count + columns - 1) / columns;
    const glm::ivec2 cell = (options.whole_table ? whole_table : around_prop).cell();
    typography::Canvas canvas(2 * margin + columns * cell.x + (columns - 1) * gap,
                              header_height + rows * cell.y + (rows - 1) * gap / 2 + margin / 2, background);
    canvas.text(typesetter, options.title, {margin, 20.0}, 26.0, bright, {}, true);
    canvas.text(typesetter,
                fmt::format("left: the projector\u2019s picture{}    right: what the visitor\u2019s eye sees",
                            options.whole_table ? "" : " around the prop"),
                {margin, 52.0}, 15.0, quiet);
    for (int k = 0; k < count; ++k) {
        const SheetFrame& frame = frames[static_cast<std::size_t>(k)];
        TRY(const image::Image8 picture, read_picture(frame, settings.projector.pinhole));
        const glm::ivec2 corner(margin + (k % columns) * (cell.x + gap),
                                header_height + (k / columns) * (cell.y + gap / 2));
        draw_frame(canvas, settings, frame, picture, options.whole_table, corner, typesetter);
        progress(static_cast<std::size_t>(k) + 1, frames.size());
    }
    return canvas.take();
}

} // namespace frustumscreen::programs
