#include "app/programs/calibrate/eye_picture.h"

#include "app/exhibit/canvas.h"
#include "app/programs/calibrate/table_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen {

namespace {

std::string_view words_of(EyeWord word) {
    switch (word) {
    case EyeWord::None:
        return "";
    case EyeWord::PropMoves:
        return "The prop is not at rest yet. Take your hands away.";
    case EyeWord::PropMoved:
        return "The prop was pushed. Let it lie; its place is taken anew, and this sighting comes again.";
    case EyeWord::PropNotSeen:
        return "The tracker does not see the prop. Look at its cable and its sensor.";
    case EyeWord::HeadNotSeen:
        return "The tracker does not see the sensor on your head. Look at its cable, and come nearer.";
    case EyeWord::OffTable:
        return "The prop does not stand on the table as that was calibrated. Stand it upright; if it is, put "
               "the picture right first (table --touch-up).";
    case EyeWord::NoRoom:
        return "There is no room for crosses behind the prop. Lay it on the square.";
    case EyeWord::HeadMoved:
        return "Your head moved. Keep it still; the second begins anew.";
    case EyeWord::SameHead:
        return "Your head is held as before. Hold it as it is asked for, then press Next again.";
    case EyeWord::Taken:
        return "Good.";
    }
    return "";
}

std::string_view name_of(OpenEye eye) {
    return eye == OpenEye::Left ? "left" : "right";
}

std::string_view words_of(HeadPosture posture) {
    switch (posture) {
    case HeadPosture::ChinUp:
        return "chin up";
    case HeadPosture::ChinDown:
        return "chin down";
    case HeadPosture::TurnedLeft:
        return "face turned to the left";
    case HeadPosture::TurnedRight:
        return "face turned to the right";
    }
    return "";
}

std::string_view key_of(HeadPosture posture) {
    switch (posture) {
    case HeadPosture::ChinUp:
        return "calibration.eyes.chin_up";
    case HeadPosture::ChinDown:
        return "calibration.eyes.chin_down";
    case HeadPosture::TurnedLeft:
        return "calibration.eyes.turned_left";
    case HeadPosture::TurnedRight:
        return "calibration.eyes.turned_right";
    }
    return "";
}

std::string_view key_of(EyeWord word, std::string_view otherwise) {
    switch (word) {
    case EyeWord::PropMoves:
        return "calibration.eyes.block_moves";
    case EyeWord::PropMoved:
        return "calibration.eyes.block_moved";
    case EyeWord::PropNotSeen:
        return "calibration.not_seen";
    case EyeWord::HeadNotSeen:
        return "calibration.eyes.head_not_seen";
    case EyeWord::OffTable:
        return "calibration.eyes.off_table";
    case EyeWord::NoRoom:
        return "calibration.eyes.no_room";
    case EyeWord::HeadMoved:
        return "calibration.eyes.head_moved";
    case EyeWord::SameHead:
        return "calibration.eyes.same_head";
    case EyeWord::None:
    case EyeWord::Taken:
        break;
    }
    return otherwise;
}

std::vector<std::string> words_of_begin(const EyeProcedure& procedure) {
    if (!procedure.problem().empty()) {
        return {"The eyes cannot be measured", as_sentence(procedure.problem()), "Back leaves."};
    }
    return {
        "Staff: where are the eyes?",
        fmt::format("The eyes' place in the head's sensor is measured with {} sightings over the prop; that "
                    "takes about five minutes. Put the sensor on your head as visitors wear it. Lay the "
                    "prop on the square, and let it lie.",
                    procedure.count()),
        "Next begins. Back leaves; so does a minute without a press."};
}

std::vector<std::string> words_of_shut(OpenEye open) {
    return {fmt::format("Shut your {} eye", open == OpenEye::Left ? "right" : "left"),
            fmt::format("Or cover it with your hand. Look with the {} one alone, until you are asked for the "
                        "other. Then press Next.",
                        name_of(open))};
}

std::vector<std::string> words_of_aim(const EyeProcedure& procedure) {
    const AskedSight& asked = procedure.asked();
    return {
        fmt::format("Sighting {} of {}: {}", procedure.at() + 1, procedure.count(), words_of(asked.posture)),
        fmt::format("With the {} eye alone, your {}: move until the lit corner of the prop covers the "
                    "middle of the cross. Then press Next, and keep still.",
                    name_of(asked.eye), words_of(asked.posture))};
}

std::string words_of_choice(const EyeProcedure& procedure) {
    switch (procedure.judged()->verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        return "Next keeps it. Back does the sighting again that lies farthest off.";
    case Verdict::Repeat:
        return procedure.asks_for_more() ? "Next brings more sightings."
                                         : "Next does the doubtful sightings again.";
    case Verdict::Refused:
        return "Next begins anew. Back does one sighting again.";
    }
    return "";
}

std::vector<std::string> words_of_verdict(const EyeProcedure& procedure) {
    const EyeFit& fit = *procedure.judged();
    std::vector<std::string> words{fmt::format("The eyes' place is: {}", name_of(fit.verdict)),
                                   as_sentence(fit.reason)};
    if (fit.eyes) {
        words.push_back(fmt::format(
            "A line of sight passes the eye that the others find by {:.0f} mm, {:.0f} mm at worst.",
            1e3 * fit.mean_residual_m, 1e3 * fit.worst_residual_m));
    }
    words.push_back(words_of_choice(procedure));
    return words;
}

std::string_view key_of_verdict(const EyeProcedure& procedure) {
    switch (procedure.judged()->verdict) {
    case Verdict::Good:
    case Verdict::Usable:
        return "calibration.eyes.may_be_kept";
    case Verdict::Repeat:
        return procedure.asks_for_more() ? "calibration.more_rests" : "calibration.repeat";
    case Verdict::Refused:
        return "calibration.eyes.refused";
    }
    return "";
}

bool has_cross(CalibrationStage stage) {
    return stage == CalibrationStage::Place || stage == CalibrationStage::HoldStill;
}

/// Lines between points of the table's space.
class SightDrawing {
public:
    SightDrawing(const EyeProcedure& procedure, Canvas& canvas)
        : procedure_(procedure), scene_(procedure.scene()), canvas_(canvas),
          unit_(scene_.pinhole.width / 160.0) {}

    /// Where the prop is to lie.
    void square() {
        const RigidTransform place = wished_place(scene_);
        std::array<glm::dvec2, 4> bottom{};
        for (std::size_t k = 0; k < bottom.size(); ++k) {
            bottom[k] = pixel(place.point(scene_.prop.corners[k]));
        }
        canvas_.outline(bottom, 0.5 * unit_, TableColours::front);
    }
    void cross(Colour colour) {
        const glm::dvec3& middle = procedure_.cross().cross_m;
        for (const glm::dvec3& arm : {glm::dvec3(cross_arm_m, 0.0, 0.0), glm::dvec3(0.0, cross_arm_m, 0.0)}) {
            line(middle - arm, middle + arm, 0.2 * unit_, colour);
        }
        canvas_.circle(procedure_.cross().pixel, 0.8 * unit_, 0.2 * unit_, colour);
    }
    /// On the prop: the corner, and the way to it from the middle of what lies highest.
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
        const double radius = 0.003; // a circle whose line is as wide as its radius is long is a dot
        const glm::dvec2 dot = pixel(tip + 0.0045 * inwards);
        const double radius_px = glm::distance(dot, pixel(tip + (0.0045 + radius) * inwards));
        canvas_.circle(dot, 0.5 * radius_px, radius_px, TableColours::white);
    }

private:
    [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& point) const {
        return pixel_of(scene_, point).value_or(glm::dvec2(-1e4));
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
    void line(const glm::dvec3& from, const glm::dvec3& to, double width, Colour colour) {
        canvas_.line(pixel(from), pixel(to), width, colour);
    }

    const EyeProcedure& procedure_;
    const SightScene& scene_;
    Canvas& canvas_;
    double unit_;
};

/// The house's sentence, and while the corner is brought over the cross also how the head is to be held; below them the English lines.
Image<std::uint8_t> words_at(const EyeProcedure& procedure, const Typesetter& typesetter,
                             const LanguageWords* house, double width, double unit) {
    const std::string_view key = word_key(procedure);
    Image<std::uint8_t> words = typesetter.set(paragraphs_of(eye_words(procedure), unit), 0.95 * width);
    if (procedure.stage() == CalibrationStage::Place && key != key_of(procedure.asked().posture)) {
        words = above(house_sentence(house, key_of(procedure.asked().posture), 0.95 * width, beside_em),
                      words, 2.0 * unit);
    }
    return above(house_sentence(house, key, 0.95 * width, beside_em), words, 2.0 * unit);
}

/// As large as they fit into the box, at its lower end: the person stands there.
void draw_words(Canvas& canvas, const EyeProcedure& procedure, const Typesetter& typesetter,
                const LanguageWords* house) {
    const WordsBox& box = procedure.words();
    const double row = box.size().x / (4.0 * static_cast<double>(procedure.count() + 1));
    const double dot = std::fmin(procedure.scene().pinhole.width / 160.0, row);
    const double height = box.size().y - 5.0 * dot;
    constexpr double smaller = 0.9, smallest = 0.3;
    double share = 1.0;
    Image<std::uint8_t> words;
    do {
        words = words_at(procedure, typesetter, house, share * box.size().x,
                         share * procedure.scene().pinhole.width / 160.0);
        share *= smaller;
    } while ((words.height > height || words.width > box.size().x) && share > smallest);
    const glm::dvec2 corner(box.low.x, box.high.y - 5.0 * dot - words.height);
    const bool is_well = procedure.word() == EyeWord::Taken || procedure.word() == EyeWord::None;
    canvas.coverage(words, glm::ivec2(glm::max(corner, glm::dvec2(0.0))),
                    is_well ? TableColours::white : TableColours::front);
    draw_dots(canvas, {0.5 * (box.low.x + box.high.x), box.high.y - 2.0 * dot}, dot,
              static_cast<int>(procedure.count()),
              [&](int k) { return procedure.is_taken(static_cast<std::size_t>(k)); },
              {TableColours::good, TableColours::dim});
}

} // namespace

std::vector<std::string> eye_words(const EyeProcedure& procedure) {
    std::vector<std::string> words;
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return words_of_begin(procedure);
    case CalibrationStage::Rest:
        words = {"Let the prop lie", "Its place is taken: one second of rest."};
        break;
    case CalibrationStage::Shut:
        words = words_of_shut(procedure.asked().eye);
        break;
    case CalibrationStage::Place:
        words = words_of_aim(procedure);
        break;
    case CalibrationStage::HoldStill:
        words = {fmt::format("Sighting {} of {}", procedure.at() + 1, procedure.count()),
                 "Keep your head still: one second."};
        break;
    case CalibrationStage::Solve:
        return {"One moment, please."};
    case CalibrationStage::Judged:
        return words_of_verdict(procedure);
    case CalibrationStage::Done:
        return {"The eyes' place is kept."};
    default: // Left
        return {"Nothing was changed."};
    }
    if (const std::string_view more = words_of(procedure.word()); !more.empty()) {
        words.emplace_back(more);
    }
    return words;
}

std::string_view word_key(const EyeProcedure& procedure) {
    switch (procedure.stage()) {
    case CalibrationStage::Begin:
        return procedure.problem().empty() ? "calibration.eyes.begin" : "";
    case CalibrationStage::Rest:
        return key_of(procedure.word(), "calibration.eyes.rest");
    case CalibrationStage::Shut:
        return procedure.asked().eye == OpenEye::Left ? "calibration.eyes.shut_right"
                                                      : "calibration.eyes.shut_left";
    case CalibrationStage::Place:
        return key_of(procedure.word(), key_of(procedure.asked().posture));
    case CalibrationStage::HoldStill:
        return key_of(procedure.word(), "calibration.eyes.hold_still");
    case CalibrationStage::Solve:
        return "calibration.all_taken";
    case CalibrationStage::Judged:
        return key_of_verdict(procedure);
    case CalibrationStage::Done:
        return "calibration.eyes.kept";
    default: // Left
        return "calibration.eyes.unchanged";
    }
    return "";
}

Image8 eye_picture(const EyeProcedure& procedure, const Typesetter& typesetter, const LanguageWords* house) {
    Canvas canvas(procedure.scene().pinhole.width, procedure.scene().pinhole.height, {0, 0, 0});
    SightDrawing drawing(procedure, canvas);
    if (!procedure.knows_place() && procedure.stage() != CalibrationStage::Left) {
        drawing.square();
    }
    if (has_cross(procedure.stage())) {
        const bool is_held = procedure.stage() == CalibrationStage::HoldStill;
        const bool moved = procedure.word() == EyeWord::HeadMoved;
        drawing.cross(!is_held ? TableColours::white : moved ? TableColours::bad : TableColours::good);
        drawing.tip();
    }
    draw_words(canvas, procedure, typesetter, house);
    return canvas.take();
}

} // namespace frustumscreen
