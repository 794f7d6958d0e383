#include "firmware_host/camera/v4l2_stream.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>

namespace frustumscreen::camera {

namespace {

/// An older time stamp is from another clock.
constexpr Nanoseconds oldest_stamp = std::chrono::seconds(1);

v4l2_buffer buffer_number(std::uint32_t index) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
}

MonotonicTime time_of(const v4l2_buffer& buffer, MonotonicTime now) {
    const MonotonicTime stamp(std::chrono::seconds(buffer.timestamp.tv_sec) +
                              std::chrono::microseconds(buffer.timestamp.tv_usec));
    const bool monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    return monotonic && stamp <= now && stamp >= now - oldest_stamp ? stamp : now;
}

} // namespace

bool V4l2Stream::map_buffers() {
    v4l2_requestbuffers request{};
    request.count = requested_buffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    if (device_->ask(VIDIOC_REQBUFS, request) != 0 || request.count == 0) {
        return false;
    }
    for (std::uint32_t index = 0; index < request.count; ++index) {
        v4l2_buffer buffer = buffer_number(index);
        if (device_->ask(VIDIOC_QUERYBUF, buffer) != 0) {
            return false;
        }
        const auto memory = device_->map(buffer.m.offset, buffer.length);
        if (!memory || device_->ask(VIDIOC_QBUF, buffer) != 0) {
            return false;
        }
        buffers_.push_back(*memory);
    }
    return true;
}

tl::expected<std::unique_ptr<V4l2Stream>, CameraState> V4l2Stream::start(std::unique_ptr<V4l2Device> device,
                                                                         const FrameFormat& format) {
    std::unique_ptr<V4l2Stream> stream(new V4l2Stream(std::move(device), format));
    if (!stream->map_buffers()) {
        return tl::unexpected(CameraState::SetUpRefused);
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (const int error = stream->device_->ask(VIDIOC_STREAMON, type); error != 0) {
        return tl::unexpected(error == EBUSY ? CameraState::InUse : CameraState::SetUpRefused);
    }
    stream->streams_ = true;
    return stream;
}

V4l2Stream::~V4l2Stream() {
    if (streams_) {
        int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        static_cast<void>(device_->ask(VIDIOC_STREAMOFF, type)); // the camera may be unplugged
    }
}

V4l2Stream::Taken V4l2Stream::take(Nanoseconds timeout, const std::function<MonotonicTime()>& now,
                                   CpuThrottle& pace, CameraFrame& frame, CameraCounts& counts) {
    const int waited = device_->wait(timeout);
    if (waited == EAGAIN) {
        return Taken::Nothing;
    }
    std::optional<v4l2_buffer> latest;
    int error = waited;
    // At most one round over the buffers: a camera that is faster than its reader would keep the loop
    // running.
    for (std::size_t k = 0; error == 0 && k < buffers_.size(); ++k) {
        v4l2_buffer buffer = buffer_number(0);
        error = device_->ask(VIDIOC_DQBUF, buffer);
        if (error != 0) {
            break;
        }
        if (buffer.index >= buffers_.size()) {
            return Taken::Lost;
        }
        if (last_sequence_ && buffer.sequence > *last_sequence_) {
            counts.lost += buffer.sequence - *last_sequence_ - 1;
        }
        last_sequence_ = buffer.sequence;
        if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0) {
            ++counts.broken;
            error = device_->ask(VIDIOC_QBUF, buffer);
            continue;
        }
        if (latest) {
            ++counts.overtaken;
            error = device_->ask(VIDIOC_QBUF, *latest);
        }
        latest = buffer;
    }
    if (error != 0 && error != EAGAIN) {
        return Taken::Lost; // ENODEV: unplugged
    }
    if (!latest) {
        return Taken::Nothing;
    }
    const MonotonicTime time = time_of(*latest, now());
    if (!pace.begin(time)) {
        ++counts.skipped;
        return device_->ask(VIDIOC_QBUF, *latest) == 0 ? Taken::Skipped : Taken::Lost;
    }
    const std::span<const std::byte> memory = buffers_[latest->index];
    const bool whole = reader_.read(
        format_, memory.first(std::min<std::size_t>(latest->bytesused, memory.size())), frame.luma);
    if (device_->ask(VIDIOC_QBUF, *latest) != 0) {
        return Taken::Lost;
    }
    if (!whole) {
        static_cast<void>(pace.end());
        ++counts.broken;
        return Taken::Nothing;
    }
    frame.time = time;
    frame.number = ++counts.frames;
    frame.width = format_.width;
    frame.height = format_.height;
    return Taken::Frame;
}

} // namespace frustumscreen::camera
