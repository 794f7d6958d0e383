#include "app/calibration/procedure/stripe_capture.h"

#include <cassert>

namespace frustumscreen::calibration {

StripeCapture::StripeCapture(const CaptureSetup& setup, MonotonicTime now)
    : setup_(setup), patterns_{{Stripes::White}}, heard_(now) {
    const std::vector<Pattern> stripes = patterns_of(setup.stripes);
    patterns_.insert(patterns_.end(), stripes.begin(), stripes.end());
}

bool StripeCapture::step(MonotonicTime now, std::optional<MonotonicTime> lit,
                         const camera::CameraFrame* frame) {
    if (is_complete()) {
        return true;
    }
    if (frame == nullptr) {
        return now - heard_ <= timeout;
    }
    heard_ = now;
    if (width_ == 0) {
        width_ = frame->width;
        height_ = frame->height;
        sum_.assign(frame->luma.size(), 0);
    }
    if (frame->width != width_ || frame->height != height_ || frame->luma.size() != sum_.size()) {
        return false;
    }
    if (!lit || frame->time < *lit + setup_.delay) {
        return true;
    }
    for (std::size_t k = 0; k < sum_.size(); ++k) {
        sum_[k] = static_cast<std::uint16_t>(sum_[k] + frame->luma[k]);
    }
    if (++summed_ == setup_.frames) {
        std::vector<std::uint8_t>& picture = pictures_.emplace_back(sum_.size());
        for (std::size_t k = 0; k < sum_.size(); ++k) {
            picture[k] = static_cast<std::uint8_t>((sum_[k] + setup_.frames / 2) / setup_.frames);
        }
        sum_.assign(sum_.size(), 0);
        summed_ = 0;
        ++at_;
    }
    return true;
}

camera::CameraFrame StripeCapture::picture(std::size_t which) const {
    assert(which < at_);
    return {.time = {}, .number = 0, .width = width_, .height = height_, .luma = pictures_[which]};
}

camera::CameraFrame StripeCapture::before() const {
    return picture(0);
}

camera::CameraFrame StripeCapture::after() const {
    assert(is_complete());
    return picture(pictures_.size() - 2);
}

Captures StripeCapture::captures() const {
    assert(is_complete());
    return {width_, height_, {pictures_.begin() + 1, pictures_.end()}};
}

} // namespace frustumscreen::calibration
