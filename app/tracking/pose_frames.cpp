#include "app/tracking/pose_frames.h"

#include "app/tracking/level_head.h"

#include <map>

namespace frustumscreen::tracking {

std::vector<TrackedState> pose_frames(std::span<const tracker::PoseSample> samples,
                                      const glm::dvec3& default_eye_m) {
    std::map<MonotonicTime, TrackedState> frames;
    for (const tracker::PoseSample& sample : samples) {
        if (sample.ok && sample.station == tracker::prop_station) {
            TrackedState frame;
            frame.table_from_prop = {sample.rotation, sample.position_m};
            frame.eye_m = default_eye_m;
            frame.table_from_head = level_head(default_eye_m, sample.position_m);
            frame.eyes_apart = 1.0;
            frame.time = sample.time;
            frame.prop_known = true;
            frames.emplace(sample.time, frame);
        }
    }
    for (const tracker::PoseSample& sample : samples) {
        const auto frame = frames.find(sample.time);
        if (sample.ok && sample.station == tracker::head_station && frame != frames.end() &&
            !frame->second.head_known) {
            const std::optional<glm::dquat> turn = geometry::normalised(sample.rotation);
            frame->second.eye_m = sample.position_m;
            frame->second.table_from_head =
                turn.value_or(level_head(sample.position_m, frame->second.table_from_prop.translation));
            frame->second.head_known = true;
        }
        if (sample.ok && sample.station == tracker::torch_station && frame != frames.end() &&
            frame->second.torches[0].share == 0.0) {
            if (const std::optional<glm::dquat> turn = geometry::normalised(sample.rotation)) {
                frame->second.torches[0] = {{*turn, sample.position_m}, 1.0, TorchPresence::InHand};
            }
        }
    }
    std::vector<TrackedState> result;
    result.reserve(frames.size());
    for (const auto& [time, frame] : frames) {
        result.push_back(frame);
    }
    return result;
}

} // namespace frustumscreen::tracking
