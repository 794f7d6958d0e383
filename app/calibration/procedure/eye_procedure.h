/// The way of a person with a sensor on the head through the sightings that tell where the eyes are in it, with two buttons: which cross is shown,
/// what is said, and which of the tracker's reports become sightings.
///
/// Rest     The prop's rest is taken: where its corners are follows from the registration. Whenever the prop is pushed later, its rest is taken anew;
///          sightings that were made keep their own corner.
/// Sights   For each eye: which one is to be shut is told, and Next pressed; then come its crosses, each with another posture of the head. The person
///          brings the corner over the cross; Next; a second of stillness is taken, and begins anew if the head moves. Back does the sighting before again.
/// End      Next keeps it, or does again what is doubtful, or makes more; Back does the sighting again that lies farthest off.
/// Frames   tracker K, as the device reports; table T.
/// Threads  pure; any.
#pragma once

#include "app/calibration/eye_fit.h"
#include "app/calibration/procedure/procedure.h"
#include "app/calibration/procedure/sight_plan.h"
#include "app/calibration/procedure/still_reports.h"
#include "app/geometry/registration.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

/// How the head is to be held: an eye's lines must meet at angles in the head, both upwards and sideways.
enum class HeadPosture { ChinUp, ChinDown, TurnedLeft, TurnedRight };

/// What is said beside what is to be done.
enum class EyeWord {
    None,
    PropMoves,   ///< it is not at rest yet
    PropMoved,   ///< after its rest: that is taken anew
    PropNotSeen, ///< by the tracker
    HeadNotSeen,
    OffTable,  ///< it does not stand on the table as that was calibrated
    NoRoom,    ///< for the crosses
    HeadMoved, ///< the second begins anew
    SameHead,  ///< it is held as for the sighting before
    Taken
};

/// One sighting that is asked for.
struct AskedSight {
    OpenEye eye = OpenEye::Left;
    HeadPosture posture = HeadPosture::ChinUp;
    std::size_t place = 0; ///< of its cross among those of the plan
};

class EyeProcedure : public Procedure<EyeWord, EyeFit> {
public:
    static constexpr Nanoseconds rest = std::chrono::seconds(1);
    static constexpr std::size_t least_reports = 5; ///< in a second of rest
    static constexpr std::size_t of_each = 6;       ///< sightings with each eye, at first
    static constexpr std::size_t more = 2;          ///< with each, where those are too few
    static constexpr std::size_t most_of_each = 10;
    static constexpr std::size_t least_crosses = 4; ///< different ones
    /// A head that is held still trembles and sways by some millimetres.
    static constexpr StillLimits head_limits{8e-3, 0.06};
    static constexpr double turned_rad =
        0.1; ///< of the line of sight in the head, from one sighting to the next, at least
    static constexpr double off_table_m = 0.015;

    /// A picture that is too small is a problem too.
    EyeProcedure(SightScene scene, const Registration& registration, std::string problem = {});

    void step(const Input& input);

    [[nodiscard]] const SightScene& scene() const { return scene_; }
    /// Whether the prop's rest was taken; else it is wished to stand where scene's `wished_place` is.
    [[nodiscard]] bool knows_place() const { return knows_place_; }
    /// Where the prop stood when its rest was taken.
    [[nodiscard]] const RigidTransform& table_from_prop() const { return table_from_prop_; }
    /// For words, beside that place.
    [[nodiscard]] const WordsBox& words() const { return knows_place_ ? plan_.words : wished_words_; }
    /// Which sighting is asked for, counted from 0; in the stages Shut, Place and HoldStill.
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t count() const { return asked_.size(); }
    [[nodiscard]] const AskedSight& asked() const { return asked_[at_]; }
    [[nodiscard]] const SightCross& cross() const {
        return plan_.crosses[asked().place % plan_.crosses.size()];
    }
    [[nodiscard]] bool is_taken(std::size_t sight) const { return sights_[sight].has_value(); }
    /// Those that are taken; in stage Solve and after it all that are asked for.
    [[nodiscard]] ReportedSights sights() const;
    /// After the verdict: Next asks for more sightings.
    [[nodiscard]] bool asks_for_more() const;

private:
    void ask(std::size_t from, std::size_t to);
    void watch(const Input& input);
    void begin(const Input& input);
    void begin_rest(MonotonicTime now, EyeWord word);
    void take_rest(const Input& input);
    [[nodiscard]] EyeWord missing(MonotonicTime now) const;
    void plan();
    void ask_for(std::size_t sight);
    void go_to_next_open();
    void go_back();
    void shut(const Input& input);
    void aim(const Input& input);
    void hold_still(const Input& input);
    void take();
    [[nodiscard]] bool is_held_as_before(const glm::dvec3& in_sensor) const;
    void after_judgement(const Input& input);
    void do_worst_again();

    struct Taken {
        ReportedSight sight;
        glm::dvec3 in_sensor{0.0}; ///< its line's direction, from the cross
    };
    SightScene scene_;
    Registration registration_;
    std::vector<AskedSight> asked_;
    std::vector<std::optional<Taken>> sights_; ///< one for each
    RigidTransform table_from_prop_;
    bool knows_place_ = false;
    WordsBox wished_words_;
    SightPlan plan_;
    std::size_t at_ = 0;
    std::optional<OpenEye> open_; ///< the eye that is looked with
    StillReports prop_still_{3};
    StillReports head_still_{1, head_limits};
    MonotonicTime prop_seen_{}, head_seen_{};
    std::optional<RigidTransform> head_; ///< the latest report
};

} // namespace frustumscreen
