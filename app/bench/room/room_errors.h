/// The error of a technique's pictures against the truth, in some frames of each walk.
///
/// Error    as measure.h has it, of one ray through each pixel's centre: the mean distance of the two points,
///          millimetres, over the pixels hit in both. In a hall this includes the jumps at outlines: a pixel that
///          shows the wall instead of a vase in front of it counts the metres between them.
/// Threads  that of the set; the set must outlive it.
/// Errors   as RoomTruth; a driver that cannot draw into float pictures.
#pragma once

#include "app/bench/measures/measure.h"
#include "app/bench/room/room_techniques.h"
#include "app/bench/room/room_truth.h"
#include "app/render/hit_points.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::bench {

struct RoomError {
    double mean_mm = 0.0; ///< means over the frames
    double p95_mm = 0.0;
    double silhouette_percent = 0.0; ///< pixels that hit something in one of the two pictures alone
    double ms = 0.0;                 ///< processor time of a frame, the median
};

class RoomErrors {
public:
    /// `count`: frames of each walk, evenly spread.
    [[nodiscard]] static Result<std::unique_ptr<RoomErrors>>
    create(RoomSet& set, RoomTruth& truth, std::span<const RoomWalk> walks, int count,
           const std::function<void(double done)>& progress);

    /// `every_frame`: draws the frames between too, for a technique that depends on the pictures before.
    [[nodiscard]] Result<RoomError> measure(RoomTechnique& technique, bool every_frame);

private:
    struct Sample {
        std::size_t walk = 0, frame = 0;
        TruthPicture truth;
    };
    explicit RoomErrors(std::span<const RoomWalk> walks) : walks_(walks) {}

    std::span<const RoomWalk> walks_;
    std::vector<Sample> samples_;
    Drawn drawn_;
};

} // namespace frustumscreen::bench
