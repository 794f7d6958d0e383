#include "tests/camera/fake_v4l2.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <thread>

namespace frustumscreen::camera {

namespace {

constexpr std::size_t offset_of_buffer = 1U << 20U;

class FakeDevice final : public V4l2Device {
public:
    explicit FakeDevice(FakeCamera& camera) : camera_(camera) {}
    FakeDevice(const FakeDevice&) = delete;
    FakeDevice& operator=(const FakeDevice&) = delete;
    ~FakeDevice() override {
        camera_.streams -= streams_ ? 1 : 0;
        camera_.unmapped += static_cast<int>(mapped_);
    }

    [[nodiscard]] int control(unsigned long request, void* argument) override;
    [[nodiscard]] int wait(Nanoseconds timeout) override;
    [[nodiscard]] tl::expected<std::span<const std::byte>, int> map(std::size_t offset,
                                                                    std::size_t size) override {
        const std::size_t index = offset / offset_of_buffer;
        if (index >= memory_.size() || size != memory_[index].size()) {
            return tl::unexpected(EINVAL);
        }
        ++mapped_;
        return std::as_bytes(std::span(memory_[index]));
    }

private:
    [[nodiscard]] const FakeFormat* format(std::uint32_t fourcc) const {
        const auto found = std::find_if(camera_.formats.begin(), camera_.formats.end(),
                                        [fourcc](const FakeFormat& f) { return f.fourcc == fourcc; });
        return found != camera_.formats.end() ? &*found : nullptr;
    }
    int enumerate_format(v4l2_fmtdesc& description) const {
        if (description.index >= camera_.formats.size()) {
            return EINVAL;
        }
        description.pixelformat = camera_.formats[description.index].fourcc;
        return 0;
    }
    int enumerate_size(v4l2_frmsizeenum& size) const {
        const FakeFormat* const found = format(size.pixel_format);
        if (found == nullptr || size.index >= found->sizes.size()) {
            return EINVAL;
        }
        size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        size.discrete = {found->sizes[size.index].width, found->sizes[size.index].height};
        return 0;
    }
    int enumerate_rate(v4l2_frmivalenum& rate) const {
        const FakeFormat* const found = format(rate.pixel_format);
        for (const FakeSize& size : found != nullptr ? found->sizes : std::vector<FakeSize>()) {
            if (size.width == rate.width && size.height == rate.height && rate.index < size.rates_hz.size()) {
                rate.type = V4L2_FRMIVAL_TYPE_DISCRETE;
                rate.discrete = {1, size.rates_hz[rate.index]};
                return 0;
            }
        }
        return EINVAL;
    }
    /// Like uvcvideo: unsupported values are replaced by the nearest ones.
    int set_format(v4l2_pix_format& pixels) {
        if (camera_.format_error != 0 || !memory_.empty()) {
            return camera_.format_error != 0 ? camera_.format_error.load() : EBUSY;
        }
        const FakeFormat* found = format(pixels.pixelformat);
        found = found != nullptr ? found : &camera_.formats.front();
        const auto off = [&pixels](const FakeSize& size) {
            return std::abs(static_cast<int>(size.width) - static_cast<int>(pixels.width)) +
                   std::abs(static_cast<int>(size.height) - static_cast<int>(pixels.height));
        };
        const FakeSize& nearest =
            *std::min_element(found->sizes.begin(), found->sizes.end(),
                              [&off](const FakeSize& a, const FakeSize& b) { return off(a) < off(b); });
        pixels.pixelformat = found->fourcc;
        pixels.width = nearest.width;
        pixels.height = nearest.height;
        const std::uint32_t bytes_each = found->fourcc == V4L2_PIX_FMT_YUYV ? 2 : 1;
        pixels.bytesperline =
            found->fourcc == V4L2_PIX_FMT_MJPEG ? 0 : bytes_each * nearest.width + camera_.row_padding;
        pixels.sizeimage = (2 * nearest.width + camera_.row_padding) * nearest.height + 4096;
        size_ = nearest;
        buffer_bytes_ = pixels.sizeimage;
        return 0;
    }
    int set_rate(v4l2_captureparm& capture) {
        const double wished = static_cast<double>(capture.timeperframe.denominator) /
                              std::max(1U, capture.timeperframe.numerator);
        const auto& rates = size_.rates_hz;
        const auto nearest = std::min_element(rates.begin(), rates.end(), [&](auto a, auto b) {
            return std::fabs(a - wished) < std::fabs(b - wished);
        });
        rate_hz_ = nearest != rates.end() ? *nearest : 0;
        return say_rate(capture);
    }
    int say_rate(v4l2_captureparm& capture) const {
        if (rate_hz_ == 0) {
            return ENOTTY;
        }
        capture.timeperframe = {1, rate_hz_};
        return 0;
    }
    int set_control(v4l2_control& control) const {
        const auto found = camera_.controls.find(control.id);
        if (found == camera_.controls.end()) {
            return EINVAL;
        }
        FakeControl& kept = found->second;
        kept.value = kept.stubborn ? kept.value : std::clamp(control.value, kept.least, kept.most);
        return 0;
    }
    int get_control(v4l2_control& control) const {
        const auto found = camera_.controls.find(control.id);
        if (found == camera_.controls.end()) {
            return EINVAL;
        }
        control.value = found->second.value;
        return 0;
    }
    int dequeue(v4l2_buffer& buffer) {
        if (!ready_) {
            return EAGAIN;
        }
        ready_ = false;
        const std::uint32_t index = queued_.front();
        queued_.pop_front();
        const Picture bytes = camera_.picture(number_);
        Picture& memory = memory_[index];
        const std::size_t used = std::min(bytes.size(), memory.size());
        std::copy_n(bytes.begin(), used, memory.begin());
        buffer.index = index;
        buffer.bytesused = static_cast<std::uint32_t>(used);
        buffer.sequence = static_cast<std::uint32_t>(number_++);
        const auto us = to_microseconds(sent_);
        buffer.timestamp = {us / 1'000'000, us % 1'000'000};
        buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | (camera_.marks_broken ? V4L2_BUF_FLAG_ERROR : 0U);
        return 0;
    }

    FakeCamera& camera_;
    FakeSize size_{};
    std::uint32_t buffer_bytes_ = 0;
    std::uint32_t rate_hz_ = 0;
    std::vector<Picture> memory_;
    std::deque<std::uint32_t> queued_;
    std::size_t mapped_ = 0;
    bool streams_ = false;
    bool ready_ = false;
    MonotonicTime sent_;
    std::uint64_t number_ = 0;
};

int FakeDevice::control(unsigned long request, void* argument) {
    const std::lock_guard lock(camera_.mutex);
    if (!camera_.plugged) {
        return ENODEV;
    }
    switch (request) {
    case VIDIOC_QUERYCAP: {
        auto& capability = *static_cast<v4l2_capability*>(argument);
        capability.capabilities = V4L2_CAP_DEVICE_CAPS;
        capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        std::copy_n(camera_.name.begin(), std::min(camera_.name.size(), sizeof capability.card),
                    capability.card);
        return 0;
    }
    case VIDIOC_ENUM_FMT:
        return enumerate_format(*static_cast<v4l2_fmtdesc*>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
        return enumerate_size(*static_cast<v4l2_frmsizeenum*>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
        return enumerate_rate(*static_cast<v4l2_frmivalenum*>(argument));
    case VIDIOC_S_FMT:
        return set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
    case VIDIOC_S_PARM:
        return set_rate(static_cast<v4l2_streamparm*>(argument)->parm.capture);
    case VIDIOC_G_PARM:
        return say_rate(static_cast<v4l2_streamparm*>(argument)->parm.capture);
    case VIDIOC_QUERYCTRL:
        return camera_.controls.contains(static_cast<v4l2_queryctrl*>(argument)->id) ? 0 : EINVAL;
    case VIDIOC_S_CTRL:
        return set_control(*static_cast<v4l2_control*>(argument));
    case VIDIOC_G_CTRL:
        return get_control(*static_cast<v4l2_control*>(argument));
    case VIDIOC_REQBUFS:
        memory_.assign(static_cast<v4l2_requestbuffers*>(argument)->count, Picture(buffer_bytes_));
        return 0;
    case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = buffer_bytes_;
        buffer.m.offset = static_cast<std::uint32_t>(buffer.index * offset_of_buffer);
        return 0;
    }
    case VIDIOC_QBUF: {
        const std::uint32_t index = static_cast<v4l2_buffer*>(argument)->index;
        if (index >= memory_.size() || std::find(queued_.begin(), queued_.end(), index) != queued_.end()) {
            return EINVAL;
        }
        queued_.push_back(index);
        return 0;
    }
    case VIDIOC_DQBUF:
        return streams_ ? dequeue(*static_cast<v4l2_buffer*>(argument)) : EINVAL;
    case VIDIOC_STREAMON:
        if (camera_.start_error != 0) {
            return camera_.start_error;
        }
        streams_ = true;
        sent_ = camera_.clock();
        ++camera_.started;
        ++camera_.streams;
        return 0;
    case VIDIOC_STREAMOFF:
        camera_.streams -= streams_ ? 1 : 0;
        streams_ = false;
        return 0;
    default:
        return ENOTTY;
    }
}

int FakeDevice::wait(Nanoseconds timeout) {
    const auto rest = [this](Nanoseconds time) {
        if (camera_.real_time) {
            std::this_thread::sleep_for(time);
        } else {
            *camera_.now += time;
        }
    };
    const double interval_s = camera_.slower / std::max(1U, rate_hz_);
    const MonotonicTime due =
        sent_ + std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(interval_s));
    const MonotonicTime now = camera_.clock();
    if (!camera_.plugged) {
        return 0; // like poll: an error can be read
    }
    if (!camera_.sends || !streams_ || queued_.empty() || due > now + timeout) {
        rest(timeout);
        return EAGAIN;
    }
    rest(std::max(Nanoseconds(0), Nanoseconds(due - now)));
    sent_ = std::max(due, now);
    number_ += camera_.skips.exchange(0);
    ready_ = true;
    return 0;
}

} // namespace

std::vector<std::string> FakeDevices::list() {
    std::vector<std::string> paths;
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
        if (cameras_[k]->plugged) {
            paths.push_back("/dev/video" + std::to_string(k));
        }
    }
    return paths;
}

tl::expected<std::unique_ptr<V4l2Device>, int> FakeDevices::open(const std::string& path) {
    for (std::size_t k = 0; k < cameras_.size(); ++k) {
        FakeCamera& camera = *cameras_[k];
        if (path == "/dev/video" + std::to_string(k) && camera.plugged) {
            if (camera.open_error != 0) {
                return tl::unexpected(camera.open_error.load());
            }
            ++camera.opened;
            return std::make_unique<FakeDevice>(camera);
        }
    }
    return tl::unexpected(ENOENT);
}

void make_usual(FakeCamera& camera) {
    const std::vector<FakeSize> sizes{{64, 48, {30, 15}}};
    camera.formats = {{V4L2_PIX_FMT_GREY, sizes}, {V4L2_PIX_FMT_YUYV, sizes}};
    camera.controls = {{V4L2_CID_EXPOSURE_AUTO, {V4L2_EXPOSURE_APERTURE_PRIORITY, 0, 3}},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, {333, 1, 10000}},
                       {V4L2_CID_GAIN, {16, 0, 255}},
                       {V4L2_CID_AUTO_WHITE_BALANCE, {1, 0, 1}},
                       {V4L2_CID_WHITE_BALANCE_TEMPERATURE, {4600, 2800, 6500}}};
    camera.picture = [](std::uint64_t number) { return noisy_ramp(64, 48, number); };
}

Picture noisy_ramp(int width, int height, std::uint64_t number, int bytes_each) {
    Picture picture;
    std::uint64_t seed = 2 * number + 1;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL; // Knuth, MMIX
            const int noise = static_cast<int>(seed >> 62U);
            picture.push_back(static_cast<std::uint8_t>(40 + 160 * x / width + noise));
            picture.insert(picture.end(), static_cast<std::size_t>(bytes_each - 1), 128);
        }
    }
    return picture;
}

} // namespace frustumscreen::camera
