#include "app/tags/tag_reader.h"

#include <cmath>
#include <utility>

namespace frustumscreen::tags {

namespace {

/// A slower whole search exceeds the share at 30 frames a second.
constexpr double longest_whole_s = TagReader::max_share / 30.0;
constexpr int frames_at_once = 100; ///< searched at one size
/// One tag far from the camera is less certain than a prop's several, and its light need not lie as exactly.
constexpr double max_lamp_m = 0.02, max_lamp_rad = 0.12;
/// An older pose does not tell the current motion of the prop.
constexpr Nanoseconds oldest_before = std::chrono::milliseconds(200);

Nanoseconds nanoseconds_of(double seconds) {
    return Nanoseconds(std::llround(1e9 * seconds));
}

} // namespace

TagReader::TagReader(TagSetUp set_up, std::function<double()> busy)
    : set_up_(std::move(set_up)), pace_(max_share, std::move(busy)), half_({.decimate = 2.0}) {}

std::optional<tracking::UncertainPose> TagReader::read(const camera::CameraFrame& frame) {
    lamp_.reset();
    if (!pace_.begin(frame.time)) {
        ++counts_.skipped;
        return std::nullopt;
    }
    const std::optional<tracking::UncertainPose> pose = look(frame);
    follow_size(pose.has_value(), pace_.end());
    ++counts_.looked_at;
    counts_.posed += pose ? 1 : 0;
    return pose;
}

void TagReader::follow_size(bool posed, double took_s) {
    if (half_for_ > 0) {
        ++counts_.at_half_size;
        --half_for_;
        if (!posed && whole_posed_) { // its tags are too small for half size
            half_for_ = 0;
            whole_for_ = frames_at_once;
        }
        return;
    }
    whole_posed_ = posed;
    if (whole_for_ > 0) {
        --whole_for_;
    } else if (took_s > longest_whole_s) {
        half_for_ = frames_at_once;
    }
}

void TagReader::look_for_lamp(const geometry::Pinhole& camera, MonotonicTime first_row) {
    if (!set_up_.lamp) {
        return;
    }
    const std::optional<TagPose> pose = pose_from_tags(found_, std::span(&*set_up_.lamp, 1), camera,
                                                       usual_corner_sd_px, {set_up_.readout_s, {}, 0.0});
    if (pose && pose->place_sd_m <= max_lamp_m && pose->turn_sd_rad <= max_lamp_rad) {
        lamp_ = {.time = first_row + nanoseconds_of(pose->moment_s),
                 .table_from_prop = set_up_.table_from_camera * pose->camera_from_prop,
                 .place_sd_m = pose->place_sd_m,
                 .turn_sd_rad = pose->turn_sd_rad};
    }
}

std::optional<tracking::UncertainPose> TagReader::look(const camera::CameraFrame& frame) {
    const geometry::Pinhole& measured = set_up_.camera;
    if (frame.width * measured.height != frame.height * measured.width) {
        ++counts_.misshapen;
        return std::nullopt;
    }
    const geometry::Pinhole camera = measured.scaled_to(frame.width, frame.height);
    (half_for_ > 0 ? half_ : whole_).find(frame.luma, frame.width, frame.height, found_);
    const double readout_s = set_up_.readout_s;
    const MonotonicTime first_row = frame.time - nanoseconds_of(0.5 * readout_s);
    RollingShutter shutter{readout_s, {}, 0.0};
    if (before_ && before_->time < first_row && first_row - before_->time < oldest_before) {
        shutter.before = before_->camera_from_prop;
        shutter.before_s = -to_seconds(first_row - before_->time);
    }
    look_for_lamp(camera, first_row);
    const std::optional<TagPose> pose =
        pose_from_tags(found_, set_up_.tags, camera, usual_corner_sd_px, shutter);
    if (!pose || !is_sure(*pose)) {
        return std::nullopt;
    }
    before_ = Before{pose->camera_from_prop, first_row + nanoseconds_of(pose->moment_s)};
    return tracking::UncertainPose{.time = before_->time,
                                   .table_from_prop = set_up_.table_from_camera * pose->camera_from_prop,
                                   .place_sd_m = pose->place_sd_m,
                                   .turn_sd_rad = pose->turn_sd_rad};
}

} // namespace frustumscreen::tags
