#include "app/programs/calibrate/judged_words.h"

#include "app/programs/calibrate/table_words.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

std::string what_moved(Moved moved) {
    switch (moved) {
    case Moved::Projector:
        return "The projector moved.";
    case Moved::Tracker:
        return "The tracker's source moved.";
    case Moved::Either:
        return "The projector moved, or the tracker's source.";
    default:
        return "Nothing has moved.";
    }
}

std::string right_again(const TouchUp& found) {
    const std::string was = fmt::format("The picture was {:.0f} mm beside its place.", 1e3 * found.off_m);
    return found.verdict == Verdict::Repeat
               ? was + " These touches are too few to check each other."
               : fmt::format("{} Once this is kept it is right again, to about {:.1f} mm.", was,
                             1e3 * found.uncertainty.mean_m);
}

} // namespace

TouchJudgement judgement_of(const TouchCalibration& calibration) {
    TouchJudgement judged{calibration.verdict,
                          {fmt::format("The calibration is: {}", name_of(calibration.verdict)),
                           as_sentence(calibration.reason)},
                          calibration.repeat,
                          calibration.residuals,
                          false};
    if (calibration.table) {
        judged.told.push_back(
            fmt::format("Each touch lies {:.1f} mm from where the others expect it, {:.1f} mm at worst.",
                        1e3 * calibration.mean_residual_m, 1e3 * calibration.worst_residual_m));
    }
    return judged;
}

TouchJudgement judgement_of(const TouchUp& found) {
    TouchJudgement judged{found.verdict, {}, {}, found.residuals, false};
    if (!found.table) {
        judged.told = {"The touches do not fit what was measured before.", as_sentence(found.reason)};
        return judged;
    }
    judged.nothing_moved = found.moved == Moved::Nothing;
    judged.told = {what_moved(found.moved),
                   judged.nothing_moved ? as_sentence(found.reason) : right_again(found)};
    return judged;
}

} // namespace frustumscreen
