#include "firmware_host/camera/v4l2_mode.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace frustumscreen::camera {

namespace {

/// Larger than any real camera's lists; a device with false descriptors may claim many more.
constexpr std::uint32_t max_formats = 64, max_sizes = 128, max_rates = 64;
constexpr int longest_side = 8192;
/// 29.97 Hz counts as 30 Hz.
constexpr double near_enough = 0.99;

std::optional<PixelFormat> format_of(std::uint32_t fourcc) {
    switch (fourcc) {
    case V4L2_PIX_FMT_GREY:
        return PixelFormat::Grey;
    case V4L2_PIX_FMT_YUYV:
        return PixelFormat::Yuyv;
    case V4L2_PIX_FMT_MJPEG:
    case V4L2_PIX_FMT_JPEG:
        return PixelFormat::Mjpeg;
    default:
        return std::nullopt;
    }
}

std::uint32_t fourcc_of(PixelFormat format) {
    return format == PixelFormat::Grey   ? V4L2_PIX_FMT_GREY
           : format == PixelFormat::Yuyv ? V4L2_PIX_FMT_YUYV
                                         : V4L2_PIX_FMT_MJPEG;
}

double hertz(const v4l2_fract& interval) {
    return interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator : 0.0;
}

/// The value in the range that is nearest to `requested`.
int in_range(int requested, std::uint32_t least, std::uint32_t most, std::uint32_t step) {
    const std::int64_t unit = std::max<std::int64_t>(step, 1);
    const std::int64_t inside = std::clamp<std::int64_t>(requested, least, std::max(least, most));
    return static_cast<int>(least + (inside - least) / unit * unit);
}

void list_rates(V4l2Device& device, std::uint32_t fourcc, CameraMode mode, double requested_hz,
                std::vector<CameraMode>& modes) {
    v4l2_frmivalenum rate{};
    rate.pixel_format = fourcc;
    rate.width = static_cast<std::uint32_t>(mode.width);
    rate.height = static_cast<std::uint32_t>(mode.height);
    for (; rate.index < max_rates && device.ask(VIDIOC_ENUM_FRAMEINTERVALS, rate) == 0; ++rate.index) {
        if (rate.type != V4L2_FRMIVAL_TYPE_DISCRETE) {
            const double slowest = hertz(rate.stepwise.max);
            mode.rate_hz = std::clamp(requested_hz, slowest, std::max(slowest, hertz(rate.stepwise.min)));
            modes.push_back(mode);
            return;
        }
        mode.rate_hz = hertz(rate.discrete);
        modes.push_back(mode);
    }
    if (rate.index == 0) { // a camera with one rate need not list it
        modes.push_back(mode);
    }
}

void list_sizes(V4l2Device& device, std::uint32_t fourcc, PixelFormat format, const CameraRequest& request,
                std::vector<CameraMode>& modes) {
    const auto add = [&](std::int64_t width, std::int64_t height) {
        if (width > 0 && height > 0 && width <= longest_side && height <= longest_side) {
            list_rates(device, fourcc,
                       {.format = format,
                        .width = static_cast<int>(width),
                        .height = static_cast<int>(height),
                        .rate_hz = 0.0},
                       request.rate_hz, modes);
        }
    };
    v4l2_frmsizeenum size{};
    size.pixel_format = fourcc;
    for (; size.index < max_sizes && device.ask(VIDIOC_ENUM_FRAMESIZES, size) == 0; ++size.index) {
        if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) {
            const v4l2_frmsize_stepwise& range = size.stepwise;
            add(in_range(request.width, range.min_width, range.max_width, range.step_width),
                in_range(request.height, range.min_height, range.max_height, range.step_height));
            return;
        }
        add(size.discrete.width, size.discrete.height);
    }
    if (size.index == 0) { // the driver lists no sizes; it may accept the requested one
        add(request.width, request.height);
    }
}

} // namespace

std::vector<CameraMode> list_modes(V4l2Device& device, const CameraRequest& request) {
    std::vector<CameraMode> modes;
    v4l2_fmtdesc description{};
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    for (; description.index < max_formats && device.ask(VIDIOC_ENUM_FMT, description) == 0;
         ++description.index) {
        if (const std::optional<PixelFormat> format = format_of(description.pixelformat)) {
            list_sizes(device, description.pixelformat, *format, request, modes);
        }
    }
    return modes;
}

std::optional<CameraMode> choose_mode(std::span<const CameraMode> modes, const CameraRequest& request) {
    const auto badness = [&request](const CameraMode& mode) {
        const int off = std::abs(mode.width - request.width) + std::abs(mode.height - request.height);
        const double reached = std::fmin(mode.rate_hz / request.rate_hz, 1.0);
        const double missing = reached >= near_enough ? 0.0 : 1.0 - reached;
        // Among sufficient rates, the nearest to the request: more light for each frame, fewer bytes to
        // transfer.
        const double beyond = std::fabs(mode.rate_hz - request.rate_hz);
        return std::tuple(off, missing, mode.format, beyond);
    };
    const auto best =
        std::min_element(modes.begin(), modes.end(),
                         [&](const CameraMode& a, const CameraMode& b) { return badness(a) < badness(b); });
    return best != modes.end() ? std::optional(*best) : std::nullopt;
}

tl::expected<SetMode, CameraState> set_mode(V4l2Device& device, const CameraMode& mode) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    v4l2_pix_format& pixels = format.fmt.pix;
    pixels.width = static_cast<std::uint32_t>(mode.width);
    pixels.height = static_cast<std::uint32_t>(mode.height);
    pixels.pixelformat = fourcc_of(mode.format);
    pixels.field = V4L2_FIELD_NONE;
    if (const int error = device.ask(VIDIOC_S_FMT, format); error != 0) {
        return tl::unexpected(error == EBUSY ? CameraState::InUse : CameraState::SetUpRefused);
    }
    const std::optional<PixelFormat> taken = format_of(pixels.pixelformat);
    if (!taken || pixels.width == 0 || pixels.height == 0 || pixels.width > longest_side ||
        pixels.height > longest_side) {
        return tl::unexpected(taken ? CameraState::SetUpRefused : CameraState::NoFormat);
    }
    v4l2_streamparm parameters{};
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (mode.rate_hz > 0.0) {
        constexpr double thousand = 1000.0;
        parameters.parm.capture.timeperframe = {
            1000, static_cast<std::uint32_t>(std::lround(thousand * mode.rate_hz))};
        // A camera without an adjustable rate still has a rate; it is read next.
        static_cast<void>(device.ask(VIDIOC_S_PARM, parameters));
    }
    const bool says = device.ask(VIDIOC_G_PARM, parameters) == 0;
    SetMode set;
    set.frame = {.format = *taken,
                 .width = static_cast<int>(pixels.width),
                 .height = static_cast<int>(pixels.height),
                 .row_bytes = pixels.bytesperline};
    set.rate_hz = says ? hertz(parameters.parm.capture.timeperframe) : 0.0;
    return set;
}

} // namespace frustumscreen::camera
