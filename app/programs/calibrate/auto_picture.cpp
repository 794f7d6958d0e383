#include "app/programs/calibrate/auto_picture.h"

#include "app/programs/calibrate/table_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr Colour ground{150, 150, 150};
constexpr Colour ink{0, 0, 0};
constexpr Colour place_colour{255, 255, 255};
constexpr Colour taken_colour{0, 70, 0};

std::string words_of(const AutoProcedure& procedure) {
    switch (procedure.word()) {
    case AutoWord::None:
        return "";
    case AutoWord::NoLight:
        return "The camera does not see the projector's light. Turn it to the table, then press Next.";
    case AutoWord::CameraFault:
        return as_sentence(std::string(sentence_of(procedure.camera())));
    case AutoWord::NoFrames:
        return "The camera has stopped sending. Look at its cable; the stripes come again by themselves.";
    case AutoWord::NotSeen:
        return "The tracker does not see the prop. Look at its cable and its sensor.";
    case AutoWord::FewTags:
        return fmt::format("The camera sees {} of {} tags whole in the light: {} are needed. Nothing may lie "
                           "on them or stand "
                           "before them; put the board more into the middle.",
                           procedure.tags(), procedure.board().tags.size(), AutoProcedure::least_tags);
    case AutoWord::TurnIt:
        return "Turn it too: the first three rests must look in different directions.";
    case AutoWord::NotFlat:
        return "The first three rests were not all flat. Press Back three times, and lay the board flat each "
               "time.";
    case AutoWord::LeansLittle:
        return "It lies neither flat nor on the wedge. Lay it flat, or lean it by 15 to 30 degrees.";
    case AutoWord::WrongHeight:
        return fmt::format("It lies neither on the table nor on {:.0f} mm of board.",
                           1e3 * procedure.plan().block_m);
    case AutoWord::Moved:
        return "It moved, or the camera did. Leave both alone; the stripes come again by themselves.";
    case AutoWord::Disturbed:
        return "Something passed through the light. Step back; the stripes come again by themselves.";
    case AutoWord::TooBright:
        return "The tags are too bright for the camera. Shorten camera.exposure_ms in the settings, or close "
               "its lens a little.";
    case AutoWord::Taken:
        return fmt::format("Good: {} of {} tags.", procedure.tags(), procedure.board().tags.size());
    case AutoWord::Dropped:
        return "The last rest is dropped.";
    case AutoWord::TooFew:
        return fmt::format("{} rests are needed at least.", procedure.least());
    }
    return "";
}

std::string words_of(const AutoPlan& plan, const RestWish& wish) {
    switch (wish.posture) {
    case Posture::Flat:
        return "Lay the board flat on the table, the prop in the ring, turned by about a quarter from "
               "before. Take your hands away.";
    case Posture::Block:
        return fmt::format(
            "Lay the board flat on {:.0f} mm of board, the prop in the ring. Take your hands away.",
            1e3 * plan.block_m);
    case Posture::Leaning:
        return "Lean the board on the wedge by 15 to 30 degrees, the prop about in the ring. Take your hands "
               "away.";
    }
    return "";
}

std::vector<std::string> words_of_begin(const AutoProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return {"The table cannot be measured", as_sentence(procedure.problem()),
                "Back returns to the exhibit."};
    }
    if (procedure.word() == AutoWord::CameraFault) {
        return {"The camera cannot be used now", as_sentence(std::string(sentence_of(procedure.camera()))),
                procedure.plan().crosses_follow
                    ? "Put that right, or press Back to measure the table with crosses."
                    : "Put that right. Back returns to the exhibit."};
    }
    return {"Staff: measure the table with the camera",
            fmt::format("Projector, tracker and the prop's sensor are measured with {} rests of the board; "
                        "that takes about "
                        "eight minutes. You need the prop on its printed board ({:.0f} mm thick), and a "
                        "wedge to lean it on.",
                        procedure.wanted(), 1e3 * procedure.plan().board_m),
            procedure.plan().crosses_follow
                ? "Next begins. Back goes on to measuring it with crosses. A minute without a press returns "
                  "to the exhibit."
                : "Next begins. Back returns to the exhibit; so does a minute without a press."};
}

std::vector<std::string> words_of_delay(const AutoProcedure& procedure) {
    std::vector<std::string> words{"The camera looks at the light",
                                   "Light and dark follow each other. Back returns."};
    if (procedure.word() != AutoWord::None && procedure.plan().crosses_follow) {
        words.back() = "Light and dark follow each other. Back goes on to the crosses.";
    }
    return words;
}

std::vector<std::string> words_of_verdict(const AutoProcedure& procedure) {
    const TouchCalibration& found = procedure.judged()->found;
    std::vector<std::string> words{fmt::format("The calibration is: {}", name_of(found.verdict)),
                                   as_sentence(found.reason)};
    if (found.table) {
        words.push_back(fmt::format(
            "The points of a rest lie {:.1f} mm from where the others expect them, {:.1f} mm at worst.",
            1e3 * found.mean_residual_m, 1e3 * found.worst_residual_m));
    }
    switch (found.verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        words.emplace_back("Next keeps it. Back goes on with four more rests.");
        break;
    case Verdict::Repeat:
        words.emplace_back(
            found.repeat.empty()
                ? "Next goes on with four more rests."
                : "Next takes as many anew in their place. Back goes on with four more rests.");
        break;
    case Verdict::Refused:
        words.emplace_back("Next begins anew. Back goes on with four more rests.");
        break;
    }
    return words;
}

std::string_view key_of(Posture wished) {
    switch (wished) {
    case Posture::Flat:
        return "calibration.lay_flat";
    case Posture::Block:
        return "calibration.lay_on_boards";
    case Posture::Leaning:
        return "calibration.lean";
    }
    return "";
}

std::string_view key_of_word(const AutoProcedure& procedure) {
    const bool may_go_on = procedure.plan().crosses_follow && procedure.stage() != CalibrationStage::Place;
    return word_key(procedure.word(), procedure.wish().posture, may_go_on);
}

std::string_view key_of_begin(const AutoProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return "";
    }
    if (procedure.word() != AutoWord::None) {
        return key_of_word(procedure);
    }
    return procedure.plan().crosses_follow ? "calibration.by_camera" : "calibration.begin";
}

std::string_view key_of_verdict(const TouchCalibration& found) {
    switch (found.verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        return "calibration.may_be_kept";
    case Verdict::Repeat:
        return found.repeat.empty() ? "calibration.more_rests" : "calibration.repeat";
    case Verdict::Refused:
        return "calibration.refused";
    }
    return "";
}

} // namespace

std::vector<std::string> auto_words(const AutoProcedure& procedure) {
    std::vector<std::string> words;
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return words_of_begin(procedure);
    case CalibrationStage::Delay:
        words = words_of_delay(procedure);
        break;
    case CalibrationStage::Place:
        words = {fmt::format("Rest {} of {}", procedure.taken() + 1, procedure.wanted()),
                 words_of(procedure.plan(), procedure.wish())};
        break;
    case CalibrationStage::Capture:
        return {fmt::format("Rest {} of {}", procedure.taken() + 1, procedure.wanted()), "Stripes."};
    case CalibrationStage::Solve:
    case CalibrationStage::GoesOn:
        return {"One moment, please."};
    case CalibrationStage::Judged:
        return words_of_verdict(procedure);
    case CalibrationStage::Done:
        return {"The calibration is kept.", "The exhibit comes back with it."};
    default: // Left
        return {"Nothing was changed.", "The exhibit comes back."};
    }
    if (std::string more = words_of(procedure); !more.empty()) {
        words.push_back(std::move(more));
    }
    // It goes on all the same.
    if (procedure.camera() == CameraState::Slow || procedure.camera() == CameraState::Unlocked) {
        words.push_back(as_sentence(std::string(sentence_of(procedure.camera()))));
    }
    return words;
}

std::string_view word_key(const AutoProcedure& procedure) {
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return key_of_begin(procedure);
    case CalibrationStage::Delay:
        return procedure.word() == AutoWord::None ? "calibration.look_at_light" : key_of_word(procedure);
    case CalibrationStage::Place:
        return key_of_word(procedure);
    case CalibrationStage::Capture:
        return "";
    case CalibrationStage::Solve:
    case CalibrationStage::GoesOn:
        return "calibration.all_taken";
    case CalibrationStage::Judged:
        return key_of_verdict(procedure.judged()->found);
    case CalibrationStage::Done:
        return "calibration.kept";
    default: // Left
        return "calibration.left";
    }
    return "";
}

std::string_view word_key(AutoWord word, Posture wished, bool may_go_on) {
    switch (word) {
    case AutoWord::None:
    case AutoWord::Taken:
        return key_of(wished);
    case AutoWord::NoLight:
        return "calibration.no_light";
    case AutoWord::CameraFault:
    case AutoWord::NoFrames:
        return may_go_on ? "calibration.no_camera" : "calibration.camera_fault";
    case AutoWord::NotSeen:
        return "calibration.not_seen";
    case AutoWord::FewTags:
        return "calibration.few_tags";
    case AutoWord::TurnIt:
        return "calibration.turn_it";
    case AutoWord::NotFlat:
        return "calibration.not_flat";
    case AutoWord::LeansLittle:
        return "calibration.leans_little";
    case AutoWord::WrongHeight:
        return "calibration.wrong_height";
    case AutoWord::Moved:
        return "calibration.board_moved";
    case AutoWord::Disturbed:
        return "calibration.disturbed";
    case AutoWord::TooBright:
        return "calibration.too_bright";
    case AutoWord::Dropped:
        return "calibration.dropped";
    case AutoWord::TooFew:
        return "calibration.too_few";
    }
    return "";
}

Image8 auto_picture(const AutoProcedure& procedure, int width, int height, double board_px,
                    const Typesetter& typesetter, const LanguageWords* house) {
    Canvas canvas(width, height, ground);
    const double unit = width / 160.0;
    const bool has_place = procedure.stage() == CalibrationStage::Place;
    const glm::dvec2 place = procedure.wish().pixel;
    if (has_place) {
        constexpr double about_the_prop = 0.27; // of the board, in whose middle it stands
        canvas.circle(place, about_the_prop * board_px, 4.0, place_colour);
        canvas.circle(place, unit, 3.0, place_colour);
    }
    // The words stand in the half of the picture where the board is not.
    const bool below = !has_place || place.y < 0.45 * height;
    const Image<std::uint8_t> coverage =
        above(house_sentence(house, word_key(procedure), 0.7 * width),
              typesetter.set(paragraphs_of(auto_words(procedure), unit), 0.7 * width), 2.0 * unit);
    const double room = height - 5.0 * unit - coverage.height;
    const double top = !has_place ? 0.4 * height : below ? std::fmin(room, 0.68 * height) : 5.0 * unit;
    const glm::ivec2 corner{(width - coverage.width) / 2, static_cast<int>(std::fmax(top, unit))};
    const glm::dvec2 end = glm::dvec2(corner) + glm::dvec2(coverage.width, coverage.height);
    canvas.fill(glm::dvec2(corner) - 0.5 * unit, end + 0.5 * unit, ground); // the ring leads behind the words
    canvas.coverage(coverage, corner, ink);
    draw_dots(canvas, {0.5 * width, below ? height - 3.0 * unit : 3.0 * unit}, unit,
              static_cast<int>(procedure.wanted()),
              [&](int k) { return k < static_cast<int>(procedure.taken()); }, {taken_colour, ink});
    return canvas.take();
}

} // namespace frustumscreen
