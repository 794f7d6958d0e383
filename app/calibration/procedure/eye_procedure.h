/// Guides a person with a sensor on the head through the sightings that locate the eyes in the sensor's
/// frame, with two buttons: which cross is shown, what is said, and which of the tracker's reports become
/// sightings.
///
/// Rest     The prop's rest gives the places of its corners, through the registration. Whenever the prop is
///          pushed later, its rest is taken again; earlier sightings keep the corner that they were made
///          with.
/// Sights   For each eye, the person is told which one to shut and presses Next. Then come the crosses of
///          this eye, each with another posture of the head. The person brings the corner over the cross and
///          presses Next; one second of stillness is taken, and begins again if the head moves. Back repeats
///          the previous sighting.
/// End      Next keeps the result, repeats doubtful sightings, or adds more; Back repeats the sighting with
///          the largest residual.
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

namespace frustumscreen::calibration {

/// The head's posture: an eye's lines must meet at angles in the head, both upwards and sideways.
enum class HeadPosture { ChinUp, ChinDown, TurnedLeft, TurnedRight };

/// The remark beside the instruction.
enum class EyePrompt {
    None,
    PropMoves,   ///< the prop is not at rest yet
    PropMoved,   ///< the prop moved after its rest, which is taken again
    PropNotSeen, ///< by the tracker
    HeadNotSeen,
    OffTable,  ///< the prop does not stand on the calibrated table
    NoRoom,    ///< no space for the crosses
    HeadMoved, ///< the head moved: the second begins again
    SameHead,  ///< the head is held as for the previous sighting
    Taken
};

/// A requested sighting.
struct AskedSight {
    OpenEye eye = OpenEye::Left;
    HeadPosture posture = HeadPosture::ChinUp;
    std::size_t place = 0; ///< index of its cross in the plan
};

class EyeProcedure : public Procedure<EyePrompt, EyeFit> {
public:
    static constexpr Nanoseconds rest = std::chrono::seconds(1);
    static constexpr std::size_t min_reports = 5; ///< in a second of rest
    static constexpr std::size_t of_each = 6;     ///< sightings with each eye, at first
    static constexpr std::size_t more = 2;        ///< with each, if those are too few
    static constexpr std::size_t max_of_each = 10;
    static constexpr std::size_t min_crosses = 4; ///< different crosses
    /// A head that is held still trembles and sways by some millimetres.
    static constexpr StillLimits head_limits{8e-3, 0.06};
    static constexpr double turned_rad =
        0.1; ///< least change of the line of sight in the head between sightings
    static constexpr double off_table_m = 0.015;

    /// Also sets a problem if the picture is too small.
    EyeProcedure(SightScene scene, const geometry::Registration& registration, std::string problem = {});

    void step(const Input& input);

    [[nodiscard]] const SightScene& scene() const { return scene_; }
    /// True once the prop's rest is known. Before that, the prop should stand at the scene's `first_place`.
    [[nodiscard]] bool knows_place() const { return knows_place_; }
    /// The prop's pose at its rest.
    [[nodiscard]] const geometry::RigidTransform& table_from_prop() const { return table_from_prop_; }
    /// The space for words beside the prop.
    [[nodiscard]] const WordsBox& words() const { return knows_place_ ? plan_.words : first_words_; }
    /// Index of the requested sighting, from 0; in the stages Shut, Place and HoldStill.
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t count() const { return asked_.size(); }
    [[nodiscard]] const AskedSight& asked() const { return asked_[at_]; }
    [[nodiscard]] const SightCross& cross() const {
        return plan_.crosses[asked().place % plan_.crosses.size()];
    }
    [[nodiscard]] bool is_taken(std::size_t sight) const { return sights_[sight].has_value(); }
    /// The sightings taken so far; in stage Solve and after it, all of them.
    [[nodiscard]] ReportedSights sights() const;
    /// True if Next asks for more sightings, after the verdict.
    [[nodiscard]] bool asks_for_more() const;

private:
    void ask(std::size_t from, std::size_t to);
    void watch(const Input& input);
    void begin(const Input& input);
    void begin_rest(MonotonicTime now, EyePrompt word);
    void take_rest(const Input& input);
    [[nodiscard]] EyePrompt missing(MonotonicTime now) const;
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
        glm::dvec3 in_sensor{0.0}; ///< direction of its line, from the cross
    };
    SightScene scene_;
    geometry::Registration registration_;
    std::vector<AskedSight> asked_;
    std::vector<std::optional<Taken>> sights_; ///< one for each
    geometry::RigidTransform table_from_prop_;
    bool knows_place_ = false;
    WordsBox first_words_;
    SightPlan plan_;
    std::size_t at_ = 0;
    std::optional<OpenEye> open_; ///< the open eye
    StillReports prop_still_{3};
    StillReports head_still_{1, head_limits};
    MonotonicTime prop_seen_{}, head_seen_{};
    std::optional<geometry::RigidTransform> head_; ///< the latest report
};

} // namespace frustumscreen::calibration
