#include "firmware_host/camera/camera_driver.h"

#include "firmware_host/base/result.h"
#include "firmware_host/camera/v4l2_controls.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace frustumscreen::camera {

namespace {

/// The kernel's names end with a 0, unless they fill their field.
template <std::size_t size> std::string text_of(const __u8 (&field)[size]) {
    const char* const text = reinterpret_cast<const char*>(field);
    return {text, ::strnlen(text, size)};
}

struct Identity {
    std::string name, bus;
};
/// nullopt: not a camera; some of the kernel's video devices provide other data.
std::optional<Identity> identity_of(V4l2Device& device) {
    v4l2_capability capability{};
    if (device.ask(VIDIOC_QUERYCAP, capability) != 0) {
        return std::nullopt;
    }
    const std::uint32_t can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                                                    : capability.capabilities;
    constexpr std::uint32_t needed = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    if ((can & needed) != needed) {
        return std::nullopt;
    }
    return Identity{text_of(capability.card), text_of(capability.bus_info)};
}

CameraState state_of_open(int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return CameraState::NoPermission;
    case EBUSY:
        return CameraState::InUse;
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return CameraState::NotConnected;
    default:
        return CameraState::CannotBeOpened;
    }
}

/// Whether the picture may change by itself. A camera without white balance may be monochrome and does not
/// count.
bool changes_by_itself(const CameraSetUp& set_up) {
    return std::any_of(set_up.controls.begin(), set_up.controls.end(), [](const LockedControl& control) {
        return control.lock == Lock::Refused ||
               (control.lock == Lock::NotThere && control.name == "exposure");
    });
}

CameraState state_of_verdict(FrameVerdict verdict, const CameraSetUp& set_up) {
    switch (verdict) {
    case FrameVerdict::Slow:
        return CameraState::Slow;
    case FrameVerdict::Dark:
        return CameraState::Dark;
    case FrameVerdict::Blinded:
        return CameraState::Blinded;
    case FrameVerdict::Frozen:
        return CameraState::Frozen;
    case FrameVerdict::Silent:
        return CameraState::Silent;
    case FrameVerdict::Well:
        break;
    }
    return changes_by_itself(set_up) ? CameraState::Unlocked : CameraState::Running;
}

} // namespace

std::vector<FoundCamera> list_cameras(V4l2Devices& devices, const CameraRequest& request) {
    std::vector<FoundCamera> found;
    for (const std::string& path : devices.list()) {
        const auto device = devices.open(path);
        if (!device) {
            continue;
        }
        if (const std::optional<Identity> identity = identity_of(**device)) {
            found.push_back({.path = path,
                             .name = identity->name,
                             .bus = identity->bus,
                             .modes = list_modes(**device, request)});
        }
    }
    return found;
}

CameraDriver::CameraDriver(std::unique_ptr<V4l2Devices> devices, CameraRequest request, Clock clock,
                           FrameUse use, CpuThrottle share)
    : devices_(std::move(devices)), request_(std::move(request)), clock_(std::move(clock)),
      use_(std::move(use)), pace_(std::move(share)) {}

double CameraDriver::rate_hz() {
    return judge_ ? judge_->rate_hz(clock_()) : 0.0;
}

tl::expected<void, CameraState> CameraDriver::open(const std::string& path) {
    tl::expected<std::unique_ptr<V4l2Device>, int> device = devices_->open(path);
    if (!device) {
        return tl::unexpected(state_of_open(device.error()));
    }
    const bool is_path = request_.device.find('/') != std::string::npos;
    const std::optional<Identity> identity = identity_of(**device);
    if (!identity || (!is_path && request_.device != "any" && request_.device != identity->name)) {
        return tl::unexpected(CameraState::NotConnected);
    }
    const std::optional<CameraMode> mode = choose_mode(list_modes(**device, request_), request_);
    if (!mode) {
        return tl::unexpected(CameraState::NoFormat);
    }
    TRY(const SetMode set, set_mode(**device, *mode));
    const FrameFormat& frame = set.frame;
    CameraSetUp set_up{.path = path,
                       .name = identity->name,
                       .bus = identity->bus,
                       .mode = {frame.format, frame.width, frame.height, set.rate_hz},
                       .controls = lock_controls(**device, request_)};
    TRY(stream_, V4l2Stream::start(std::move(*device), frame));
    set_up_ = std::move(set_up);
    path_ = path;
    return {};
}

Nanoseconds CameraDriver::search() {
    std::vector<std::string> paths =
        request_.device.find('/') != std::string::npos ? std::vector{request_.device} : devices_->list();
    std::stable_partition(paths.begin(), paths.end(),
                          [this](const std::string& path) { return path != failed_; });
    CameraState trouble = CameraState::NotConnected;
    for (const std::string& path : paths) {
        const tl::expected<void, CameraState> opened = open(path);
        if (opened) {
            ++counts_.connections;
            heard_ = clock_();
            has_sent_ = false;
            broken_before_ = counts_.broken;
            // If the driver does not report its rate, the requested rate applies.
            judge_.emplace(set_up_->mode.rate_hz > 0.0 ? set_up_->mode.rate_hz : request_.rate_hz, heard_);
            // Until the first frame, a previous fault tells more than SettingUp.
            state_ = state_ == CameraState::Silent || state_ == CameraState::Broken ? state_
                                                                                    : CameraState::SettingUp;
            return Nanoseconds(0);
        }
        trouble = trouble == CameraState::NotConnected ? opened.error() : trouble;
    }
    state_ = trouble;
    return between_searches;
}

Nanoseconds CameraDriver::lose(CameraState state) {
    state_ = state;
    failed_ = path_;
    stream_.reset();
    judge_.reset();
    return between_searches;
}

void CameraDriver::judge(MonotonicTime now) {
    const FrameVerdict verdict = judge_->verdict(now);
    if (verdict == FrameVerdict::Silent && counts_.broken > broken_before_) {
        state_ = CameraState::Broken;
    } else if (verdict != FrameVerdict::Well || has_sent_) {
        state_ = state_of_verdict(verdict, *set_up_);
    }
}

CameraDriver::Step CameraDriver::step(CameraFrame& frame) {
    if (!stream_) {
        return {false, search()};
    }
    const std::uint64_t overtaken_before = counts_.overtaken;
    const V4l2Stream::Taken taken = stream_->take(frame_timeout, clock_, pace_, frame, counts_);
    if (taken == V4l2Stream::Taken::Lost) {
        return {false, lose(CameraState::NotConnected)};
    }
    const MonotonicTime now = clock_();
    const std::uint64_t overtaken = counts_.overtaken - overtaken_before;
    const bool fresh = taken == V4l2Stream::Taken::Frame;
    if (fresh) {
        judge_->see(now, look_at(frame.luma), overtaken);
        heard_ = now;
        has_sent_ = true;
        broken_before_ = counts_.broken;
        if (use_) {
            use_(frame);
        }
        static_cast<void>(pace_.end());
    } else if (taken == V4l2Stream::Taken::Skipped) {
        judge_->hear(now, 1 + overtaken);
        heard_ = now;
    }
    judge(now);
    if (health_of(state_) == CameraHealth::Away && now - heard_ >= max_silence) {
        return {false, lose(state_)};
    }
    return {fresh, Nanoseconds(0)};
}

} // namespace frustumscreen::camera
