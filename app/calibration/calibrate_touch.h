/// A calibration by touch: the prop is laid on crosses that the projector shows, and from these touches the
/// projector and the tracker are computed, with a verdict.
///
/// Frames   calibrated_table.h.
/// Units    metres, pixels.
/// Errors   none: touches that determine nothing are refused with a reason for the technician.
///          docs/calibration.md says what each verdict promises.
/// Time     some 10 ms for touches that agree; less than 1 s for others.
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

namespace frustumscreen::calibration {

struct TouchSetup {
    int width = 0; ///< the projector's picture
    int height = 0;
    std::optional<double>
        sensor_height_m; ///< the sensor's height above the touched place while the prop is upright
    double top_m = 0.12; ///< the prop's height; the zone reaches up to it
    TouchNoise noise;
    Priors priors;
};

/// Residual of a touch against a fit of all the others.
struct TouchResidual {
    double on_table_m = 0.0; ///< from the cross's light to the prop
    double pixel = 0.0;
};
/// Residual at a model: `place` in the tracker's frame, `height_m` above the table, should be lit by `pixel`.
/// Both members are large if the pixel's light does not reach that height.
[[nodiscard]] TouchResidual residual_of(const TouchModel& model, const glm::dvec3& place, double height_m,
                                        const glm::dvec2& pixel);

/// The boards' height as the tracker measured it.
struct BoardsHeight {
    double given_m = 0.0;
    double found_m = 0.0;
    double sd_m = 0.0;
    /// True if the measured height contradicts the given one.
    [[nodiscard]] bool differ() const;
};
/// A clause that begins with a semicolon; empty if the measured height agrees with the given one.
[[nodiscard]] std::string in_words(const std::optional<BoardsHeight>& boards);
/// `given_m`: the largest board height of the points. Nothing if there are no boards.
[[nodiscard]] std::optional<BoardsHeight> boards_of(const TouchModel& model, const Covariance& covariance,
                                                    double given_m);

struct TouchCalibration {
    Verdict verdict = Verdict::Refused;
    VerdictReason reason;
    std::vector<std::size_t> repeat;      ///< touches to do again, counted from 0
    std::optional<CalibratedTable> table; ///< none if refused
    std::vector<TouchResidual> residuals; ///< of each touch, leave-one-out
    double mean_residual_m = 0.0;         ///< of the touches that agree
    double worst_residual_m = 0.0;
    double mean_residual_px = 0.0;
    double worst_residual_px = 0.0;
    PictureUncertainty uncertainty; ///< over the zone, one standard deviation
    double hidden_error_m = 0.0;    ///< largest picture error from one wrong touch that goes unnoticed
    PriorShares prior_shares;
    std::optional<BoardsHeight> boards; ///< none if no touch was on boards
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};

/// The picture's error as a clause, for a verdict whose shares are known.
[[nodiscard]] std::string in_words(const PictureUncertainty& uncertainty);
/// Words for one kind of measurement, touches or rests, in a verdict's sentences.
struct MeasuredKind {
    std::string_view one, many;
    std::string_view scattered,
        why_scattered;           ///< the scattered quantity; the last part of a question about the cause
    std::string_view three_more; ///< said if there are too few to check each other
    std::string_view spread;     ///< said if the picture is too uncertain
    std::string_view tilt;       ///< how the prop is placed in three of them
};
/// Sets verdict, reason and `repeat` of a calibration whose residuals are known. `wrong`: names of the
/// measurements to repeat.
void judge(TouchCalibration& calibration, const MeasuredKind& kind, const Agreed& found,
           std::span<const std::string> wrong);
/// Tells how to determine what the points leave undetermined.
[[nodiscard]] VerdictReason in_words(const Undetermined& open, const MeasuredKind& kind);
/// Names the misfits; at least one.
[[nodiscard]] VerdictReason misfits(std::string_view one, std::string_view many,
                                    std::span<const std::string> wrong);
/// Names of rows, numbered from 1.
[[nodiscard]] std::vector<std::string> row_names(std::span<const std::size_t> rows);

[[nodiscard]] TouchCalibration calibrate_touch(std::span<const Touch> touches, const TouchSetup& setup);

} // namespace frustumscreen::calibration
