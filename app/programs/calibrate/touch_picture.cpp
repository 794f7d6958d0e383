#include "app/programs/calibrate/touch_picture.h"

#include "app/exhibit/canvas.h"
#include "app/programs/calibrate/table_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace frustumscreen {

namespace {

std::string_view words_of(TouchWord word) {
    switch (word) {
    case TouchWord::None:
        return "";
    case TouchWord::Moved:
        return "The prop moved. Keep it still; the second begins anew.";
    case TouchWord::NotSeen:
        return "The tracker does not see the prop. Look at its cable and its sensor, then press Next again.";
    case TouchWord::SamePlace:
        return "The prop still lies where it lay before. Lay it on this cross, then press Next.";
    case TouchWord::Taken:
        return "Good.";
    }
    return "";
}

std::string height_of(const Cross& cross) {
    return cross.block_m > 0.0 ? fmt::format("on top of {:.0f} mm of board", 1e3 * cross.block_m)
                               : std::string("on the table");
}

/// What the two buttons do then.
std::string words_of_choice(const TouchProcedure& procedure) {
    const TouchJudgement& judged = *procedure.judged();
    const bool is_touch_up = procedure.task() == TouchTask::TouchUp;
    switch (judged.verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        return judged.nothing_moved ? "Next returns to the exhibit. Back does one touch again."
                                    : "Next keeps it. Back does the touch again that lies farthest off.";
    case Verdict::Repeat:
        return procedure.asks_for_more() ? "Next brings two more crosses."
                                         : "Next does the doubtful touches again.";
    case Verdict::Refused:
        return is_touch_up ? "Next measures the whole table anew. Back does all touches again."
                           : "Next begins anew.";
    }
    return "";
}

std::vector<std::string> words_of_verdict(const TouchProcedure& procedure) {
    std::vector<std::string> words = procedure.judged()->told;
    words.push_back(words_of_choice(procedure));
    return words;
}

/// What a technician needs at hand: the heights that the crosses ask for, millimetres.
std::set<int> block_heights_mm(const TouchProcedure& procedure) {
    std::set<int> heights_mm;
    for (const Cross& cross : procedure.crosses()) {
        heights_mm.insert(static_cast<int>(std::lround(1e3 * cross.block_m)));
    }
    heights_mm.erase(0);
    return heights_mm;
}

std::vector<std::string> words_of_begin(const TouchProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return {"The table cannot be measured", as_sentence(procedure.problem()),
                "Back returns to the exhibit."};
    }
    const std::string boards = fmt::format("You need the prop and boards that make {} mm.",
                                           fmt::join(block_heights_mm(procedure), ", "));
    if (procedure.task() == TouchTask::TouchUp) {
        return {
            "Staff: put the picture right",
            fmt::format("Somebody bumped the projector, or moved the tracker? {} touches find out, and put "
                        "the picture right; that takes about two minutes. {}",
                        procedure.count(), boards),
            "Next begins. Back goes on to measuring the whole table anew, or out. A minute without a press "
            "returns to the exhibit."};
    }
    return {"Staff: measure the table anew",
            fmt::format("Projector, tracker and the prop's sensor are measured with {} touches; that takes "
                        "about five minutes. {}",
                        procedure.count(), boards),
            "Next begins. Back returns to the exhibit; so does a minute without a press."};
}

Colour colour_of(const TouchProcedure& procedure) {
    if (procedure.stage() == CalibrationStage::HoldStill) {
        return procedure.word() == TouchWord::Moved ? TableColours::bad : TableColours::good;
    }
    return TableColours::white;
}

/// Directions of the picture: u to the right, v down; a turn is counter-clockwise as one looks at the table.
glm::dvec2 turned(const glm::dvec2& direction, double yaw_rad) {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return {c * direction.x + s * direction.y, -s * direction.x + c * direction.y};
}

/// Its arms reach out from under the prop, along whose sides they lie; the thick one leads to its front. Where that one leaves the picture,
/// an arrow head on a side arm, beyond the prop, says the same: of two arms that are opposite each other at most one leaves it.
void draw_cross(Canvas& canvas, const TouchProcedure& procedure, double unit, double prop_px) {
    const Cross& cross = procedure.cross();
    const Colour colour = colour_of(procedure);
    const double arm = std::fmax(0.75 * prop_px, 16.0 * unit);
    const auto line = [&](const glm::dvec2& from, const glm::dvec2& to, double width, Colour of) {
        canvas.line(cross.pixel + turned(from, cross.yaw_rad), cross.pixel + turned(to, cross.yaw_rad), width,
                    of);
    };
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

std::string_view key_of_lay(const TouchProcedure& procedure) {
    switch (procedure.word()) {
    case TouchWord::NotSeen:
        return "calibration.not_seen";
    case TouchWord::SamePlace:
        return "calibration.same_place";
    case TouchWord::Taken: {
        const bool is_raised =
            procedure.at() > 0 && procedure.cross().block_m > procedure.crosses()[procedure.at() - 1].block_m;
        return is_raised ? "calibration.on_boards" : "calibration.taken";
    }
    default:
        return "calibration.lay";
    }
}

std::string_view key_of_verdict(const TouchProcedure& procedure) {
    const TouchJudgement& judged = *procedure.judged();
    const bool is_touch_up = procedure.task() == TouchTask::TouchUp;
    switch (judged.verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        return judged.nothing_moved ? "calibration.nothing_moved"
               : is_touch_up        ? "calibration.put_right"
                                    : "calibration.may_be_kept";
    case Verdict::Repeat:
        return procedure.asks_for_more() ? "calibration.more" : "calibration.repeat";
    case Verdict::Refused:
        return is_touch_up ? "calibration.does_not_fit" : "calibration.refused";
    }
    return "";
}

} // namespace

std::vector<std::string> touch_words(const TouchProcedure& procedure) {
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return words_of_begin(procedure);
    case CalibrationStage::Place:
    case CalibrationStage::HoldStill: {
        std::vector<std::string> words{fmt::format("Touch {} of {}", procedure.at() + 1, procedure.count())};
        words.push_back(
            procedure.stage() == CalibrationStage::HoldStill
                ? "Hold still: one second."
                : fmt::format(
                      "Lay the middle of the prop's bottom on the cross, {}, its front along the arrow. "
                      "Then press Next.",
                      height_of(procedure.cross())));
        if (const std::string_view more = words_of(procedure.word()); !more.empty()) {
            words.emplace_back(more);
        }
        return words;
    }
    case CalibrationStage::Solve:
        return {"One moment, please."};
    case CalibrationStage::Judged:
        return words_of_verdict(procedure);
    case CalibrationStage::Done:
        return procedure.judged()->nothing_moved
                   ? std::vector<std::string>{"Nothing was changed.", "The exhibit comes back."}
                   : std::vector<std::string>{"The calibration is kept.", "The exhibit comes back with it."};
    case CalibrationStage::GoesOn:
        return {"One moment, please."};
    default: // Left
        return {"Nothing was changed.", "The exhibit comes back."};
    }
    return {};
}

std::string_view word_key(const TouchProcedure& procedure) {
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return !procedure.problem().empty()             ? ""
               : procedure.task() == TouchTask::TouchUp ? "calibration.touch_up"
                                                        : "calibration.begin";
    case CalibrationStage::Place:
        return key_of_lay(procedure);
    case CalibrationStage::HoldStill:
        return procedure.word() == TouchWord::Moved ? "calibration.moved" : "calibration.hold_still";
    case CalibrationStage::Solve:
        return "calibration.all_taken";
    case CalibrationStage::Judged:
        return key_of_verdict(procedure);
    case CalibrationStage::Done:
        return procedure.judged()->nothing_moved ? "calibration.left" : "calibration.kept";
    case CalibrationStage::GoesOn:
        return "calibration.all_taken";
    default: // Left
        return "calibration.left";
    }
    return "";
}

Image8 touch_picture(const TouchProcedure& procedure, int width, int height, double prop_px,
                     const Typesetter& typesetter, const LanguageWords* house) {
    Canvas canvas(width, height, {0, 0, 0});
    const double unit = width / 160.0;
    const bool has_cross =
        procedure.stage() == CalibrationStage::Place || procedure.stage() == CalibrationStage::HoldStill;
    if (has_cross) {
        draw_cross(canvas, procedure, unit, prop_px);
    }
    // The words stand in the half of the picture where the cross is not, so that the prop hides none of them.
    const bool below = !has_cross || procedure.cross().pixel.y < 0.5 * height;
    const Image<std::uint8_t> coverage =
        above(house_sentence(house, word_key(procedure), 0.6 * width),
              typesetter.set(paragraphs_of(touch_words(procedure), unit), 0.6 * width), 2.5 * unit);
    const double top = below ? (has_cross ? 0.62 : 0.4) * height : 0.38 * height - coverage.height;
    canvas.coverage(coverage, {(width - coverage.width) / 2, static_cast<int>(std::max(top, unit))},
                    procedure.word() == TouchWord::Taken || procedure.word() == TouchWord::None
                        ? TableColours::white
                        : TableColours::front);
    const double row = below ? height - 3.0 * unit : 3.0 * unit; // on the same side
    draw_dots(canvas, {0.5 * width, row}, unit, static_cast<int>(procedure.count()),
              [&](int k) { return procedure.is_taken(static_cast<std::size_t>(k)); },
              {TableColours::good, TableColours::dim});
    return canvas.take();
}

} // namespace frustumscreen
