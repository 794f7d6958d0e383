#include "app/visitor/background.h"

#include "app/geometry/time_curves.h"
#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::visitor {

namespace {

constexpr float min_off = 6.0F; ///< codes; smaller differences are not foreground
constexpr float spreads = 4.0F;
constexpr float min_variance = 0.5F;
constexpr float darkest = 16.0F; ///< codes; darker pixels determine the gain poorly
constexpr float min_gain = 0.05F;
constexpr std::size_t gain_step = 13;  ///< sample every 13th pixel for the gain
constexpr double projector_s = 2.0;    ///< time constant of the squared change, and of the shares
constexpr float little_change = 25.0F; ///< codes^2 of the table; smaller changes determine the shares poorly
constexpr double all_changed = 0.7;    ///< of the pixels
constexpr Nanoseconds all_changed_for = std::chrono::seconds(1);

/// Largest difference of a background pixel, in codes.
float max_off(float variance) {
    return std::max(min_off, spreads * std::sqrt(variance));
}

} // namespace

Background::Background(std::vector<Shows> shows)
    : shows_(std::move(shows)), model_(shows_.size()), raw_(shows_.size()), foreground_(shows_.size()),
      occupied_(shows_.size()) {
    for (std::size_t at = 0; at < shows_.size(); ++at) {
        if (shows_[at] != Shows::Neither) {
            (shows_[at] == Shows::Head ? heads_ : table_).push_back(static_cast<std::uint32_t>(at));
        }
    }
    ratios_.reserve(heads_.size() / gain_step + 1);
}

void Background::begin(MonotonicTime time) {
    std::fill(model_.begin(), model_.end(), Pixel{});
    std::fill(foreground_.begin(), foreground_.end(), std::uint8_t{0});
    begun_ = last_ = time;
    all_changed_since_.reset();
    frames_ = 0;
    gain_ = 1.0F;
    table_usual_ = change_ = change_square_ = 0.0F;
    knows_ = false;
    ++beginnings_;
}

void Background::measure_table(const SmallFrame& frame) {
    double sum = 0.0;
    for (const std::uint32_t at : table_) {
        sum += frame.luma[at];
    }
    const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, table_.size())));
    const auto slowly = static_cast<float>(geometry::follow_share(dt_s_, daylight_s));
    table_usual_ += (knows_ ? slowly : 1.0F / static_cast<float>(frames_)) * (mean - table_usual_);
    change_ = mean - table_usual_;
    change_square_ +=
        static_cast<float>(geometry::follow_share(dt_s_, projector_s)) * (change_ * change_ - change_square_);
}

/// The gain is the median over background pixels.
void Background::measure_gain(const SmallFrame& frame) {
    ratios_.clear();
    for (std::size_t k = 0; k < heads_.size(); k += gain_step) {
        const std::size_t at = heads_[k];
        if (foreground_[at] == 0 && model_[at].usual > darkest) {
            ratios_.push_back((frame.luma[at] - model_[at].share * change_) / model_[at].usual);
        }
    }
    constexpr std::size_t enough = 50;
    if (knows_ && ratios_.size() > enough) {
        gain_ = std::max(min_gain, static_cast<float>(quantile_in(std::span(ratios_), 0.5)));
    }
}

std::span<const std::uint8_t> Background::find(MonotonicTime time, const SmallFrame& frame) {
    if (!begun_ || time < *last_) {
        begin(time);
    }
    dt_s_ = to_seconds(time - *last_);
    last_ = time;
    ++frames_;
    measure_table(frame);
    measure_gain(frame);
    std::size_t count = 0;
    for (const std::uint32_t at : heads_) {
        const Pixel& pixel = model_[at];
        const bool is_off = knows_ && std::abs(off(at, frame.luma[at])) > max_off(pixel.variance);
        raw_[at] = is_off && pixel.share < lit_share ? 1 : 0;
        count += is_off ? 1 : 0;
    }
    const bool changed = static_cast<double>(count) > all_changed * static_cast<double>(heads_.size());
    all_changed_since_ = !changed ? std::nullopt : all_changed_since_ ? all_changed_since_ : time;
    if (all_changed_since_ && time - *all_changed_since_ >= all_changed_for) {
        begin(time);
        ++frames_;
        measure_table(frame);
    } else {
        clean(frame);
    }
    knows_ = time - *begun_ >= first_look;
    return foreground_;
}

/// Majority filter over a pixel and its neighbours: noise makes single foreground pixels.
void Background::clean(const SmallFrame& frame) {
    constexpr int most = 4; // of nine
    for (const std::uint32_t at : heads_) {
        const int row = static_cast<int>(at) / frame.width;
        const int column = static_cast<int>(at) % frame.width;
        if (row == 0 || column == 0 || row + 1 == frame.height || column + 1 == frame.width) {
            foreground_[at] = 0;
            continue;
        }
        int sum = 0;
        for (int y = row - 1; y <= row + 1; ++y) {
            const std::uint8_t* const three = &raw_[frame.at(y, column - 1)];
            sum += three[0] + three[1] + three[2];
        }
        foreground_[at] = sum > most ? 255 : 0;
    }
}

void Background::take_in(const SmallFrame& frame, const PixelBox& box) {
    for (const std::uint32_t at : heads_) {
        const int row = static_cast<int>(at) / frame.width;
        const int column = static_cast<int>(at) % frame.width;
        const bool is_in = row >= box.top && row < box.bottom && column >= box.left && column < box.right;
        if (is_in && (raw_[at] != 0 || foreground_[at] != 0)) {
            model_[at].usual += off(at, frame.luma[at]) / gain_;
            raw_[at] = foreground_[at] = 0;
        }
    }
}

void Background::learn(const SmallFrame& frame, std::span<const PixelBox> people) {
    std::fill(occupied_.begin(), occupied_.end(), std::uint8_t{0});
    for (const PixelBox& box : people) {
        const int left = std::clamp(box.left, 0, frame.width);
        const int right = std::clamp(box.right, left, frame.width);
        for (int row = std::max(0, box.top); row < std::min(box.bottom, frame.height); ++row) {
            std::fill_n(&occupied_[frame.at(row, 0)] + left, right - left, std::uint8_t{1});
        }
    }
    const float first = 1.0F / static_cast<float>(frames_);
    const auto daylight = static_cast<float>(geometry::follow_share(dt_s_, daylight_s));
    const float projector = knows_ && !all_changed_since_
                                ? static_cast<float>(geometry::follow_share(dt_s_, projector_s)) * change_ /
                                      (change_square_ + little_change)
                                : 0.0F;
    for (const std::uint32_t at : heads_) {
        if (occupied_[at] != 0) {
            continue;
        }
        Pixel& pixel = model_[at];
        const float error = off(at, frame.luma[at]);
        const float most = max_off(pixel.variance);
        pixel.share += projector * std::clamp(error, -most, most); // limits the effect of passing objects
        if (knows_ && (raw_[at] != 0 || foreground_[at] != 0)) {
            pixel.usual += hold(pixel, error) ? error / gain_ : 0.0F;
            continue;
        }
        const float share = knows_ ? daylight : first;
        const float square = frames_ > 1 ? error * error : 0.0F; // the first frame has no prediction
        pixel.usual += share * error / gain_;
        pixel.variance = std::max(min_variance, pixel.variance + share * (square - pixel.variance));
        pixel.held_s = 0.0F;
    }
}

bool Background::hold(Pixel& pixel, float error) const {
    const bool is_same = pixel.held_s > 0.0F && std::abs(error - pixel.thing) <= max_off(pixel.variance);
    if (!is_same) {
        pixel.thing = error;
        pixel.held_s = 0.0F;
    }
    pixel.held_s += static_cast<float>(dt_s_);
    if (pixel.held_s < static_cast<float>(thing_s)) {
        return false;
    }
    pixel.held_s = 0.0F;
    return true;
}

} // namespace frustumscreen::visitor
