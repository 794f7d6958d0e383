/// A calibration by touch: the prop was laid on crosses that the projector shows, and from that come projector and tracker, with a verdict.
///
/// Frames   calibrated_table.h.
/// Units    metres, pixels.
/// Errors   none: touches from which nothing follows are refused with a reason for the technician. docs/calibration.md says what each verdict promises.
/// Time     some ten milliseconds for touches that agree; below a second for those that do not.
/// Threads  pure; any.
#pragma once

#include "app/calibration/agreement.h"
#include "app/calibration/calibrated_table.h"
#include "app/calibration/determinacy.h"
#include "app/calibration/picture_limits.h"
#include "app/calibration/priors.h"
#include "app/calibration/touch.h"
#include "app/calibration/verdict.h"
#include "app/calibration/zone.h"

#include <span>
#include <string>
#include <string_view>

namespace frustumscreen {

struct TouchSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    std::optional<double>
        sensor_height_m; ///< the sensor above the touched place while the prop stands upright
    double top_m = 0.12; ///< the prop's height: how far up the zone reaches
    TouchNoise noise;
    Priors priors;
};

/// How far a touch is off what all others say of it.
struct TouchResidual {
    double on_table_m = 0.0; ///< from where the cross's light is to where the prop was
    double pixel = 0.0;
};
/// By a model: a place in the tracker's frame, so far above the table, that a pixel should light. Where no light comes, both are large.
[[nodiscard]] TouchResidual residual_of(const TouchModel& model, const glm::dvec3& place, double height_m,
                                        const glm::dvec2& pixel);

/// How high the boards are, as the tracker measured them.
struct BoardsHeight {
    double given_m = 0.0;
    double found_m = 0.0;
    double sd_m = 0.0;
    /// They are not as high as they were said to be.
    [[nodiscard]] bool differ() const;
};
/// A half sentence with a semicolon before it; empty: they are as high as they were said to be.
[[nodiscard]] std::string in_words(const std::optional<BoardsHeight>& boards);
/// `given_m`: the highest boards of the points; none without boards.
[[nodiscard]] std::optional<BoardsHeight> boards_of(const TouchModel& model, const Covariance& covariance,
                                                    double given_m);

struct TouchCalibration {
    Verdict verdict = Verdict::Refused;
    std::string reason;                   ///< one sentence
    std::vector<std::size_t> repeat;      ///< touches to do again, counted from 0
    std::optional<CalibratedTable> table; ///< none if refused
    std::vector<TouchResidual> residuals; ///< of each touch, left out
    double mean_residual_m = 0.0;         ///< of the touches that agree
    double worst_residual_m = 0.0;
    double mean_residual_px = 0.0;
    double worst_residual_px = 0.0;
    PictureUncertainty uncertainty; ///< of the picture over the zone, one standard deviation
    double hidden_error_m = 0.0;    ///< what one wrong touch could do to it and yet agree with the others
    PriorShares prior_shares;
    std::optional<BoardsHeight> boards; ///< none: nothing lay on boards
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

/// The picture's error as half a sentence, for a verdict whose shares are known.
[[nodiscard]] std::string in_words(const PictureUncertainty& uncertainty);
/// The words for what was measured, touches or rests, in the sentences of a verdict.
struct MeasuredKind {
    std::string_view one, many;
    std::string_view scattered, why_scattered; ///< what scatters; a question, its last part
    std::string_view three_more;               ///< where they are too few to check each other
    std::string_view spread;                   ///< where the picture is too uncertain
    std::string_view tilt;                     ///< what the prop may do in three of them
};
/// The verdict on a calibration whose residuals are known, its reason, what to do again. `wrong`: the names of that.
void judge(TouchCalibration& calibration, const MeasuredKind& kind, const Agreed& found,
           std::span<const std::string> wrong);
/// Tells how to determine what the points leave undetermined.
[[nodiscard]] std::string in_words(const Undetermined& open, const MeasuredKind& kind);
/// Which ones do not fit, half a sentence; one at least.
[[nodiscard]] std::string misfits(std::string_view one, std::string_view many,
                                  std::span<const std::string> wrong);
/// As people count them, from 1.
[[nodiscard]] std::vector<std::string> row_names(std::span<const std::size_t> rows);

[[nodiscard]] TouchCalibration calibrate_touch(std::span<const Touch> touches, const TouchSetup& setup);

} // namespace frustumscreen
