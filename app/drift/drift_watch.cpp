#include "app/drift/drift_watch.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/format_sentence.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::drift {

namespace {

/// Search radius around a mark's last place, as a share of the frame's width: some 15 cm on a table.
constexpr double window_share = 0.125;

DriftReference blank_of(const DriftSetUp& set_up) {
    DriftReference blank;
    blank.marks_m = set_up.marks_m;
    blank.marks_px.resize(set_up.marks_m.size());
    return blank;
}

std::optional<DriftReference> stored(const DriftSetUp& set_up) {
    std::error_code none;
    if (!std::filesystem::exists(set_up.file, none)) {
        return std::nullopt;
    }
    const Result<Bytes> bytes = read_file(set_up.file);
    Result<DriftReference> read = bytes ? parse_drift_reference(as_text(*bytes), set_up.file.string())
                                        : Result<DriftReference>(tl::unexpected<Error>(bytes.error()));
    if (!read) {
        say_line("frustumscreen", read.error().message);
        return std::nullopt;
    }
    return read->fits(set_up.marks_m) ? std::optional(*std::move(read)) : std::nullopt;
}

} // namespace

Sentence sentence_of(const DriftVerdict& verdict) {
    switch (verdict.state) {
    case DriftState::Learning:
        return Sentence("the camera records where the calibrated picture lies, while no visitor is present");
    case DriftState::Looking:
        return Sentence("the camera checks whether the picture still lies where it was calibrated, while no "
                        "visitor is present");
    case DriftState::Well:
        return format_sentence("the picture lies where it was calibrated, to {:.1f} mm", 1e3 * verdict.off_m);
    case DriftState::Moved:
        return verdict.anchored
                   ? format_sentence(
                         "the picture lies {:.0f} mm beside where it was calibrated; hold the first "
                         "and the last button, twice, and put it right",
                         1e3 * verdict.off_m)
                   : format_sentence(
                         "the picture or the camera moved by {:.0f} mm since the calibration; hold "
                         "the first and the last button, twice: the touch-up tells which",
                         1e3 * verdict.off_m);
    case DriftState::Blind:
        return Sentence(
            "the camera does not see the marks that tell whether the picture has moved; clear the table, "
            "and see that the camera looks at the whole picture");
    }
    return {};
}

DriftWatch::DriftWatch(DriftSetUp set_up)
    : set_up_(std::move(set_up)), schedule_(set_up_.marks_m.size()), check_(blank_of(set_up_)) {
    if (std::optional<DriftReference> reference = stored(set_up_)) {
        check_.know(*std::move(reference));
    }
    told_ = verdict_ = check_.verdict();
    set_.marks_px.resize(set_up_.marks_m.size());
}

std::optional<ShownMark> DriftWatch::step(MonotonicTime now, bool quiet) {
    const std::optional<MarkSchedule::Mark> mark = schedule_.step(now, quiet);
    const std::optional<MonotonicTime>& began = schedule_.began();
    began_ns_ = began ? began->time_since_epoch().count() : 0;
    return mark ? std::optional(ShownMark{set_up_.marks_m[mark->mark], mark->brightness}) : std::nullopt;
}

const DriftVerdict& DriftWatch::verdict() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) {
        told_ = verdict_;
    }
    return told_;
}

void DriftWatch::use(const camera::CameraFrame& frame) {
    const std::int64_t began_ns = began_ns_;
    if (began_ns != follows_ns_) { // another set, or the set was cancelled
        follows_ns_ = began_ns;
        ended_ = began_ns == 0;
        mark_.reset();
        std::fill(set_.marks_px.begin(), set_.marks_px.end(), std::nullopt);
    }
    if (!ended_) {
        follow(frame, frame.time.time_since_epoch() - Nanoseconds(began_ns));
    }
}

void DriftWatch::follow(const camera::CameraFrame& frame, Nanoseconds since_begin) {
    if (since_begin >= MarkTimes::length(set_up_.marks_m.size())) {
        find_mark();
        end_set(frame.time);
        ended_ = true;
        return;
    }
    const std::optional<MarkTimes::Moment> moment = MarkTimes::moment(since_begin, set_up_.marks_m.size());
    if (!moment) {
        return;
    }
    if (!mark_) {
        follow_size(frame);
    }
    if (mark_ != moment->mark) {
        find_mark();
        const bool follows = mark_ && *mark_ + 1 == moment->mark;
        follows ? finder_.begin_after_mark() : finder_.begin();
        mark_ = moment->mark;
    }
    finder_.add(moment->phase, frame.luma, frame.width, frame.height);
}

void DriftWatch::find_mark() {
    if (mark_) {
        const std::optional<FoundMark> found = finder_.find(window_of(*mark_));
        set_.marks_px[*mark_] = found ? std::optional(found->pixel) : std::nullopt;
    }
}

std::optional<PixelWindow> DriftWatch::window_of(std::size_t mark) const {
    const DriftReference& reference = check_.reference();
    if (!check_.knows() || !reference.marks_px[mark]) {
        return std::nullopt;
    }
    const int around = static_cast<int>(window_share * reference.width);
    const glm::ivec2 middle(*reference.marks_px[mark]);
    return PixelWindow{middle - around, middle + around};
}

void DriftWatch::find_anchors(MarkSet& set) {
    set.anchors.clear();
    finder_.dark_picture(dark_);
    tags_.find(dark_, finder_.width(), finder_.height(), found_tags_);
    for (const tags::FoundTag& tag : found_tags_) {
        const auto is_same = [&](const tags::FoundTag& other) { return other.id == tag.id; };
        const bool moves = std::find(set_up_.moving_tags.begin(), set_up_.moving_tags.end(), tag.id) !=
                           set_up_.moving_tags.end();
        if (!moves && std::count_if(found_tags_.begin(), found_tags_.end(), is_same) == 1) {
            set.anchors.push_back({tag.id, tag.corners_px});
        }
    }
}

void DriftWatch::keep_reference() {
    DriftReference reference = check_.reference();
    reference.width = finder_.width();
    reference.height = finder_.height();
    if (const Result<void> written = write_file(set_up_.file, as_bytes(drift_reference_text(reference)));
        !written) {
        say_line("frustumscreen", written.error().message);
    }
    check_.know(std::move(reference));
}

/// A change of the frame's size means that the camera was set up again, so old pixels are invalid.
void DriftWatch::follow_size(const camera::CameraFrame& frame) {
    const DriftReference& reference = check_.reference();
    if (check_.knows() && (frame.width != reference.width || frame.height != reference.height)) {
        check_ = DriftCheck(blank_of(set_up_));
    }
}

void DriftWatch::end_set(MonotonicTime time) {
    set_.time = time;
    find_anchors(set_);
    if (check_.take(set_)) {
        keep_reference();
    }
    const std::lock_guard lock(mutex_);
    verdict_ = check_.verdict();
}

} // namespace frustumscreen::drift
