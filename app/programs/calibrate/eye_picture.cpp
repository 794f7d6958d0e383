#include "app/programs/calibrate/table_pictures.h"
#include "app/typography/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace frustumscreen::programs {

namespace {

using Stage = calibration::CalibrationStage;

constexpr std::array<WordMessage<calibration::EyePrompt>, 9> eye_messages{{
    {calibration::EyePrompt::PropMoves,
     {"calibration.eyes.block_moves", "The prop is not at rest yet. Take your hands away."}},
    {calibration::EyePrompt::PropMoved,
     {"calibration.eyes.block_moved",
      "The prop was pushed. Let it lie; its place is measured again, and this sighting is repeated."}},
    {calibration::EyePrompt::PropNotSeen,
     {"calibration.not_seen", "The tracker does not see the prop. Look at its cable and its sensor."}},
    {calibration::EyePrompt::HeadNotSeen,
     {"calibration.eyes.head_not_seen",
      "The tracker does not see the sensor on your head. Look at its cable, and come nearer."}},
    {calibration::EyePrompt::OffTable,
     {"calibration.eyes.off_table", "The prop does not stand as the table was measured. Stand it upright; if "
                                    "it is upright, put the picture right first (table --touch-up)."}},
    {calibration::EyePrompt::NoRoom,
     {"calibration.eyes.no_room", "There is no room for crosses behind the prop. Lay it on the square."}},
    {calibration::EyePrompt::HeadMoved,
     {"calibration.eyes.head_moved", "Your head moved. Keep it still; the second starts again."}},
    {calibration::EyePrompt::SameHead,
     {"calibration.eyes.same_head",
      "Your head is held as in the last sighting. Hold it as shown, then press Next again."}},
    {calibration::EyePrompt::Taken, {"", "Good."}},
}};
constexpr std::array<WordMessage<calibration::HeadPosture>, 4> posture_messages{{
    {calibration::HeadPosture::ChinUp, {"calibration.eyes.chin_up", "chin up"}},
    {calibration::HeadPosture::ChinDown, {"calibration.eyes.chin_down", "chin down"}},
    {calibration::HeadPosture::TurnedLeft, {"calibration.eyes.turned_left", "face turned to the left"}},
    {calibration::HeadPosture::TurnedRight, {"calibration.eyes.turned_right", "face turned to the right"}},
}};

TableWords words_of_begin(const calibration::EyeProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return why_not("The eyes cannot be measured", procedure.problem(), "Back leaves.");
    }
    return {
        "calibration.eyes.begin",
        {"Staff: where are the eyes?",
         fmt::format("The eyes' place in the head's sensor is measured with {} sightings over the prop; that "
                     "takes about five minutes. Put the sensor on your head as visitors wear it. Lay the "
                     "prop on the square, and let it lie.",
                     procedure.count()),
         "Next begins. Back leaves; so does a minute without a press."}};
}

TableWords words_of_sight(const calibration::EyeProcedure& procedure) {
    const calibration::AskedSight& asked = procedure.asked();
    const bool is_left = asked.eye == calibration::OpenEye::Left;
    const char* const open = is_left ? "left" : "right";
    const std::string sight = fmt::format("Sighting {} of {}", procedure.at() + 1, procedure.count());
    if (procedure.stage() == Stage::HoldStill) {
        return {"calibration.eyes.hold_still", {sight, "Keep your head still: one second."}};
    }
    if (procedure.stage() == Stage::Shut) {
        return {is_left ? "calibration.eyes.shut_right" : "calibration.eyes.shut_left",
                {fmt::format("Shut your {} eye", is_left ? "right" : "left"),
                 fmt::format(
                     "Or cover it with your hand. Look with the {} one alone, until you are asked for the "
                     "other. Then press Next.",
                     open)}};
    }
    const Message held = message_of(posture_messages, asked.posture);
    return {held.key,
            {fmt::format("{}: {}", sight, held.english),
             fmt::format("With the {} eye alone, your {}: move until the lit corner of the prop covers the "
                         "middle of the cross. Then press Next, and keep still.",
                         open, held.english)}};
}

/// Tells what the two buttons do after the verdict.
Message choice_of(const calibration::EyeProcedure& procedure) {
    switch (procedure.judged()->verdict) {
    case calibration::Verdict::Good:
    case calibration::Verdict::Usable:
        return {"calibration.eyes.may_be_kept",
                "Next keeps it. Back does the sighting again that lies farthest off."};
    case calibration::Verdict::Repeat:
        return procedure.asks_for_more()
                   ? Message{"calibration.more_rests", "Next adds more sightings."}
                   : Message{"calibration.repeat", "Next does the doubtful sightings again."};
    case calibration::Verdict::Refused:
        break;
    }
    return {"calibration.eyes.refused", "Next starts again. Back repeats one sighting."};
}

TableWords words_of_verdict(const calibration::EyeProcedure& procedure) {
    const calibration::EyeFit& fit = *procedure.judged();
    TableWords words{"",
                     {fmt::format("The eyes' place is: {}", calibration::name_of(fit.verdict)),
                      as_sentence(fit.reason.sentence)}};
    if (fit.eyes) {
        words.add("",
                  fmt::format(
                      "A line of sight passes the eye that the others find by {:.0f} mm, {:.0f} mm at worst.",
                      1e3 * fit.mean_residual_m, 1e3 * fit.worst_residual_m));
    }
    words.add(choice_of(procedure));
    return words;
}

TableWords words_of_stage(const calibration::EyeProcedure& procedure) {
    switch (procedure.stage()) {
    case Stage::Begin:
        return words_of_begin(procedure);
    case Stage::Rest:
        return {"calibration.eyes.rest",
                {"Let the prop lie", "Its place is measured. Leave it still for one second."}};
    case Stage::Shut:
    case Stage::Place:
    case Stage::HoldStill:
        return words_of_sight(procedure);
    case Stage::Judged:
        return words_of_verdict(procedure);
    case Stage::Done:
        return {"calibration.eyes.kept", {"The eyes' place is kept."}};
    case Stage::Left:
        return {"calibration.eyes.unchanged", {"Nothing was changed."}};
    default:
        return one_moment();
    }
}

bool has_cross(Stage stage) {
    return stage == Stage::Place || stage == Stage::HoldStill;
}

/// Draws lines between points in the table's frame.
class SightDrawing {
public:
    SightDrawing(const calibration::EyeProcedure& procedure, typography::Canvas& canvas)
        : procedure_(procedure), scene_(procedure.scene()), canvas_(canvas),
          unit_(scene_.pinhole.width / 160.0) {}

    /// The polygon on which the prop should stand.
    void foot() {
        const geometry::RigidTransform place = calibration::first_place(scene_);
        std::vector<glm::dvec2> foot;
        for (const glm::dvec3& corner : geometry::foot_of(scene_.prop)) {
            foot.push_back(pixel(place.point(corner)));
        }
        canvas_.outline(foot, 0.5 * unit_, TableColours::front);
    }
    void cross(typography::Colour colour) {
        const glm::dvec3& middle = procedure_.cross().cross_m;
        for (const glm::dvec3& arm : {glm::dvec3(calibration::cross_arm_m, 0.0, 0.0),
                                      glm::dvec3(0.0, calibration::cross_arm_m, 0.0)}) {
            line(middle - arm, middle + arm, 0.2 * unit_, colour);
        }
        canvas_.circle(procedure_.cross().pixel, 0.8 * unit_, 0.2 * unit_, colour);
    }
    /// Marks the corner on the prop, and leads to it from the middle of the prop's top.
    void tip() {
        const glm::dvec3& tip = procedure_.cross().tip_m;
        const glm::dvec3 way = middle_of_top() - tip;
        const double length = std::fmin(0.04, 0.9 * glm::length(way));
        const glm::dvec3 inwards = glm::normalize(way);
        const glm::dvec3 aside = 0.005 * glm::normalize(glm::cross(inwards, glm::dvec3(0.0, 0.0, 1.0)));
        const glm::dvec3 head = tip + 0.011 * inwards;
        const double width = 0.4 * unit_;
        line(tip + length * inwards, head, width, TableColours::front);
        line(head, head + 0.008 * inwards + aside, width, TableColours::front);
        line(head, head + 0.008 * inwards - aside, width, TableColours::front);
        const double radius = 0.003; // a circle of half of it, with a line as wide as it, is a dot
        const glm::dvec2 dot = pixel(tip + 0.0045 * inwards);
        const double radius_px = glm::distance(dot, pixel(tip + (0.0045 + radius) * inwards));
        canvas_.circle(dot, 0.5 * radius_px, radius_px, TableColours::white);
    }

private:
    [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& point) const {
        return calibration::pixel_of(scene_, point).value_or(glm::dvec2(-1e4));
    }
    [[nodiscard]] glm::dvec3 middle_of_top() const {
        glm::dvec3 sum(0.0);
        double count = 0.0;
        for (const glm::dvec3& corner : scene_.prop.corners) {
            const glm::dvec3 place = procedure_.table_from_prop().point(corner);
            if (place.z > 0.9 * procedure_.cross().tip_m.z) {
                sum += place;
                count += 1.0;
            }
        }
        return sum / count;
    }
    void line(const glm::dvec3& from, const glm::dvec3& to, double width, typography::Colour colour) {
        canvas_.line(pixel(from), pixel(to), width, colour);
    }

    const calibration::EyeProcedure& procedure_;
    const calibration::SightScene& scene_;
    typography::Canvas& canvas_;
    double unit_;
};

/// The sentence in the house's language, also the head's posture while the corner is brought over the cross,
/// above the English lines.
image::Image<std::uint8_t> words_at(const calibration::EyeProcedure& procedure, const TableDrawing& with,
                                    double width, double unit) {
    const TableWords said = table_words(procedure);
    image::Image<std::uint8_t> words = with.typesetter.set(paragraphs_of(said.lines, unit), 0.95 * width);
    const auto put_above = [&](std::string_view key) {
        words = above(sentence_above(with.own_words, key, 0.95 * width, beside_em), words, 2.0 * unit);
    };
    if (procedure.stage() == Stage::Place) {
        const std::string_view held = message_of(posture_messages, procedure.asked().posture).key;
        put_above(said.key != held ? held : "");
    }
    put_above(said.key);
    return words;
}

/// Draws the words as large as they fit into the box, at its lower end, where the person stands.
void draw_words(typography::Canvas& canvas, const calibration::EyeProcedure& procedure,
                const TableDrawing& with) {
    const calibration::WordsBox& box = procedure.words();
    const double row = box.size().x / (4.0 * static_cast<double>(procedure.count() + 1));
    const double dot = std::fmin(procedure.scene().pinhole.width / 160.0, row);
    const double height = box.size().y - 5.0 * dot;
    constexpr double smaller = 0.9, smallest = 0.3;
    double share = 1.0;
    image::Image<std::uint8_t> words;
    do {
        words =
            words_at(procedure, with, share * box.size().x, share * procedure.scene().pinhole.width / 160.0);
        share *= smaller;
    } while ((words.height > height || words.width > box.size().x) && share > smallest);
    const glm::dvec2 corner(box.low.x, box.high.y - 5.0 * dot - words.height);
    const bool is_well =
        procedure.word() == calibration::EyePrompt::Taken || procedure.word() == calibration::EyePrompt::None;
    canvas.coverage(words, glm::ivec2(glm::max(corner, glm::dvec2(0.0))),
                    is_well ? TableColours::white : TableColours::front);
    draw_dots(canvas, {0.5 * (box.low.x + box.high.x), box.high.y - 2.0 * dot}, dot,
              static_cast<int>(procedure.count()),
              [&](int k) { return procedure.is_taken(static_cast<std::size_t>(k)); },
              {TableColours::good, TableColours::dim});
}

} // namespace

TableWords table_words(const calibration::EyeProcedure& procedure) {
    TableWords words = words_of_stage(procedure);
    const Stage stage = procedure.stage();
    if (stage > Stage::Begin && stage < Stage::Solve) {
        const Message more = message_of(eye_messages, procedure.word());
        words.add(stage == Stage::Shut ? "" : more.key, more.english);
        words.of = procedure.at();
    }
    return words;
}

image::Image8 table_picture(const calibration::EyeProcedure& procedure, const TableDrawing& with) {
    typography::Canvas canvas(procedure.scene().pinhole.width, procedure.scene().pinhole.height, {0, 0, 0});
    SightDrawing drawing(procedure, canvas);
    if (!procedure.knows_place() && procedure.stage() != Stage::Left) {
        drawing.foot();
    }
    if (has_cross(procedure.stage())) {
        const bool is_held = procedure.stage() == Stage::HoldStill;
        const bool moved = procedure.word() == calibration::EyePrompt::HeadMoved;
        drawing.cross(!is_held ? TableColours::white : moved ? TableColours::bad : TableColours::good);
        drawing.tip();
    }
    draw_words(canvas, procedure, with);
    return canvas.take();
}

} // namespace frustumscreen::programs
