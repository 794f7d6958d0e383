#include "app/drawing/board/board_sheet.h"

#include "app/drawing/a3_sheet.h"
#include "app/drawing/dimension.h"
#include "firmware_host/tags/tag_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace frustumscreen::drawing {

namespace {

constexpr Pen black{.stroke = "none", .width_mm = 0.0, .fill = "#000000"};
constexpr Pen cut{.stroke = "#c02020", .width_mm = 0.35, .fill = "none", .dashes = "3 1.5"};
constexpr double ruler_mm = 100.0;

std::array<glm::dvec2, 4> rectangle(const glm::dvec2& low, const glm::dvec2& high) {
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

/// Calls `use(from, to)` for each run of black columns.
void for_each_run(const auto& is_black, const auto& use) {
    for (std::size_t from = 0; from < tags::tag_modules; ++from) {
        std::size_t to = from;
        while (to < tags::tag_modules && is_black(to)) {
            ++to;
        }
        if (to > from) {
            use(from, to);
            from = to;
        }
    }
}

/// Draws row by row; a bridge overlaps adjacent black modules of two rows, so no white hairline remains.
void draw_tag(SvgSheet& sheet, const tags::PropTag& tag, const glm::dvec2& middle_mm) {
    constexpr double bridge = 0.1;
    const tags::TagModules modules = tags::tag_modules_of(tag.id);
    const double module_mm = 1e3 * tag.size_m / static_cast<double>(tags::black_modules);
    const glm::dvec2 corner = middle_mm - 0.5 * static_cast<double>(tags::tag_modules) * module_mm;
    const auto draw = [&](double top, double bottom) {
        return [&sheet, corner, module_mm, top, bottom](std::size_t from, std::size_t to) {
            sheet.polygon(rectangle(corner + module_mm * glm::dvec2(from, top),
                                    corner + module_mm * glm::dvec2(to, bottom)),
                          black);
        };
    };
    for (std::size_t row = 0; row < tags::tag_modules; ++row) {
        const auto at = static_cast<double>(row);
        for_each_run([&](std::size_t column) { return !modules[row][column]; }, draw(at, at + 1.0));
        if (row > 0) {
            for_each_run(
                [&](std::size_t column) { return !modules[row][column] && !modules[row - 1][column]; },
                draw(at - bridge, at + bridge));
        }
    }
}

/// The lines of the prop's bottom that are on the paper; lines beyond an edge are omitted.
void draw_outline(SvgSheet& sheet, const View& view, double base_m) {
    const glm::dvec2 low(view({-0.5 * base_m, 0.5 * base_m}));
    const glm::dvec2 high(view({0.5 * base_m, -0.5 * base_m}));
    const double top = std::fmax(0.0, low.y);
    const double bottom = std::fmin(a3_mm.y, high.y);
    for (const double x : {low.x, high.x}) {
        sheet.line({x, top}, {x, bottom}, outline);
    }
    for (const double y : {low.y, high.y}) {
        if (y > 0.0 && y < a3_mm.y) {
            sheet.line({low.x, y}, {high.x, y}, outline);
        }
    }
}

void draw_front(SvgSheet& sheet, const glm::dvec2& tip, double size_mm) {
    const glm::dvec2 head[] = {tip, tip + size_mm * glm::dvec2(-0.5, -0.8),
                               tip + size_mm * glm::dvec2(0.5, -0.8)};
    sheet.polygon(head, black);
    sheet.text(tip + glm::dvec2(0.9 * size_mm, -0.2 * size_mm), "front of the prop, towards the visitor",
               {0.6 * size_mm});
}

void draw_top_tag(SvgSheet& sheet, const calibration::Board& board, const glm::dvec2& middle,
                  double type_mm) {
    const double half = 0.5 * 1e3 * std::fmin(board.prop.top_m, 1.25 * board.top().size_m + 0.004);
    const glm::dvec2 low = middle - half;
    const glm::dvec2 high = middle + half;
    sheet.polygon(rectangle(low, high), cut, "top");
    draw_tag(sheet, board.top(), middle);
    sheet.text({middle.x, high.y + 1.6 * type_mm},
               "cut out; onto the middle of the prop's top, this edge to the front",
               {type_mm, TextAnchor::Middle});
}

} // namespace

std::string board_sheet(const calibration::Board& board, std::string_view name) {
    SvgSheet sheet(a3_mm);
    const View view{0.5 * a3_mm, 1000.0};
    sheet.begin_view("board", view.origin_mm, view.mm_per_m);
    draw_outline(sheet, view, board.prop.base_m);
    for (std::size_t k = 0; k + 1 < board.tags.size(); ++k) {
        draw_tag(sheet, board.tags[k], view(glm::dvec2(board.tags[k].prop_from_tag.translation)));
    }
    sheet.end_view();
    const double base_mm = 1e3 * board.prop.base_m;
    const double half_mm = 0.5 * std::fmin(base_mm, a3_mm.y);
    const double type_mm = std::clamp(base_mm / 60.0, 1.2, 3.5);
    const glm::dvec2 middle = view.origin_mm;
    const double cut_mm = 0.5e3 * std::fmin(board.prop.top_m, 1.25 * board.top().size_m + 0.004);
    // From back to front: title, the tag for the top, the ruler, the arrow.
    double y = middle.y - half_mm + 3.0 * type_mm;
    const glm::dvec2 left(middle.x - 0.5 * base_mm + 2.0 * type_mm, 0.0);
    sheet.text({left.x, y}, "Board of tags for frustumscreen-calibrate auto",
               {.height_mm = 1.2 * type_mm, .anchor = TextAnchor::Start, .turned_deg = 0.0, .bold = true});
    for (const std::string& line :
         {fmt::format("of the settings {}; the prop stands on the lines ({} x {}), held by tape", name,
                      mm_words(board.prop.base_m), mm_words(board.prop.base_m)),
          std::string("print on A3 at 100 %, matt; glue onto a stiff, flat board; nothing may cover a tag"),
          fmt::format("black squares: {} on the sheet, {} on the prop's top; all lengths in mm",
                      mm_words(board.tags.front().size_m), mm_words(board.top().size_m))}) {
        y += 1.6 * type_mm;
        sheet.text({left.x, y}, line, {type_mm});
    }
    draw_top_tag(sheet, board, {middle.x, std::fmax(middle.y, y + 1.5 * type_mm + cut_mm)}, type_mm);
    const double foot = middle.y + half_mm;
    const double ruler = std::fmin(ruler_mm, 10.0 * std::floor((base_mm - 8.0 * type_mm) / 10.0));
    const glm::dvec2 begin(middle.x - 0.5 * ruler, foot - 8.0 * type_mm);
    if (ruler > 0.0) {
        draw_dimension(sheet, begin, begin + glm::dvec2(ruler, 0.0), {0.0, -2.0},
                       fmt::format("{:.0f}: measure it after printing", ruler));
    }
    draw_front(sheet, {middle.x, foot - 1.5 * type_mm}, 2.2 * type_mm);
    return sheet.take();
}

} // namespace frustumscreen::drawing
