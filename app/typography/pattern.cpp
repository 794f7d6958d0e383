#include "app/typography/pattern.h"

#include "app/typography/canvas.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

namespace frustumscreen::typography {

namespace {

constexpr double grid_m = 0.05;
constexpr Colour white{255, 255, 255};
constexpr Colour grid_colour{74, 96, 124};
constexpr Colour axis_colour{126, 158, 196};
constexpr Colour table_colour{255, 184, 92};
constexpr Colour prop_colour{120, 240, 220};
constexpr Colour unlit_colour{70, 110, 104};

class Projection {
public:
    explicit Projection(const PatternScene& scene)
        : pinhole_(scene.projector), projector_from_table_(scene.table_from_projector.inverse()) {}
    [[nodiscard]] std::optional<glm::dvec2> operator()(const glm::dvec3& table_m) const {
        return pinhole_.pixel(projector_from_table_.point(table_m));
    }

private:
    geometry::Pinhole pinhole_;
    geometry::RigidTransform projector_from_table_;
};

void draw_edge(Canvas& canvas, const Projection& pixel, const glm::dvec3& a, const glm::dvec3& b,
               double width_px, Colour colour) {
    const std::optional<glm::dvec2> from = pixel(a);
    const std::optional<glm::dvec2> to = pixel(b);
    if (from && to) {
        canvas.line(*from, *to, width_px, colour);
    }
}

void draw_grid(Canvas& canvas, const Projection& pixel, const PatternScene& scene,
               const Typesetter& typesetter) {
    const glm::dvec2 half = scene.table_size_m / 2.0;
    const glm::ivec2 lines(glm::floor(half / grid_m + 1e-9));
    const auto label = [&](const glm::dvec2& at_m, double value_m) {
        if (const auto at = pixel({at_m, 0.0}); at && std::abs(value_m) > 1e-9) {
            canvas.text(typesetter, fmt::format("{:.0f}", value_m * 100.0), *at + glm::dvec2(3.0, 1.0), 13.0,
                        axis_colour);
        }
    };
    for (int k = -lines.x; k <= lines.x; ++k) {
        const double x = k * grid_m;
        draw_edge(canvas, pixel, {x, -half.y, 0.0}, {x, half.y, 0.0}, k == 0 ? 2.0 : 1.0,
                  k == 0 ? axis_colour : grid_colour);
        label({x, 0.0}, x);
    }
    for (int k = -lines.y; k <= lines.y; ++k) {
        const double y = k * grid_m;
        draw_edge(canvas, pixel, {-half.x, y, 0.0}, {half.x, y, 0.0}, k == 0 ? 2.0 : 1.0,
                  k == 0 ? axis_colour : grid_colour);
        label({0.0, y}, y);
    }
    const glm::dvec3 corners[4] = {{-half, 0.0}, {half.x, -half.y, 0.0}, {half, 0.0}, {-half.x, half.y, 0.0}};
    for (int k = 0; k < 4; ++k) {
        draw_edge(canvas, pixel, corners[k], corners[(k + 1) % 4], 2.0, table_colour);
    }
    if (const auto front = pixel({0.0, -half.y, 0.0})) {
        canvas.text(typesetter, "visitor", *front + glm::dvec2(10.0, -8.0), 17.0, table_colour, {0.0, 1.0});
    }
}

/// The outermost pixels, bright; ticks every 100 pixels; brackets in the corners.
void draw_frame(Canvas& canvas, const geometry::Pinhole& projector) {
    const double w = projector.width;
    const double h = projector.height;
    canvas.fill({0, 0}, {w, 1}, white);
    canvas.fill({0, h - 1}, {w, h}, white);
    canvas.fill({0, 0}, {1, h}, white);
    canvas.fill({w - 1, 0}, {w, h}, white);
    for (int x = 100; x < projector.width; x += 100) {
        canvas.fill({x, 0}, {x + 1, 8}, white);
        canvas.fill({x, h - 8}, {x + 1, h}, white);
    }
    for (int y = 100; y < projector.height; y += 100) {
        canvas.fill({0, y}, {8, y + 1}, white);
        canvas.fill({w - 8, y}, {w, y + 1}, white);
    }
    constexpr double inset = 14.0;
    constexpr double arm = 40.0;
    for (const double x : {inset, w - inset}) {
        for (const double y : {inset, h - inset}) {
            canvas.line({x, y}, {x + (x < w / 2 ? arm : -arm), y}, 3.0, white);
            canvas.line({x, y}, {x, y + (y < h / 2 ? arm : -arm)}, 3.0, white);
        }
    }
}

void draw_centre(Canvas& canvas, const geometry::Pinhole& projector) {
    const glm::dvec2 centre(projector.width / 2.0, projector.height / 2.0);
    canvas.line(centre - glm::dvec2(30.0, 0.0), centre + glm::dvec2(30.0, 0.0), 1.0, white);
    canvas.line(centre - glm::dvec2(0.0, 30.0), centre + glm::dvec2(0.0, 30.0), 1.0, white);
    canvas.circle(centre, 20.0, 1.0, white);
}

} // namespace

image::Image8 table_pattern(const PatternScene& scene, const Typesetter& typesetter) {
    Canvas canvas(scene.projector.width, scene.projector.height, Colour(0));
    draw_grid(canvas, Projection(scene), scene, typesetter);
    draw_frame(canvas, scene.projector);
    draw_centre(canvas, scene.projector);
    canvas.text(typesetter,
                fmt::format("{} \u00d7 {} pixels, grid {:.0f} cm", scene.projector.width,
                            scene.projector.height, grid_m * 100.0),
                {30.0, 26.0}, 17.0, white);
    return canvas.take();
}

image::Image8 with_prop(const image::Image8& table, const PatternScene& scene,
                        const geometry::RigidTransform& table_from_prop, const Typesetter& typesetter) {
    Canvas canvas(table);
    const Projection pixel(scene);
    const glm::dvec3 lens = table_from_prop.inverse().point(scene.table_from_projector.translation);
    for (const bool lit : {false, true}) { // lit faces over the others
        for (std::size_t k = 0; k < scene.prop.faces.size(); ++k) {
            const geometry::PropFace& face = scene.prop.faces[k];
            if ((face.plane.distance(lens) > 0.0) != lit) {
                continue;
            }
            glm::dvec3 middle(0.0);
            const std::size_t corners = face.corners.size();
            for (std::size_t c = 0; c < corners; ++c) {
                middle += table_from_prop.point(face.corners[c]) / static_cast<double>(corners);
                draw_edge(canvas, pixel, table_from_prop.point(face.corners[c]),
                          table_from_prop.point(face.corners[face.corners.next(c)]), 3.0,
                          lit ? prop_colour : unlit_colour);
            }
            if (const auto at = pixel(middle)) {
                canvas.text(typesetter, std::to_string(k + 1), *at, 26.0, lit ? prop_colour : unlit_colour,
                            {0.5, 0.5}, true);
            }
        }
    }
    const glm::dvec3& p = table_from_prop.translation;
    const glm::dvec3 ahead = table_from_prop.direction({1.0, 0.0, 0.0});
    canvas.text(typesetter,
                fmt::format("prop  x {:+.1f} cm  y {:+.1f} cm  turned {:+.1f}\u00b0", p.x * 100.0,
                            p.y * 100.0, glm::degrees(std::atan2(ahead.y, ahead.x))),
                {30.0, 50.0}, 17.0, prop_colour);
    return canvas.take();
}

image::Image8 with_lines(const image::Image8& pattern, std::span<const std::string> lines,
                         const Typesetter& typesetter) {
    constexpr glm::ivec2 corner(30, 80);
    constexpr int margin_px = 6;
    std::vector<Paragraph> paragraphs;
    for (const std::string& line : lines) {
        paragraphs.push_back(
            {.text = line, .em_px = 17.0, .bold = false, .brightness = 1.0, .space_before_px = 4.0});
    }
    const image::Image<std::uint8_t> text = typesetter.set(paragraphs, pattern.width - 2.0 * corner.x);
    Canvas canvas(pattern);
    const glm::dvec2 low(corner - margin_px);
    canvas.fill(low, low + glm::dvec2(text.width + 2 * margin_px, text.height + 2 * margin_px), Colour(0),
                0.8);
    canvas.coverage(text, corner, white);
    return canvas.take();
}

} // namespace frustumscreen::typography
