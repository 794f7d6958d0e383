#include "app/scene/governor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::scene {

namespace {

/// A change must save at least this share of the time.
constexpr double worth_saving = 0.85;

} // namespace

double pixel_on_prop_m(const geometry::PropShape& prop, const geometry::Pinhole& projector,
                       const geometry::RigidTransform& projector_from_prop) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            nearest = std::fmin(nearest, projector_from_prop.point(corner).z);
        }
    }
    return std::fmax(nearest, 0.0) / std::fmax(projector.fx, projector.fy);
}

namespace {

constexpr double outline_share = 0.5;
constexpr double max_over_mean = 4.0; // two pixels for half a pixel

} // namespace

double judged_error(const pack::LevelError& error, const pack::SeenError& worst) {
    return std::max({static_cast<double>(worst.mean_box),
                     static_cast<double>(worst.outline_shift_box) / outline_share,
                     static_cast<double>(error.max_box) / max_over_mean});
}

bool within_tolerance(const pack::LevelError& error, const pack::SeenError& worst, double mm_per_box,
                      double tolerance_mm) {
    const auto within = [mm_per_box](float box, double most) { // false for NaN
        return static_cast<double>(box) * mm_per_box <= most;
    };
    return within(worst.mean_box, tolerance_mm) &&
           within(worst.outline_shift_box, outline_share * tolerance_mm) &&
           within(error.max_box, max_over_mean * tolerance_mm);
}

std::vector<QualityLevel> ladder(std::span<const pack::LevelOutline> levels, const std::vector<bool>& enough,
                                 int samples, const std::optional<pack::ReliefOutline>& relief,
                                 bool also_on_gpu) {
    std::size_t best = levels.size() - 1;
    for (std::size_t k = levels.size(); k-- > 0;) {
        if (enough[k] && (!enough[best] || levels[k].triangles <= levels[best].triangles)) {
            best = k;
        }
    }
    constexpr double max_of_finer = 0.75;
    std::vector<QualityLevel> quality_levels;
    std::uint64_t last_triangles = levels[best].triangles;
    for (std::size_t k = best + 1; k-- > 0;) {
        const std::uint64_t triangles = levels[k].triangles;
        if (k != best &&
            static_cast<double>(triangles) > max_of_finer * static_cast<double>(last_triangles)) {
            continue;
        }
        last_triangles = triangles;
        for (int s = std::max(samples, 1); s >= 1; s /= 2) {
            quality_levels.push_back({.level = static_cast<std::uint32_t>(k),
                                      .samples = s,
                                      .enough = k == best && s == std::max(samples, 1) && enough[k]});
        }
    }
    if (relief) {
        const int full = std::max(samples, 1);
        std::vector<QualityLevel> of_relief;
        for (const bool on_gpu : {false, true}) {
            if (on_gpu && !also_on_gpu) {
                continue;
            }
            of_relief.push_back(
                {.level = relief->texels, .samples = full, .enough = true, .relief = true, .on_gpu = on_gpu});
            if (full > 1) {
                of_relief.push_back({.level = relief->texels,
                                     .samples = 1,
                                     .enough = false,
                                     .relief = true,
                                     .on_gpu = on_gpu});
            }
        }
        quality_levels.insert(std::find_if(quality_levels.begin(), quality_levels.end(),
                                           [&](const QualityLevel& quality_level) {
                                               return levels[quality_level.level].error.p95_box >
                                                      relief->error.p95_box;
                                           }),
                              of_relief.begin(), of_relief.end());
    }
    return quality_levels;
}

Governor::Governor(std::vector<QualityLevel> quality_levels, const std::vector<QualityLevelTime>& times,
                   double deadline_ms)
    : quality_levels_(std::move(quality_levels)), model_(times), deadline_ms_(deadline_ms) {
    current_ = quality_levels_.size(); // no current level, so that none is favoured
    current_ = wanted();
}

bool Governor::fits(std::size_t quality_level) const {
    return model_.expected_ms(quality_level) <=
           (quality_level == current_ ? leave_share : enter_share) * deadline_ms_;
}

double Governor::cost(std::size_t quality_level) const {
    return model_.expected_ms(quality_level) * (quality_level == current_ ? worth_saving : 1.0);
}

std::size_t Governor::wanted() const {
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::size_t enough = none;
    std::size_t best = none;
    std::size_t quickest = quality_levels_.size() - 1;
    for (std::size_t k = quality_levels_.size(); k-- > 0;) {
        quickest = cost(k) < cost(quickest) ? k : quickest;
        if (fits(k)) {
            best = k;
            enough = quality_levels_[k].enough && (enough == none || cost(k) <= cost(enough)) ? k : enough;
        }
    }
    return enough != none ? enough : (best != none ? best : quickest);
}

std::optional<std::size_t> Governor::doubted() const {
    const std::size_t count = quality_levels_.size();
    const auto triangles = [this](std::size_t quality_level) {
        return model_.start(quality_level).work.triangles;
    };
    for (std::size_t step = 1; step <= count; ++step) {
        const std::size_t k = (tried_ + count - step) % count;
        if (k != current_ && quality_levels_[k].samples <= quality_levels_[current_].samples &&
            triangles(k) <= triangles(current_)) {
            return k;
        }
    }
    return std::nullopt;
}

void Governor::change_to(std::size_t quality_level, MonotonicTime now) {
    const bool too_slow = !fits(current_);
    if (too_slow && entered_for_quality_) {
        // Exponential backoff: a level that was entered for quality and proved too slow.
        const bool lasted = now - changed_ >= 4 * backoff_;
        backoff_ = lasted ? min_backoff : std::min(2 * backoff_, max_backoff);
    }
    entered_for_quality_ = !too_slow;
    current_ = quality_level;
    changed_ = now;
    wanted_ = Change::None;
    ++switches_;
}

Nanoseconds Governor::delay_of(Change change) const {
    return change == Change::Leave ? leave_delay : (change == Change::Try ? try_backoff_ : backoff_);
}

void Governor::observe(MonotonicTime now, const FrameWork& work, double ms) {
    if (!model_.observe(current_, work, ms, now)) {
        ++ignored_;
        return;
    }
    if (now - changed_ >= dwell && current_ == tried_) {
        if (model_.expected_ms(current_) < worth_saving * tried_at_ms_) {
            try_backoff_ = min_backoff; // the try succeeded: the next one may follow as soon
        }
        tried_at_ms_ = 0.0;
    }
    std::size_t better = wanted();
    Change wanted = better == current_ ? Change::None : (fits(current_) ? Change::Quality : Change::Leave);
    if (wanted == Change::None && !fits(current_)) {
        if (const std::optional<std::size_t> quality_level = doubted()) {
            better = *quality_level;
            wanted = Change::Try;
        }
    }
    if (wanted != wanted_) {
        wanted_ = wanted;
        wanted_since_ = now;
    }
    const bool settled = switches_ == 0 || now - changed_ >= dwell;
    if (wanted == Change::None || !settled || now - wanted_since_ < delay_of(wanted)) {
        return;
    }
    if (wanted == Change::Try) {
        tried_ = better;
        tried_at_ms_ = model_.expected_ms(current_);
        try_backoff_ = std::min(2 * try_backoff_, max_backoff);
    }
    change_to(better, now);
}

void Governor::enter(MonotonicTime now, double load) {
    model_.set_load(load);
    wanted_ = Change::None;
    if (const std::size_t better = wanted(); better != current_) {
        change_to(better, now);
    }
}

} // namespace frustumscreen::scene
