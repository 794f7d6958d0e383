#include "app/programs/calibrate/table_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::programs {

namespace {

using Stage = calibration::CalibrationStage;

constexpr typography::Colour ground{150, 150, 150};
constexpr typography::Colour ink{0, 0, 0};
constexpr typography::Colour place_colour{255, 255, 255};
constexpr typography::Colour taken_colour{0, 70, 0};

/// `filled` replaces the names in braces. The words None and Taken have no key here: the next posture's key is used.
constexpr std::array<WordMessage<calibration::AutoPrompt>, 15> auto_messages{{
    {calibration::AutoPrompt::NoLight,
     {"calibration.no_light",
      "The camera does not see the projector's light. Turn it to the table, then press Next."}},
    {calibration::AutoPrompt::CameraFault, {"calibration.camera_fault", "{camera}"}},
    {calibration::AutoPrompt::NoFrames,
     {"calibration.camera_fault",
      "The camera has stopped sending. Look at its cable; the stripes come again by themselves."}},
    {calibration::AutoPrompt::NotSeen,
     {"calibration.not_seen", "The tracker does not see the prop. Look at its cable and its sensor."}},
    {calibration::AutoPrompt::FewTags,
     {"calibration.few_tags",
      "The camera sees {tags} of {all_tags} tags whole in the light: {least_tags} are needed. Clear "
      "everything off the tags; move the board closer to the middle."}},
    {calibration::AutoPrompt::TurnIt,
     {"calibration.turn_it", "Turn it too: the first three rests must look in different directions."}},
    {calibration::AutoPrompt::NotFlat,
     {"calibration.not_flat",
      "The first three rests were not all flat. Press Back three times, and lay the board flat each time."}},
    {calibration::AutoPrompt::LeansLittle,
     {"calibration.leans_little",
      "It lies neither flat nor on the wedge. Lay it flat, or lean it by 15 to 30 degrees."}},
    {calibration::AutoPrompt::WrongHeight,
     {"calibration.wrong_height",
      "It lies neither on the table nor on {block_mm:.0f} mm of board. Lay it on one of them."}},
    {calibration::AutoPrompt::Moved,
     {"calibration.board_moved",
      "It moved, or the camera did. Leave both alone; the stripes come again by themselves."}},
    {calibration::AutoPrompt::Disturbed,
     {"calibration.disturbed",
      "Something passed through the light. Step back; the stripes come again by themselves."}},
    {calibration::AutoPrompt::TooBright,
     {"calibration.too_bright", "The tags are too bright for the camera. Shorten camera.exposure_ms in the "
                                "settings, or close its lens a little."}},
    {calibration::AutoPrompt::Taken, {"", "Good: {tags} of {all_tags} tags."}},
    {calibration::AutoPrompt::Dropped, {"calibration.dropped", "The last rest is dropped."}},
    {calibration::AutoPrompt::TooFew, {"calibration.too_few", "At least {least_rests} rests are needed."}},
}};
constexpr std::array<WordMessage<calibration::Posture>, 3> posture_messages{{
    {calibration::Posture::Flat,
     {"calibration.lay_flat", "Lay the board flat on the table, the prop in the ring, turned by about a "
                              "quarter from before. Take your hands away."}},
    {calibration::Posture::Block,
     {"calibration.lay_on_boards",
      "Lay the board flat on {block_mm:.0f} mm of board, the prop in the ring. Take your hands away."}},
    {calibration::Posture::Leaning,
     {"calibration.lean", "Lean the board on the wedge by 15 to 30 degrees, the prop roughly in the ring. "
                          "Take your hands away."}},
}};

std::string filled(std::string_view english, const calibration::AutoProcedure& procedure) {
    using fmt::arg;
    return fmt::format(
        fmt::runtime(english), arg("camera", as_sentence(camera::sentence_of(procedure.camera()))),
        arg("tags", procedure.tags()), arg("all_tags", procedure.board().tags.size()),
        arg("least_tags", calibration::AutoProcedure::min_tags), arg("least_rests", procedure.least()),
        arg("block_mm", 1e3 * procedure.plan().block_m));
}

TableWords words_of_begin(const calibration::AutoProcedure& procedure) {
    const bool may_go_on = procedure.plan().crosses_follow;
    if (!procedure.problem().empty()) {
        return why_not("The table cannot be measured", procedure.problem(), "Back returns to the exhibit.");
    }
    if (procedure.word() == calibration::AutoPrompt::CameraFault) {
        return {key_of(procedure.word(), {}, may_go_on),
                {"The camera cannot be used now", as_sentence(camera::sentence_of(procedure.camera())),
                 may_go_on ? "Put that right, or press Back to measure the table with crosses."
                           : "Put that right. Back returns to the exhibit."}};
    }
    return {may_go_on ? "calibration.by_camera" : "calibration.begin",
            {"Staff: measure the table with the camera",
             fmt::format("Projector, tracker and the prop's sensor are measured with {} rests of the board; "
                         "that takes about "
                         "eight minutes. You need the prop on its printed board ({:.0f} mm thick), and a "
                         "wedge to lean it on.",
                         procedure.wanted(), 1e3 * procedure.plan().board_m),
             may_go_on
                 ? "Next begins. Back goes on to measuring it with crosses. A minute without a press returns "
                   "to the exhibit."
                 : "Next begins. Back returns to the exhibit; so does a minute without a press."}};
}

/// Words before a pattern: the delay will be measured, or a rest taken.
TableWords words_of_point(const calibration::AutoProcedure& procedure) {
    const calibration::Posture requested = procedure.request().posture;
    const bool is_delay = procedure.stage() == Stage::Delay;
    const bool may_go_on = is_delay && procedure.plan().crosses_follow;
    TableWords words;
    if (is_delay) {
        words = {"calibration.look_at_light",
                 {"The camera looks at the light",
                  may_go_on && procedure.word() != calibration::AutoPrompt::None
                      ? "Light and dark follow each other. Back goes on to the crosses."
                      : "Light and dark follow each other. Back returns."}};
    } else {
        words = {"",
                 {fmt::format("Rest {} of {}", procedure.taken() + 1, procedure.wanted()),
                  filled(message_of(posture_messages, requested).english, procedure)}};
    }
    if (!is_delay || procedure.word() != calibration::AutoPrompt::None) {
        words.add(key_of(procedure.word(), requested, may_go_on),
                  filled(message_of(auto_messages, procedure.word()).english, procedure));
    }
    // The procedure goes on with these faults.
    if (procedure.camera() == camera::CameraState::Slow ||
        procedure.camera() == camera::CameraState::Unlocked) {
        words.add("", as_sentence(camera::sentence_of(procedure.camera())));
    }
    return words;
}

/// Tells what the two buttons do after the verdict.
Message choice_of(const calibration::TouchCalibration& found) {
    switch (found.verdict) {
    case calibration::Verdict::Good:
    case calibration::Verdict::Usable:
        return {"calibration.may_be_kept", "Next keeps it. Back goes on with four more rests."};
    case calibration::Verdict::Repeat:
        return found.repeat.empty()
                   ? Message{"calibration.more_rests", "Next goes on with four more rests."}
                   : Message{"calibration.repeat",
                             "Next replaces the doubtful rests. Back goes on with four more rests."};
    case calibration::Verdict::Refused:
        break;
    }
    return {"calibration.refused", "Next starts again. Back goes on with four more rests."};
}

TableWords words_of_verdict(const calibration::TouchCalibration& found) {
    TableWords words{"",
                     {fmt::format("The calibration is: {}", calibration::name_of(found.verdict)),
                      as_sentence(found.reason.sentence)}};
    if (found.table) {
        words.add(
            "",
            fmt::format(
                "The points of a rest lie {:.1f} mm from where the others expect them, {:.1f} mm at worst.",
                1e3 * found.mean_residual_m, 1e3 * found.worst_residual_m));
    }
    words.add(choice_of(found));
    return words;
}

TableWords words_of_stage(const calibration::AutoProcedure& procedure) {
    switch (procedure.stage()) {
    case Stage::Begin:
        return words_of_begin(procedure);
    case Stage::Delay:
    case Stage::Place:
        return words_of_point(procedure);
    case Stage::Judged:
        return words_of_verdict(procedure.judged()->found);
    case Stage::Done:
        return all_kept();
    case Stage::Left:
        return all_unchanged();
    default:
        return one_moment();
    }
}

image::Image8 grey_picture(const calibration::StripeSetup& stripes, const calibration::Pattern& pattern) {
    const std::vector<std::uint8_t> codes = calibration::pattern_picture(stripes, pattern);
    image::Image8 picture(stripes.width, stripes.height);
    std::transform(codes.begin(), codes.end(), picture.texels.begin(),
                   [](std::uint8_t code) { return glm::u8vec4(code, code, code, 255); });
    return picture;
}

} // namespace

TableWords table_words(const calibration::AutoProcedure& procedure) {
    TableWords words = procedure.shown() ? TableWords() : words_of_stage(procedure);
    words.of = procedure.number();
    return words;
}

std::string_view key_of(calibration::AutoPrompt word, calibration::Posture requested, bool may_go_on) {
    if (may_go_on &&
        (word == calibration::AutoPrompt::CameraFault || word == calibration::AutoPrompt::NoFrames)) {
        return "calibration.no_camera";
    }
    const std::string_view key = message_of(auto_messages, word).key;
    return key.empty() ? message_of(posture_messages, requested).key : key;
}

image::Image8 table_picture(const calibration::AutoProcedure& procedure, const TableDrawing& with) {
    if (procedure.shown()) {
        return grey_picture(procedure.plan().stripes, *procedure.shown());
    }
    const auto [width, height] = std::pair(with.width, with.height);
    typography::Canvas canvas(width, height, ground);
    const double unit = width / 160.0;
    const bool has_place = procedure.stage() == Stage::Place;
    const glm::dvec2 place = procedure.request().pixel;
    if (has_place) {
        constexpr double about_the_prop = 0.27; // of the board's width; the prop stands in its middle
        canvas.circle(place, about_the_prop * with.board_px, 4.0, place_colour);
        canvas.circle(place, unit, 3.0, place_colour);
    }
    // The words are in the half of the picture without the board.
    const bool below = !has_place || place.y < 0.45 * height;
    const TableWords words = table_words(procedure);
    const image::Image<std::uint8_t> coverage =
        above(sentence_above(with.own_words, words.key, 0.7 * width),
              with.typesetter.set(paragraphs_of(words.lines, unit), 0.7 * width), 2.0 * unit);
    const double lowest = height - 5.0 * unit - coverage.height;
    const double top = !has_place ? 0.4 * height : below ? std::fmin(lowest, 0.68 * height) : 5.0 * unit;
    const glm::ivec2 corner{(width - coverage.width) / 2, static_cast<int>(std::fmax(top, unit))};
    const glm::dvec2 end = glm::dvec2(corner) + glm::dvec2(coverage.width, coverage.height);
    canvas.fill(glm::dvec2(corner) - 0.5 * unit, end + 0.5 * unit,
                ground); // the ring passes behind
    canvas.coverage(coverage, corner, ink);
    draw_dots(canvas, {0.5 * width, below ? height - 3.0 * unit : 3.0 * unit}, unit,
              static_cast<int>(procedure.wanted()),
              [&](int k) { return k < static_cast<int>(procedure.taken()); }, {taken_colour, ink});
    return canvas.take();
}

} // namespace frustumscreen::programs
