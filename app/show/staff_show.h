/// The exhibit, and for the staff who hold the chord the alignment pattern with what there is to know: every
/// device's state, level and error, frame times, versions. For a minute, or until a button is pressed.
///
/// Presses  reach the exhibit at once, since a visitor's must. Those that turn out to have begun a chord are
///          taken back when it is held: after the pattern the exhibit is as it was before.
/// Memory   the pattern is made when it is asked for and put away afterwards: it costs no one else anything.
/// Threads  the render thread, with the display's context current.
/// Errors   a typeface that is missing: the exhibit goes on, and a line on standard error says so.
#pragma once

#include "app/settings/settings.h"
#include "app/show/pattern_show.h"
#include "app/show/show.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace frustumscreen {

class StaffShow final : public Show {
public:
    static constexpr Nanoseconds length = std::chrono::seconds(60);

    /// `driver`: the display's name for itself.
    StaffShow(const Settings& settings, std::unique_ptr<Show> exhibit, std::string driver)
        : settings_(settings), exhibit_(std::move(exhibit)), driver_(std::move(driver)) {}

    void wish(Wish wish, MonotonicTime now) override;
    [[nodiscard]] bool heeds(Wish wish) const override { return exhibit_->heeds(wish); }
    void chord(MonotonicTime now, const RunStatus& status) override;
    void tell(const RunStatus& status) override;
    [[nodiscard]] DrawResult draw(MonotonicTime now, const Situation& situation, const RenderTarget& target,
                                  Redraw redraw) override;
    void took(MonotonicTime now, double ms) override;
    [[nodiscard]] ShowState state(MonotonicTime now) const override { return exhibit_->state(now); }

private:
    void take_back_presses(MonotonicTime now);
    void end();

    const Settings& settings_;
    std::unique_ptr<Show> exhibit_;
    std::string driver_;
    std::array<bool, 3> passed_on_{};      ///< for each wish: the exhibit heeds the latest
    std::unique_ptr<PatternShow> pattern_; ///< while it is on
    MonotonicTime until_;
    std::optional<int> presents_; ///< since the other show drew last; nothing = it never did
};

} // namespace frustumscreen
