// Fades of artifacts, captions and quality levels. They are closed forms of time. The cases check that
// nothing jumps, that the time step does not matter, and that a fade may reverse at any moment.

#include "app/bench/stability/sweep.h"
#include "app/bench/stability/themes.h"
#include "app/exhibit/idle_pose.h"
#include "app/exhibit/selection.h"
#include "app/geometry/time_curves.h"
#include "app/typography/captions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::bench {

namespace {

constexpr double eps = 0x1p-52;
constexpr double steepest = 1.5; ///< greatest slope of `ease`

StabilityResult closed_forms(const StabilityOptions&) {
    double off = 0.0;
    double falling = 0.0;
    for (const double length : sweep(1e-6, 1e3, 1)) {
        double before = 0.0;
        for (const double t : sweep(1e-6, 10.0, 50)) {
            const double value = geometry::ease(geometry::ramp(t, length));
            const long double x = std::min(1.0L, static_cast<long double>(t) / length);
            const long double exact = x * x * (3.0L - 2.0L * x);
            off = std::fmax(off, static_cast<double>(std::abs(value / exact - 1.0L)));
            falling += value >= before && value <= 1.0 ? 0.0 : 1.0;
            before = value;
        }
        falling += geometry::ramp(0.0, length) == 0.0 && geometry::ramp(-1.0, length) == 0.0 ? 0.0 : 1.0;
    }
    return {{{"length 1 us to 1e3 s, 1 us to 10 s in: off, relative", 8 * eps, off},
             {"falling, above 1, or not 0 before it begins", 0.0, falling}}};
}

/// Largest step of the visible brightness; where the artifact changes, both brightnesses are added.
double exhibit_jump(double step_s) {
    const auto step = Nanoseconds(std::llround(step_s * 1e9));
    MonotonicTime now = from_microseconds(1'000'000);
    exhibit::Selection selection(3, {"en"}, "en", now);
    std::mt19937 random(8);
    exhibit::Shown before = selection.at(now);
    double jump = 0.0;
    const int presses_every = std::max(1, static_cast<int>(0.07 / step_s)); // often within a fade
    for (int k = 0; k < 20'000; ++k) {
        now += step;
        if (random() % static_cast<unsigned>(presses_every) == 0) {
            selection.take(random() % 2 == 0 ? settings::Command::NextArtifact
                                             : settings::Command::PreviousArtifact,
                           now);
        }
        const exhibit::Shown shown = selection.at(now);
        jump =
            std::fmax(jump, shown.artifact == before.artifact ? std::abs(shown.brightness - before.brightness)
                                                              : shown.brightness + before.brightness);
        before = shown;
    }
    return jump;
}

constexpr std::array fade_steps{1e-6, 1e-5, 1e-4, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.05, 0.1, 1.0, 10.0};

StabilityResult artifacts(const StabilityOptions&) {
    double over = 0.0;
    for (const double step : fade_steps) {
        const double allowed = std::fmin(2.0, steepest * step / to_seconds(exhibit::fade_time));
        over = std::fmax(over, exhibit_jump(step) / allowed);
    }
    return {{{"largest jump, over steepest slope x step (2 at most)", 1.0 + 1e-9, over}}};
}

/// The brightness at a time does not depend on how often it was queried before.
StabilityResult any_rhythm(const StabilityOptions&) {
    MonotonicTime start = from_microseconds(1'000'000);
    std::array<exhibit::Selection, 2> selections{exhibit::Selection(3, {"en"}, "en", start),
                                                 exhibit::Selection(3, {"en"}, "en", start)};
    double other = 0.0;
    for (int k = 0; k < 200; ++k) {
        const MonotonicTime press = start + k * std::chrono::milliseconds(137);
        for (exhibit::Selection& selection : selections) {
            selection.take(settings::Command::NextArtifact, press);
        }
        for (int j = 0; j < 100; ++j) {
            (void)selections[0].at(press + j * std::chrono::microseconds(1)); // frequent queries
        }
        const MonotonicTime late = press + std::chrono::milliseconds(k);
        other += selections[0].at(late).brightness == selections[1].at(late).brightness ? 0.0 : 1.0;
        const double back = selections[0].at(press - std::chrono::seconds(10)).brightness;
        other += back >= 0.0 && back <= 1.0 ? 0.0 : 1.0;
    }
    return {{{"brightness other at another rhythm of frames", 0.0, other}}};
}

struct CaptionJumps {
    double jump = 0.0;      ///< largest, as a multiple of what time and movement allow
    double on_shadow = 0.0; ///< frames with a caption on the prop's shadow
    double shown = 0.0;     ///< frames with a caption
};

/// A prop that wanders over the table with a square shadow; a caption avoids it.
CaptionJumps caption_jumps(double step_s) {
    const std::array corners{glm::dvec2(-0.4, -0.25), glm::dvec2(0.4, -0.25), glm::dvec2(0.4, 0.25),
                             glm::dvec2(-0.4, 0.25)};
    typography::CaptionPlacer placer(corners);
    placer.set_shapes(std::array{glm::dvec2(0.16, 0.05), glm::dvec2(0.10, 0.08)});
    CaptionJumps result;
    typography::CaptionPlace before;
    glm::dvec2 prop_before(0.0);
    constexpr double dimming_m = 0.012; // as in captions.cpp: invisible at the shadow, full at this distance
    constexpr double fade_s = 0.25;
    for (int k = 0; k < 4000; ++k) {
        const double t = k * step_s;
        const MonotonicTime now(Nanoseconds(std::llround(t * 1e9)) + std::chrono::seconds(1));
        const glm::dvec2 prop(0.28 * std::sin(0.7 * t), 0.14 * std::sin(1.1 * t + 0.4));
        const typography::TablePolygon shadow = typography::polygon_of({prop, glm::dvec2(0.18)});
        placer.update(now, shadow, std::nullopt, prop);
        const typography::CaptionPlace place = placer.at(now);
        const bool same = place.rectangle.centre_m == before.rectangle.centre_m &&
                          place.rectangle.size_m == before.rectangle.size_m;
        const double jump = same ? std::abs(place.opacity - before.opacity) : place.opacity + before.opacity;
        const double allowed =
            steepest * (step_s / fade_s + glm::distance(prop, prop_before) / dimming_m) * (same ? 1.0 : 2.0);
        if (k > 0 && jump > 0.0) {
            result.jump = std::fmax(result.jump, jump / std::fmin(2.0, allowed));
        }
        const bool lies_on_it = typography::clearance(place.rectangle.corners(), shadow.corners()) <= 0.0;
        result.on_shadow += place.opacity > 0.0 && lies_on_it ? 1.0 : 0.0;
        result.shown += place.opacity > 0.0 ? 1.0 : 0.0;
        before = place;
        prop_before = prop;
    }
    return result;
}

StabilityResult captions(const StabilityOptions&) {
    CaptionJumps worst;
    for (const double step : {1e-4, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.05, 0.1, 1.0, 10.0}) {
        const CaptionJumps jumps = caption_jumps(step);
        worst.jump = std::fmax(worst.jump, jumps.jump);
        worst.on_shadow += jumps.on_shadow;
        worst.shown += jumps.shown;
    }
    return {{{"largest jump, over what step and movement allow", 1.0 + 1e-9, worst.jump},
             {"frames with a caption on the prop's shadow", 0.0, worst.on_shadow},
             {"frames with a caption, short of 10000", 0.0, std::fmax(0.0, 10'000.0 - worst.shown)}}};
}

/// A tracker that loses and finds the prop at random, for short and for long times.
struct LostAndFound {
    std::mt19937 random{9};
    MonotonicTime next = from_microseconds(1'000'000);
    MonotonicTime good = next; ///< time of the latest good pose
    bool there = true;

    /// The age of the latest good pose at `now`.
    Nanoseconds age(MonotonicTime now) {
        for (; next <= now; there = !there) {
            good = there ? next : good;
            next += std::chrono::milliseconds(1 + random() % (random() % 2 == 0 ? 900 : 9000));
        }
        return there ? Nanoseconds(0) : Nanoseconds(now - good);
    }
};

/// Largest step of brightness; where the pose changes, both brightnesses are added.
double attract_jump(double step_s) {
    const auto step = Nanoseconds(std::llround(step_s * 1e9));
    MonotonicTime now = from_microseconds(1'000'000);
    const geometry::RigidTransform pose{{1.0, 0.0, 0.0, 0.0}, {0.2, 0.1, 0.0}};
    exhibit::IdlePose idle_pose(glm::dvec2(0.0), true, now);
    LostAndFound prop;
    exhibit::DrawnPose before{pose};
    double jump = 0.0;
    for (int k = 0; k < 20'000; ++k) {
        now += step;
        const Nanoseconds age = prop.age(now);
        const exhibit::DrawnPose drawn = idle_pose.at(now, age <= std::chrono::seconds(1), age, pose);
        jump =
            std::fmax(jump, drawn.attracts == before.attracts ? std::abs(drawn.brightness - before.brightness)
                                                              : drawn.brightness + before.brightness);
        before = drawn;
    }
    return jump;
}

StabilityResult lost_props(const StabilityOptions&) {
    double over = 0.0;
    for (const double step : fade_steps) {
        const double allowed = std::fmin(2.0, steepest * step / to_seconds(exhibit::IdlePose::each_way));
        over = std::fmax(over, attract_jump(step) / allowed);
    }
    // Fades out and in again; one object is queried once, another often.
    double other = 0.0;
    double rising = 0.0;
    const MonotonicTime start = from_microseconds(1'000'000);
    exhibit::DrawnPose before;
    exhibit::IdlePose often(glm::dvec2(0.0), true, start);
    for (int ms = 0; ms < 6000; ++ms) {
        const Nanoseconds age = std::chrono::milliseconds(ms);
        const exhibit::DrawnPose seen = often.at(start + age, ms <= 1000, age, {});
        exhibit::IdlePose once(glm::dvec2(0.0), true, start);
        const exhibit::DrawnPose late = once.at(start + age, ms <= 1000, age, {});
        other += seen.brightness == late.brightness && seen.attracts == late.attracts ? 0.0 : 1.0;
        const bool same = seen.attracts == before.attracts;
        const double towards = seen.attracts ? 1.0 : -1.0; // out, then in
        rising += same && towards * (seen.brightness - before.brightness) < 0.0 ? 1.0 : 0.0;
        before = seen;
    }
    return {{{"largest jump, over steepest slope x step (2 at most)", 1.0 + 1e-9, over},
             {"brightness other at another rhythm of frames", 0.0, other},
             {"rising while it fades out, falling while it fades in", 0.0, rising}}};
}

} // namespace

std::vector<StepError> fade_step_errors() {
    std::vector<StepError> errors;
    errors.reserve(fade_steps.size());
    for (const double step : fade_steps) {
        errors.push_back({"jump in a fade, of 1", step, exhibit_jump(step)});
    }
    return errors;
}

std::vector<StabilityCase> fade_cases() {
    const std::string theme = "fade";
    return {{theme, "closed forms", FloatingPoint::Strict, closed_forms},
            {theme, "from artifact to artifact, pressed at any moment", FloatingPoint::Strict, artifacts},
            {theme, "the same at any rhythm of frames", FloatingPoint::Strict, any_rhythm},
            {theme, "captions that give way", FloatingPoint::Strict, captions},
            {theme, "a prop that is lost and found", FloatingPoint::Strict, lost_props}};
}

} // namespace frustumscreen::bench
