#include "firmware_host/camera/frame_health.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace frustumscreen::camera {

namespace {

constexpr int dark_code = 48;     ///< black is 16 in video range; noise and stray light add to it
constexpr int no_contrast = 24;   ///< codes between the darkest and the brightest hundredth
constexpr int clipped_code = 250; ///< of 255
constexpr int video_white = 235;  ///< largest code of cameras with video range
constexpr int flat = 4;           ///< codes; an evenly lit wall has more
constexpr double min_share = 0.5;
constexpr std::size_t stride = 7; ///< sample every 7th pixel; prime, so no column aliases

bool is_dark(const FrameLook& look) {
    return look.brightest < dark_code && look.brightest - look.darkest < no_contrast;
}

bool is_blinded(const FrameLook& look) {
    return look.median >= clipped_code ||
           (look.median >= video_white && look.brightest - look.darkest <= flat);
}

/// Hashes eight bytes per step. Each step is invertible, so different bytes collide with probability 2^-64.
std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15ULL; // 2^64 over the golden ratio
    std::uint64_t hash = bytes.size();
    for (std::size_t k = 0; k < bytes.size(); k += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + k, std::min(sizeof word, bytes.size() - k));
        hash = (hash ^ word) * odd;
        hash ^= hash >> 32U;
    }
    return hash;
}

/// The code that more than `below` of the counted pixels do not exceed.
std::uint8_t code_at(const std::array<std::uint32_t, 256>& counted, std::uint64_t below) {
    std::uint64_t sum = 0;
    for (std::size_t code = 0; code < counted.size(); ++code) {
        sum += counted[code];
        if (sum > below) {
            return static_cast<std::uint8_t>(code);
        }
    }
    return 255;
}

} // namespace

FrameLook look_at(std::span<const std::uint8_t> luma) {
    assert(!luma.empty());
    std::array<std::uint32_t, 256> counted{};
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < luma.size(); k += stride) {
        ++counted[luma[k]];
        ++all;
    }
    return {.darkest = code_at(counted, all / 100),
            .median = code_at(counted, all / 2),
            .brightest = code_at(counted, all - 1 - all / 100),
            .bytes_hash = hash_of(luma)};
}

FrameHealth::FrameHealth(double rate_hz, MonotonicTime start)
    : promised_hz_(rate_hz),
      silence_(
          std::max(Nanoseconds(std::chrono::seconds(1)),
                   std::chrono::duration_cast<Nanoseconds>(std::chrono::duration<double>(5.0 / rate_hz)))),
      silent_from_(start + std::max(first_frame, silence_)), counted_since_(start), same_since_(start),
      candidate_since_(start) {
    assert(rate_hz > 0.0);
}

void FrameHealth::hear(MonotonicTime now, std::uint64_t frames) {
    if (arrivals_.empty() || now >= silent_from_) {
        arrivals_.clear(); // a pause is not a slow stream
        counted_since_ = now;
    }
    arrivals_.insert(arrivals_.end(), frames, now);
    forget_before(now);
    silent_from_ = now + silence_;
}

void FrameHealth::see(MonotonicTime now, const FrameLook& look, std::uint64_t overtaken) {
    hear(now, 1 + overtaken);
    same_frames_ = look.bytes_hash == look_.bytes_hash ? same_frames_ + 1 : 0;
    same_since_ = same_frames_ == 0 ? now : same_since_;
    look_ = look;
}

void FrameHealth::forget_before(MonotonicTime now) {
    while (!arrivals_.empty() && arrivals_.front() <= now - rate_window) {
        arrivals_.pop_front();
    }
}

double FrameHealth::rate_hz(MonotonicTime now) {
    forget_before(now);
    const Nanoseconds window = std::min<Nanoseconds>(now - counted_since_, rate_window);
    return window > Nanoseconds(0) ? static_cast<double>(arrivals_.size()) / to_seconds(window) : 0.0;
}

FrameVerdict FrameHealth::at_the_moment(MonotonicTime now) {
    if (now >= silent_from_) {
        return FrameVerdict::Silent;
    }
    if (arrivals_.empty()) {
        return verdict_; // the first frame is not there yet, or frames are rare
    }
    if (is_dark(look_)) {
        return FrameVerdict::Dark;
    }
    if (is_blinded(look_)) {
        return FrameVerdict::Blinded;
    }
    if (same_frames_ >= frozen_frames && now - same_since_ >= frozen_after) {
        return FrameVerdict::Frozen;
    }
    const bool counted = now - counted_since_ >= rate_window;
    return counted && rate_hz(now) < min_share * promised_hz_ ? FrameVerdict::Slow : FrameVerdict::Well;
}

FrameVerdict FrameHealth::verdict(MonotonicTime now) {
    if (const FrameVerdict seen = at_the_moment(now); seen != candidate_) {
        candidate_ = seen;
        candidate_since_ = now;
    }
    if (candidate_ != verdict_ && now - candidate_since_ >= dwell) {
        verdict_ = candidate_;
    }
    return verdict_;
}

} // namespace frustumscreen::camera
