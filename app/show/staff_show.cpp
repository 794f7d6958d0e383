#include "app/show/staff_show.h"

#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen {

namespace {

std::vector<std::string> lines_of(const RunStatus& status, const std::string& driver) {
    const auto state = [](std::string_view device, const Sentence& sentence) {
        return fmt::format("{}: {}", device, sentence.view().empty() ? "nothing to say" : sentence.view());
    };
    return {
        fmt::format("FrustumScreen {}", FRUSTUMSCREEN_VERSION),
        fmt::format("OpenGL: {}", driver),
        state("display", status.display),
        state("tracker", status.tracker),
        state("panel", status.panel),
        fmt::format("prop {}, head {}", status.prop_known ? "known" : "lost",
                    status.head_known ? "known" : "not known"),
        fmt::format("shows {} ({}), {} of {}, {} samples a pixel, error {:.2f} mm mean, {:.2f} mm at most in "
                    "95 of 100 places",
                    status.artifact, status.language, status.level, status.technique, status.samples,
                    status.estimated_error_mm, status.p95_error_mm),
        fmt::format("frames {:.1f} ms, 95 of 100 within {:.1f} ms; {} display times missed in {:.0f} s",
                    status.median_ms, status.p95_ms, status.late, status.uptime_s)};
}

std::size_t index_of(Wish wish) {
    return static_cast<std::size_t>(wish);
}

} // namespace

void StaffShow::wish(Wish wish, MonotonicTime now) {
    passed_on_[index_of(wish)] = !pattern_;
    if (pattern_) {
        end();
    } else {
        exhibit_->wish(wish, now);
    }
}

/// The chord began with a press of the first and a press of the last button.
void StaffShow::take_back_presses(MonotonicTime now) {
    const std::size_t buttons = settings_.panel.buttons();
    for (const Wish wish : {Wish::PreviousArtifact, buttons == 2 ? Wish::NextArtifact : Wish::NextLanguage}) {
        if (std::exchange(passed_on_[index_of(wish)], false)) {
            exhibit_->take_back(wish, now);
        }
    }
}

void StaffShow::chord(MonotonicTime now, const RunStatus& status) {
    take_back_presses(now);
    if (pattern_) {
        end();
        return;
    }
    Result<std::unique_ptr<PatternShow>> pattern = PatternShow::create(settings_);
    if (!pattern) {
        say_line("frustumscreen", fmt::format("no pattern for the staff: {}", pattern.error().message));
        return;
    }
    pattern_ = std::move(*pattern);
    until_ = now + length;
    presents_ = 0;
    tell(status);
}

void StaffShow::tell(const RunStatus& status) {
    if (pattern_) {
        pattern_->set_lines(lines_of(status, driver_));
    }
}

void StaffShow::end() {
    pattern_.reset();
    presents_ = 0;
}

DrawResult StaffShow::draw(MonotonicTime now, const Situation& situation, const RenderTarget& target,
                           Redraw redraw) {
    if (pattern_ && now >= until_) {
        end();
    }
    // A buffer that is older than the change holds a picture of the other show.
    RenderTarget own = target;
    if (presents_ && target.buffer_age > *presents_) {
        own.buffer_age = 0;
    }
    const DrawResult drawn =
        pattern_ ? pattern_->draw(now, situation, own, redraw) : exhibit_->draw(now, situation, own, redraw);
    if (presents_ && drawn.drawn) {
        ++*presents_;
    }
    return drawn;
}

void StaffShow::took(MonotonicTime now, double ms) {
    if (!pattern_) {
        exhibit_->took(now, ms);
    }
}

} // namespace frustumscreen
