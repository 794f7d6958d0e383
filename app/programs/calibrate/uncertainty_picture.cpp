#include "app/programs/calibrate/uncertainty_picture.h"

#include "app/geometry/table_plane.h"
#include "app/typography/canvas.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::programs {

namespace {

constexpr typography::Colour paper{255, 255, 255};
constexpr typography::Colour ink{34, 40, 49};
constexpr typography::Colour grey{110, 118, 129};
constexpr glm::ivec2 size_px{1600, 900};
constexpr double margin_px = 70.0;
constexpr glm::dvec2 field_px{700.0, 500.0};
constexpr double field_top_px = 190.0;
constexpr double between_px = size_px.x - 2.0 * margin_px - 2.0 * field_px.x;
constexpr int bands = 8;

/// From light to dark, in perceptually even steps, also readable in grey (ColorBrewer's YlGnBu, 2013).
constexpr std::array<typography::Colour, bands> band_colours{{{255, 255, 217},
                                                              {237, 248, 177},
                                                              {199, 233, 180},
                                                              {127, 205, 187},
                                                              {65, 182, 196},
                                                              {29, 145, 192},
                                                              {34, 94, 168},
                                                              {12, 44, 132}}};

/// A band's width in millimetres: a round number, so that the legend's numbers are round too.
double band_mm(double largest_mm) {
    for (const double width : {0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0}) {
        if (largest_mm <= bands * width) {
            return width;
        }
    }
    return largest_mm / bands;
}

/// One height of the zone: a grid over the projector's picture.
class Level {
public:
    Level(const UncertaintyMap& map, double height_m)
        : pinhole_(map.pinhole), height_m_(height_m), projector_(map.table_from_projector.inverse()) {
        for (const calibration::PlaceUncertainty& place : map.zone) {
            if (std::abs(place.height_m - height_m) < 1e-9) {
                values_.push_back(place.rms_m);
            }
        }
    }

    /// The uncertainty at a place, metres; nothing outside the picture.
    [[nodiscard]] std::optional<double> at(const glm::dvec2& place) const {
        const auto pixel = pinhole_.pixel(projector_.point({place, height_m_}));
        const glm::dvec2 size(pinhole_.width, pinhole_.height);
        if (!pixel || values_.size() != calibration::zone_columns * calibration::zone_rows ||
            glm::any(glm::lessThan(*pixel, glm::dvec2(0.0))) || glm::any(glm::greaterThan(*pixel, size))) {
            return std::nullopt;
        }
        const glm::dvec2 cells =
            *pixel / size * glm::dvec2(calibration::zone_columns - 1, calibration::zone_rows - 1);
        const std::size_t column =
            std::min<std::size_t>(static_cast<std::size_t>(cells.x), calibration::zone_columns - 2);
        const std::size_t row =
            std::min<std::size_t>(static_cast<std::size_t>(cells.y), calibration::zone_rows - 2);
        const glm::dvec2 share = cells - glm::dvec2(column, row);
        const double* const low = &values_[row * calibration::zone_columns + column];
        return glm::mix(glm::mix(low[0], low[1], share.x),
                        glm::mix(low[calibration::zone_columns], low[calibration::zone_columns + 1], share.x),
                        share.y);
    }
    [[nodiscard]] double height_m() const { return height_m_; }

private:
    const geometry::Pinhole& pinhole_;
    double height_m_;
    geometry::RigidTransform projector_;
    std::vector<double> values_;
};

/// The place that a pixel lights at a height above the table. All pixels of a calibrated projector reach it.
glm::dvec2 light_of(const UncertaintyMap& map, const glm::dvec2& pixel, double height_m) {
    geometry::RigidTransform pose = map.table_from_projector;
    pose.translation.z -= height_m;
    return geometry::lights_table(map.pinhole, pose, pixel).value_or(glm::dvec2(pose.translation));
}

struct Field {
    glm::dvec2 low_px{0.0};
    glm::dvec2 middle_m{0.0};
    double px_per_m = 1.0;
    [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& place) const {
        const glm::dvec2 off = (place - middle_m) * px_per_m;
        return low_px + 0.5 * field_px + glm::dvec2(off.x, -off.y);
    }
    [[nodiscard]] glm::dvec2 place(const glm::dvec2& pixel) const {
        const glm::dvec2 off = (pixel - low_px - 0.5 * field_px) / px_per_m;
        return middle_m + glm::dvec2(off.x, -off.y);
    }
};

/// The field with the picture's corners on the table at the largest scale that fits.
Field fitted(const UncertaintyMap& map) {
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const glm::dvec2& corner :
         {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        const glm::dvec2 at = light_of(map, corner * glm::dvec2(map.pinhole.width, map.pinhole.height), 0.0);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    Field field;
    field.middle_m = 0.5 * (low + high);
    field.px_per_m = 0.96 * std::min(field_px.x / (high.x - low.x), field_px.y / (high.y - low.y));
    return field;
}

image::Image8 coloured(std::span<const Level> levels, std::span<const Field> fields, double band_m) {
    image::Image8 image(size_px.x, size_px.y, glm::u8vec4(paper, 255));
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const glm::ivec2 low(fields[k].low_px);
        for (int y = low.y; y < low.y + static_cast<int>(field_px.y); ++y) {
            for (int x = low.x; x < low.x + static_cast<int>(field_px.x); ++x) {
                if (const auto rms = levels[k].at(fields[k].place({x + 0.5, y + 0.5}))) {
                    const int band = std::min(static_cast<int>(*rms / band_m), bands - 1);
                    image.at(x, y) = glm::u8vec4(band_colours[static_cast<std::size_t>(band)], 255);
                }
            }
        }
    }
    return image;
}

void draw_cross(typography::Canvas& canvas, const typography::Typesetter& typesetter, const glm::dvec2& at,
                int number) {
    constexpr double arm = 9.0;
    for (const auto& [width, colour] : {std::pair(6.0, paper), std::pair(2.5, ink)}) {
        canvas.line(at - glm::dvec2(arm, 0.0), at + glm::dvec2(arm, 0.0), width, colour);
        canvas.line(at - glm::dvec2(0.0, arm), at + glm::dvec2(0.0, arm), width, colour);
    }
    const std::string word = fmt::format("{}", number);
    const double wide = 9.0 * static_cast<double>(word.size()) + 6.0;
    canvas.fill(at + glm::dvec2(11.0, 3.0), at + glm::dvec2(11.0 + wide, 23.0), paper, 0.85);
    canvas.text(typesetter, word, at + glm::dvec2(14.0, 4.0), 15.0, ink);
}

/// Draws the picture's edge, as straight lines between its corners and the middles of its sides.
void draw_edge(typography::Canvas& canvas, const UncertaintyMap& map, const Field& field, double height_m) {
    std::vector<glm::dvec2> edge;
    for (const glm::dvec2& share :
         {glm::dvec2(0.0, 0.0), glm::dvec2(0.5, 0.0), glm::dvec2(1.0, 0.0), glm::dvec2(1.0, 0.5),
          glm::dvec2(1.0, 1.0), glm::dvec2(0.5, 1.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.0, 0.5)}) {
        const glm::dvec2 size(map.pinhole.width, map.pinhole.height);
        edge.push_back(field.pixel(light_of(map, share * size, height_m)));
    }
    canvas.outline(edge, 1.5, grey);
}

void draw_scale(typography::Canvas& canvas, const typography::Typesetter& typesetter, const Field& field) {
    constexpr double length_m = 0.2;
    const glm::dvec2 at = field.low_px + glm::dvec2(0.0, field_px.y + 22.0);
    const glm::dvec2 end = at + glm::dvec2(length_m * field.px_per_m, 0.0);
    canvas.line(at, end, 3.0, ink);
    for (const glm::dvec2& tick : {at, end}) {
        canvas.line(tick - glm::dvec2(0.0, 6.0), tick + glm::dvec2(0.0, 6.0), 3.0, ink);
    }
    canvas.text(typesetter, "200 mm", end + glm::dvec2(14.0, 0.0), 20.0, ink, {0.0, 0.5});
}

void draw_legend(typography::Canvas& canvas, const typography::Typesetter& typesetter, double width_mm,
                 const std::string& what) {
    constexpr double box_px = 90.0;
    const glm::dvec2 at(margin_px, 796.0);
    for (int k = 0; k < bands; ++k) {
        const glm::dvec2 low = at + glm::dvec2(box_px * k, 0.0);
        canvas.fill(low, low + glm::dvec2(box_px, 30.0), band_colours[static_cast<std::size_t>(k)]);
    }
    const std::array<glm::dvec2, 4> frame{at, at + glm::dvec2(bands * box_px, 0.0),
                                          at + glm::dvec2(bands * box_px, 30.0), at + glm::dvec2(0.0, 30.0)};
    canvas.outline(frame, 1.5, grey);
    for (int k = 0; k <= bands; ++k) {
        canvas.text(typesetter, fmt::format("{:.3g}", width_mm * k), at + glm::dvec2(box_px * k, 36.0), 19.0,
                    ink, {0.5, 0.0});
    }
    canvas.text(typesetter, "mm, one standard deviation", at + glm::dvec2(bands * box_px + 24.0, 15.0), 19.0,
                ink, {0.0, 0.5});
    const glm::dvec2 cross = at + glm::dvec2(bands * box_px + 340.0, 15.0);
    draw_cross(canvas, typesetter, cross, 1);
    canvas.text(typesetter, what + ", on the nearer height", cross + glm::dvec2(40.0, 0.0), 19.0, ink,
                {0.0, 0.5});
}

} // namespace

MeasuredPlaces places_of(std::span<const calibration::Touch> touches) {
    MeasuredPlaces measured{"a touched cross", {}};
    for (const calibration::Touch& touch : touches) {
        measured.places.push_back({touch.pixel, touch.block_m, static_cast<int>(measured.places.size()) + 1});
    }
    return measured;
}

MeasuredPlaces places_of(std::span<const calibration::Rest> rests) {
    MeasuredPlaces measured{"the points of a rest", {}};
    for (const calibration::Rest& rest : rests) {
        MeasuredPlace middle{{}, rest.block_m.value_or(0.0), rest.name};
        for (const calibration::PropPoint& point : rest.points) {
            middle.pixel += point.pixel / static_cast<double>(rest.points.size());
            middle.height_m += point.prop_m.z / static_cast<double>(rest.points.size());
        }
        measured.places.push_back(middle);
    }
    return measured;
}

MeasuredPlaces places_of(std::span<const calibration::MeasuredCorner> corners, int width, int height) {
    MeasuredPlaces measured{"a measured corner", {}};
    for (const calibration::MeasuredCorner& corner : corners) {
        measured.places.push_back({calibration::pixel_of(corner.corner, width, height), corner.place_m.z,
                                   static_cast<int>(measured.places.size()) + 1});
    }
    return measured;
}

std::optional<UncertaintyMap> map_of(const calibration::TouchCalibration& calibration) {
    if (!calibration.table) {
        return std::nullopt;
    }
    return UncertaintyMap{.verdict = calibration.verdict,
                          .pinhole = calibration.table->pinhole,
                          .table_from_projector = calibration.table->table_from_projector,
                          .uncertainty = calibration.uncertainty,
                          .zone = calibration.zone};
}

std::optional<UncertaintyMap> map_of(const calibration::TouchUp& touched_up) {
    if (!touched_up.table) {
        return std::nullopt;
    }
    return UncertaintyMap{.verdict = touched_up.verdict,
                          .pinhole = touched_up.table->pinhole,
                          .table_from_projector = touched_up.table->table_from_projector,
                          .uncertainty = touched_up.uncertainty,
                          .zone = touched_up.zone};
}

std::optional<UncertaintyMap> map_of(const calibration::CornerCalibration& calibration,
                                     const calibration::CornerUncertainty& uncertainty) {
    if (!calibration.pinhole) {
        return std::nullopt;
    }
    return UncertaintyMap{.verdict = calibration.verdict,
                          .pinhole = *calibration.pinhole,
                          .table_from_projector = calibration.table_from_projector,
                          .uncertainty = uncertainty.picture,
                          .zone = uncertainty.zone};
}

image::Image8 uncertainty_picture(const UncertaintyMap& map, const MeasuredPlaces& measured, double top_m,
                                  const typography::Typesetter& typesetter) {
    const std::array<Level, 2> levels{Level(map, 0.0), Level(map, top_m)};
    std::array<Field, 2> fields;
    fields.fill(fitted(map));
    fields[0].low_px = {margin_px, field_top_px};
    fields[1].low_px = {margin_px + field_px.x + between_px, field_top_px};
    const double width_mm = band_mm(1e3 * map.uncertainty.worst_m);
    typography::Canvas canvas(coloured(levels, fields, 1e-3 * width_mm));
    canvas.text(typesetter, "How far the light may be off", {margin_px, 36.0}, 38.0, ink, {}, true);
    canvas.text(typesetter,
                fmt::format("{}: {:.2f} mm on average over the zone, {:.2f} mm at the worst place",
                            calibration::name_of(map.verdict), 1e3 * map.uncertainty.mean_m,
                            1e3 * map.uncertainty.worst_m),
                {margin_px, 92.0}, 23.0, grey);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        canvas.text(typesetter,
                    k == 0 ? std::string("On the table, seen from above")
                           : fmt::format("{:.0f} mm above it, at the prop's top", 1e3 * top_m),
                    fields[k].low_px - glm::dvec2(0.0, 44.0), 23.0, ink, {}, true);
        draw_edge(canvas, map, fields[k], levels[k].height_m());
        draw_scale(canvas, typesetter, fields[k]);
    }
    for (const MeasuredPlace& place : measured.places) {
        const std::size_t level = place.height_m > 0.5 * top_m ? 1 : 0;
        const glm::dvec2 at = light_of(map, place.pixel, levels[level].height_m());
        draw_cross(canvas, typesetter, fields[level].pixel(at), place.number);
    }
    draw_legend(canvas, typesetter, width_mm, measured.what);
    return canvas.take();
}

Result<void> write_uncertainty(const std::filesystem::path& file, const std::optional<UncertaintyMap>& map,
                               const MeasuredPlaces& measured, double top_m) {
    if (!map) {
        return {}; // the calibration was refused, and the reason is printed
    }
    TRY(const typography::Typesetter typesetter, typography::Typesetter::open());
    return write_file(file, image::encode_png(uncertainty_picture(*map, measured, top_m, typesetter)));
}

} // namespace frustumscreen::programs
