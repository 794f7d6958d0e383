#include "app/drift/mark_finder.h"

#include "firmware_host/base/quantile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::drift {

namespace {

constexpr int reach = 3; ///< half width of the box that noise is averaged over
constexpr int box = 2 * reach + 1;
constexpr double min_height = 1.5;          ///< codes
constexpr double min_height_in_noise = 5.0; ///< standard deviations of the box's mean
constexpr double min_radius_px = 1.5, max_radius_px = 40.0;
constexpr double outline = 0.25;       ///< of its height; brighter pixels belong to the mark
constexpr double max_change = 0.25;    ///< of its height, from before to after
constexpr double max_elongation = 4.0; ///< ratio of its variances

/// Box means of a picture, into `out`; near the edges over the available pixels. `rows` is scratch memory.
void box_means(std::span<const float> from, int width, int height, std::vector<float>& rows,
               std::vector<float>& out) {
    rows.resize(from.size());
    out.resize(from.size());
    const auto slide = [](const float* in, float* to, int count, int step) {
        float sum = 0.0F;
        for (int k = 0; k < std::min(reach, count); ++k) {
            sum += in[static_cast<std::ptrdiff_t>(k) * step];
        }
        for (int k = 0; k < count; ++k) {
            if (k + reach < count) {
                sum += in[static_cast<std::ptrdiff_t>(k + reach) * step];
            }
            if (k - reach - 1 >= 0) {
                sum -= in[static_cast<std::ptrdiff_t>(k - reach - 1) * step];
            }
            const int held = std::min(k + reach, count - 1) - std::max(k - reach, 0) + 1;
            to[static_cast<std::ptrdiff_t>(k) * step] = sum / static_cast<float>(held);
        }
    };
    for (int y = 0; y < height; ++y) {
        const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) * width;
        slide(from.data() + row, rows.data() + row, width, 1);
    }
    for (int x = 0; x < width; ++x) {
        slide(rows.data() + x, out.data() + x, height, width);
    }
}

/// Standard deviation of values that are mostly noise, from the median of their magnitudes.
double noise_of(std::span<const float> values, std::vector<float>& scratch) {
    scratch.clear();
    const std::size_t step = std::max<std::size_t>(1, values.size() / 4096);
    for (std::size_t k = 0; k < values.size(); k += step) {
        scratch.push_back(std::abs(values[k]));
    }
    return 1.4826 * quantile_in(std::span(scratch), 0.5);
}

void add_to(std::vector<std::uint16_t>& sums, std::span<const std::uint8_t> luma, bool is_first) {
    if (is_first) {
        std::copy(luma.begin(), luma.end(), sums.begin());
        return;
    }
    for (std::size_t k = 0; k < luma.size(); ++k) {
        sums[k] = static_cast<std::uint16_t>(sums[k] + luma[k]);
    }
}

} // namespace

void MarkFinder::begin_after_mark() {
    std::swap(before_, after_);
    counts_ = {counts_.after, 0, 0};
}

void MarkFinder::add(MarkPhase phase, std::span<const std::uint8_t> luma, int width, int height) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (width < box || height < box || luma.size() != pixels) {
        return;
    }
    if (width != width_ || height != height_) {
        width_ = width;
        height_ = height;
        counts_ = {};
        for (std::vector<std::uint16_t>* sums : {&before_, &lit_, &after_}) {
            sums->assign(pixels, 0);
        }
    }
    int& count = phase == MarkPhase::Before ? counts_.before
                 : phase == MarkPhase::Lit  ? counts_.lit
                                            : counts_.after;
    if (count < max_frames) {
        add_to(phase == MarkPhase::Before ? before_
               : phase == MarkPhase::Lit  ? lit_
                                          : after_,
               luma, count == 0);
        ++count;
    }
}

void MarkFinder::dark_picture(std::vector<std::uint8_t>& luma) const {
    luma.clear();
    if (counts_.before > 0) {
        std::transform(before_.begin(), before_.end(), std::back_inserter(luma), [&](std::uint16_t sum) {
            return static_cast<std::uint8_t>((sum + counts_.before / 2) / counts_.before);
        });
    }
}

/// Computes the mark's light, and the change from before it to after it.
void MarkFinder::take_difference(const PixelWindow& window) {
    const glm::ivec2 size = window.high - window.low;
    light_.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    change_.resize(light_.size());
    const float before_share = 1.0F / static_cast<float>(counts_.before);
    const float lit_share = 1.0F / static_cast<float>(counts_.lit);
    const float after_share = 1.0F / static_cast<float>(counts_.after);
    std::size_t to = 0;
    for (int y = window.low.y; y < window.high.y; ++y) {
        std::size_t from = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(window.low.x);
        for (int x = window.low.x; x < window.high.x; ++x, ++from, ++to) {
            const float before = before_share * static_cast<float>(before_[from]);
            const float after = after_share * static_cast<float>(after_[from]);
            light_[to] = lit_share * static_cast<float>(lit_[from]) - 0.5F * (before + after);
            change_[to] = after - before;
        }
    }
}

std::optional<FoundMark> MarkFinder::find(const std::optional<PixelWindow>& near) {
    if (counts_.before < 2 || counts_.lit < 2 || counts_.after < 2) {
        return std::nullopt;
    }
    PixelWindow window{{0, 0}, {width_, height_}};
    if (near) {
        window = {glm::max(window.low, near->low), glm::min(window.high, near->high)};
    }
    const glm::ivec2 size = window.high - window.low;
    if (size.x < box || size.y < box) {
        return std::nullopt;
    }
    take_difference(window);
    box_means(light_, size.x, size.y, rows_, means_);
    box_means(change_, size.x, size.y, rows_, change_means_);
    const double noise = noise_of(light_, scratch_) / box;
    std::size_t peak = 0;
    const auto score = [&](std::size_t k) { return means_[k] - 2.0F * std::abs(change_means_[k]); };
    for (std::size_t k = 1; k < means_.size(); ++k) {
        peak = score(k) > score(peak) ? k : peak;
    }
    if (score(peak) < std::fmax(min_height, min_height_in_noise * noise)) {
        return std::nullopt;
    }
    std::optional<FoundMark> mark = measure(peak, size);
    if (mark) {
        mark->pixel += glm::dvec2(window.low);
    }
    return mark;
}

/// Collects the mark's pixels around the peak by flood fill; returns false if they are not a mark.
bool MarkFinder::gather(std::size_t peak, const glm::ivec2& size) {
    const float least = static_cast<float>(outline) * means_[peak];
    const std::size_t most = static_cast<std::size_t>(4.0 * std::numbers::pi * max_radius_px * max_radius_px);
    taken_.assign(means_.size(), 0);
    part_.assign(1, peak);
    taken_[peak] = 1;
    for (std::size_t next = 0; next < part_.size(); ++next) {
        const int x = static_cast<int>(part_[next] % static_cast<std::size_t>(size.x));
        const int y = static_cast<int>(part_[next] / static_cast<std::size_t>(size.x));
        if (x == 0 || y == 0 || x + 1 == size.x || y + 1 == size.y || part_.size() > most) {
            return false; // it continues beyond the picture, or is too large for a mark
        }
        for (const int step : {-1, 1, -size.x, size.x}) {
            const std::size_t beside = part_[next] + static_cast<std::size_t>(step);
            if (taken_[beside] == 0 && means_[beside] > least) {
                taken_[beside] = 1;
                part_.push_back(beside);
            }
        }
    }
    return true;
}

std::optional<FoundMark> MarkFinder::measure(std::size_t peak, const glm::ivec2& size) {
    if (!gather(peak, size)) {
        return std::nullopt;
    }
    const double height = means_[peak];
    double sum = 0.0;
    glm::dvec2 first(0.0);
    glm::dvec3 second(0.0); // xx, xy, yy
    double half = 0.0;
    double change = 0.0;
    for (const std::size_t k : part_) {
        const std::size_t row = k / static_cast<std::size_t>(size.x);
        const std::size_t column = k % static_cast<std::size_t>(size.x);
        const glm::dvec2 at = glm::dvec2(column, row) + 0.5;
        const double light = light_[k];
        sum += light;
        first += light * at;
        second += light * glm::dvec3(at.x * at.x, at.x * at.y, at.y * at.y);
        half += means_[k] > 0.5 * height ? 1.0 : 0.0;
        change = std::fmax(change, std::abs(static_cast<double>(change_means_[k])));
    }
    const FoundMark mark{first / sum, height, std::sqrt(half / std::numbers::pi)};
    const glm::dvec3 spread =
        second / sum -
        glm::dvec3(mark.pixel.x * mark.pixel.x, mark.pixel.x * mark.pixel.y, mark.pixel.y * mark.pixel.y);
    const double mean = 0.5 * (spread.x + spread.z);
    const double apart = std::hypot(0.5 * (spread.x - spread.z), spread.y);
    const bool is_round = mean + apart < max_elongation * (mean - apart);
    if (sum <= 0.0 || !is_round || change > max_change * height || mark.radius_px < min_radius_px ||
        mark.radius_px > max_radius_px) {
        return std::nullopt;
    }
    return mark;
}

} // namespace frustumscreen::drift
