#include "app/programs/calibrate/table_pictures.h"
#include "app/typography/canvas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace frustumscreen::programs {

namespace {

using Stage = calibration::CalibrationStage;

constexpr std::array<WordMessage<calibration::TouchPrompt>, 4> touch_messages{{
    {calibration::TouchPrompt::Moved,
     {"calibration.moved", "The prop moved. Keep it still; the second starts again."}},
    {calibration::TouchPrompt::NotSeen,
     {"calibration.not_seen",
      "The tracker does not see the prop. Look at its cable and its sensor, then press Next again."}},
    {calibration::TouchPrompt::SamePlace,
     {"calibration.same_place",
      "The prop still lies where it lay before. Lay it on this cross, then press Next."}},
    {calibration::TouchPrompt::Taken, {"calibration.taken", "Good."}},
}};

std::string height_of(const calibration::Cross& cross) {
    return cross.block_m > 0.0 ? fmt::format("on top of {:.0f} mm of board", 1e3 * cross.block_m)
                               : std::string("on the table");
}

/// The board heights that the crosses need, millimetres.
std::set<int> block_heights_mm(const calibration::TouchProcedure& procedure) {
    std::set<int> heights_mm;
    for (const calibration::Cross& cross : procedure.crosses()) {
        heights_mm.insert(static_cast<int>(std::lround(1e3 * cross.block_m)));
    }
    heights_mm.erase(0);
    return heights_mm;
}

/// Half a minute per touch.
std::size_t minutes_for(std::size_t touches) {
    return (touches + 1) / 2;
}

TableWords words_of_begin(const calibration::TouchProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return why_not("The table cannot be measured", procedure.problem(), "Back returns to the exhibit.");
    }
    const std::string boards = fmt::format("You need the prop, with a mark in the middle of each of its "
                                           "bottom edges, and boards that make {} mm, "
                                           "a little wider than the prop.",
                                           fmt::join(block_heights_mm(procedure), ", "));
    if (procedure.task() == calibration::TouchTask::TouchUp) {
        return {"calibration.touch_up",
                {"Staff: put the picture right",
                 fmt::format("Has the projector or the tracker been moved? {} touches find out and correct "
                             "the picture; that takes about two minutes. {}",
                             procedure.count(), boards),
                 "Next begins. Back goes on to measuring the whole table; from there Back leaves. A minute "
                 "without a press returns to the exhibit."}};
    }
    return {"calibration.begin",
            {"Staff: measure the whole table",
             fmt::format("Projector, tracker and the prop's sensor are measured with {} touches; that takes "
                         "about {} minutes. {}",
                         procedure.count(), minutes_for(procedure.count()), boards),
             "Next begins. Back returns to the exhibit; so does a minute without a press."}};
}

TableWords words_of_cross(const calibration::TouchProcedure& procedure) {
    const calibration::Cross& cross = procedure.cross();
    TableWords words{"", {fmt::format("Touch {} of {}", procedure.at() + 1, procedure.count())}};
    if (procedure.stage() == Stage::HoldStill) {
        words.add("calibration.hold_still", "Hold still: one second.");
    } else {
        words.add(
            "calibration.lay",
            fmt::format("Lay the prop on the cross, {}: the marks of its bottom edges on the four arms, its "
                        "front along the arrow. Then press Next.",
                        height_of(cross)));
    }
    words.add(message_of(touch_messages, procedure.word()));
    if (procedure.word() == calibration::TouchPrompt::Taken && procedure.at() > 0 &&
        cross.block_m > procedure.crosses()[procedure.at() - 1].block_m) {
        words.key = "calibration.on_boards";
    }
    return words;
}

/// Tells what the two buttons do after the verdict.
Message choice_of(const calibration::TouchProcedure& procedure) {
    const calibration::TouchJudgement& judged = *procedure.judged();
    const bool is_touch_up = procedure.task() == calibration::TouchTask::TouchUp;
    switch (judged.verdict) {
    case calibration::Verdict::Good:
    case calibration::Verdict::Usable:
        return judged.nothing_moved
                   ? Message{"calibration.nothing_moved",
                             "Next returns to the exhibit. Back does one touch again."}
                   : Message{is_touch_up ? "calibration.put_right" : "calibration.may_be_kept",
                             "Next keeps it. Back does the touch again that lies farthest off."};
    case calibration::Verdict::Repeat:
        return procedure.asks_for_more()
                   ? Message{"calibration.more", "Next shows two more crosses."}
                   : Message{"calibration.repeat", "Next does the doubtful touches again."};
    case calibration::Verdict::Refused:
        break;
    }
    return is_touch_up ? Message{"calibration.does_not_fit",
                                 "Next measures the whole table. Back repeats all touches."}
                       : Message{"calibration.refused", "Next starts again."};
}

typography::Colour colour_of(const calibration::TouchProcedure& procedure) {
    if (procedure.stage() == Stage::HoldStill) {
        return procedure.word() == calibration::TouchPrompt::Moved ? TableColours::bad : TableColours::good;
    }
    return TableColours::white;
}

/// Rotates a direction of the picture (u to the right, v down), counter-clockwise as seen from above.
glm::dvec2 turned(const glm::dvec2& direction, double yaw_rad) {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return {c * direction.x + s * direction.y, -s * direction.x + c * direction.y};
}

/// Draws the cross. Its arms extend beyond the prop, perpendicular to its sides; the thick one leads to its
/// front. A square shows where the prop stands. If the front's arm leaves the picture, an arrow head on a
/// side arm, beyond the prop, points to the front: of two opposite arms at most one leaves the picture.
void draw_cross(typography::Canvas& canvas, const calibration::TouchProcedure& procedure, double unit,
                double prop_px) {
    const calibration::Cross& cross = procedure.cross();
    const typography::Colour colour = colour_of(procedure);
    const double arm = std::fmax(0.75 * prop_px, 16.0 * unit);
    const double edge = 0.5 * prop_px;
    const auto line = [&](const glm::dvec2& from, const glm::dvec2& to, double width, typography::Colour of) {
        canvas.line(cross.pixel + turned(from, cross.yaw_rad), cross.pixel + turned(to, cross.yaw_rad), width,
                    of);
    };
    for (const double side : {-1.0, 1.0}) {
        line({side * edge, -edge}, {side * edge, edge}, 1.0, TableColours::dim);
        line({-edge, side * edge}, {edge, side * edge}, 1.0, TableColours::dim);
    }
    line({-arm, 0.0}, {arm, 0.0}, 1.0, colour);
    line({0.0, -arm}, {0.0, arm}, 1.0, colour);
    line({0.0, 2.0 * unit}, {0.0, arm}, 3.0, TableColours::front);
    const auto arrow_head = [&](const glm::dvec2& tip) {
        line(tip, tip + glm::dvec2(-2.0, -2.5) * unit, 3.0, TableColours::front);
        line(tip, tip + glm::dvec2(2.0, -2.5) * unit, 3.0, TableColours::front);
    };
    arrow_head({0.0, arm});
    arrow_head({-0.85 * arm, 2.0 * unit});
    arrow_head({0.85 * arm, 2.0 * unit});
    canvas.circle(cross.pixel, 1.5 * unit, 1.0, colour);
}

/// The prop's width at the cross's height: boards are nearer to the projector.
double prop_px_at(const calibration::Cross& cross, const TableDrawing& with) {
    return with.above_m > cross.block_m ? with.prop_px * with.above_m / (with.above_m - cross.block_m)
                                        : with.prop_px;
}

/// Where the words stand, from left to right.
struct WordsColumn {
    double middle, width;
};

WordsColumn middle_column(double width) {
    return {0.5 * width, 0.6 * width};
}

/// The wider of the columns beside the prop's square; the middle of the picture where both are too narrow.
WordsColumn column_beside(const calibration::Cross& cross, const TableDrawing& with, double unit) {
    constexpr double min_share = 0.2; // of the picture's width
    const double reach = 0.5 * prop_px_at(cross, with) + 3.0 * unit;
    const double left_width = cross.pixel.x - reach - 3.0 * unit;
    const double right_width = with.width - 3.0 * unit - (cross.pixel.x + reach);
    const double width = std::min(std::max(left_width, right_width), 0.6 * with.width);
    if (width < min_share * with.width) {
        return middle_column(with.width);
    }
    const double middle =
        right_width >= left_width ? cross.pixel.x + reach + 0.5 * width : cross.pixel.x - reach - 0.5 * width;
    return {middle, width};
}

std::string what_moved(calibration::Moved moved) {
    switch (moved) {
    case calibration::Moved::Projector:
        return "The projector moved.";
    case calibration::Moved::Tracker:
        return "The tracker's source moved.";
    case calibration::Moved::Either:
        return "The projector moved, or the tracker's source.";
    default:
        return "Nothing has moved.";
    }
}

std::string right_again(const calibration::TouchUp& found) {
    const std::string was = fmt::format("The picture was {:.0f} mm off.", 1e3 * found.off_m);
    return found.verdict == calibration::Verdict::Repeat
               ? was + " These touches are too few to check each other."
               : fmt::format("{} Once this is kept it is right again, to about {:.1f} mm.", was,
                             1e3 * found.uncertainty.mean_m);
}

} // namespace

TableWords table_words(const calibration::TouchProcedure& procedure) {
    switch (procedure.stage()) {
    case Stage::Begin:
        return words_of_begin(procedure);
    case Stage::Place:
    case Stage::HoldStill:
        return words_of_cross(procedure);
    case Stage::Judged: {
        TableWords words{"", procedure.judged()->told};
        words.add(choice_of(procedure));
        return words;
    }
    case Stage::Done:
        return procedure.judged()->nothing_moved ? all_unchanged() : all_kept();
    case Stage::Left:
        return all_unchanged();
    default:
        return one_moment();
    }
}

calibration::TouchJudgement judgement_of(const calibration::TouchCalibration& calibration) {
    calibration::TouchJudgement judged{
        .verdict = calibration.verdict,
        .told = {fmt::format("The calibration is: {}", calibration::name_of(calibration.verdict)),
                 as_sentence(calibration.reason.sentence)},
        .repeat = calibration.repeat,
        .residuals = calibration.residuals};
    if (calibration.table) {
        judged.told.push_back(
            fmt::format("Each touch lies {:.1f} mm from where the others expect it, {:.1f} mm at worst.",
                        1e3 * calibration.mean_residual_m, 1e3 * calibration.worst_residual_m));
    }
    return judged;
}

calibration::TouchJudgement judgement_of(const calibration::TouchUp& found) {
    calibration::TouchJudgement judged{
        .verdict = found.verdict, .told = {}, .repeat = {}, .residuals = found.residuals};
    if (!found.table) {
        judged.told = {"The touches do not fit what was measured before.",
                       as_sentence(found.reason.sentence)};
        return judged;
    }
    judged.nothing_moved = found.moved == calibration::Moved::Nothing;
    judged.told = {what_moved(found.moved),
                   judged.nothing_moved ? as_sentence(found.reason.sentence) : right_again(found)};
    return judged;
}

image::Image8 table_picture(const calibration::TouchProcedure& procedure, const TableDrawing& with) {
    const auto [width, height] = std::pair(with.width, with.height);
    typography::Canvas canvas(width, height, {0, 0, 0});
    const double unit = width / 160.0;
    const bool has_cross = procedure.stage() == Stage::Place || procedure.stage() == Stage::HoldStill;
    if (has_cross) {
        draw_cross(canvas, procedure, unit, prop_px_at(procedure.cross(), with));
    }
    // The words are in the half of the picture without the cross, beside the prop's square: the prop hides none of them, and no arm
    // runs through them.
    const bool below = !has_cross || procedure.cross().pixel.y < 0.5 * height;
    const WordsColumn column =
        has_cross ? column_beside(procedure.cross(), with, unit) : middle_column(width);
    const TableWords words = table_words(procedure);
    const image::Image<std::uint8_t> coverage =
        above(sentence_above(with.own_words, words.key, column.width),
              with.typesetter.set(paragraphs_of(words.lines, unit), column.width), 2.5 * unit);
    const double top = below ? (has_cross ? 0.62 : 0.4) * height : 0.38 * height - coverage.height;
    const double left = column.middle - 0.5 * coverage.width;
    canvas.coverage(coverage, {static_cast<int>(left), static_cast<int>(std::max(top, unit))},
                    procedure.word() == calibration::TouchPrompt::Taken ||
                            procedure.word() == calibration::TouchPrompt::None
                        ? TableColours::white
                        : TableColours::front);
    const double row = below ? height - 3.0 * unit : 3.0 * unit; // on the words' side
    draw_dots(canvas, {0.5 * width, row}, unit, static_cast<int>(procedure.count()),
              [&](int k) { return procedure.is_taken(static_cast<std::size_t>(k)); },
              {TableColours::good, TableColours::dim});
    return canvas.take();
}

} // namespace frustumscreen::programs
