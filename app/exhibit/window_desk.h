/// The windows on the table: pins what is seen through the prop at a free place, and puts windows away.
///
/// Pin     A press keeps pose and eye. The window comes beside the newest one of the same artifact, so that two states can be
///         compared, otherwise beside the prop. Its place is clear of captions, pictures, the prop's shadow and other windows,
///         and the reader looks into it there. Where it does not fit it is smaller, down to 65 %. If `count` windows lie there
///         already, or no place is left, the oldest goes first.
/// Push    A prop that stands on the table pushes windows on, as it would push sheets of paper; a window pushes the next one.
///         One whose middle is pushed beyond the lit part of the table is put away. A prop that is put down on one covers
///         it.
/// Cover   Anything that touches a window makes it dark; the window dims as it comes near. A window that stays covered for
///         `covered` fades out and fades in at a free place; if there is none, it is put away.
/// Side    When the reader goes to another side of the table, windows turn to that side at new places, as captions do.
/// State   A window of an artifact's state has space for its title below it, and so do the other windows of that artifact.
/// Lens    While the button is held and after it, the newest window's content follows the prop (window_lens.h), which then
///         pushes nothing.
/// Rest    Windows go when nobody is there, and with their artifact.
/// Frames  table T, metres.
/// Time    `now` never goes back.
/// Threads values; one caller. `step` allocates nothing.
/// Errors  none: without a place nothing is pinned.
#pragma once

#include "app/exhibit/presented_windows.h"
#include "app/exhibit/window_history.h"
#include "app/exhibit/window_lens.h"
#include "app/typography/captions.h"
#include "firmware_host/base/time.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

/// A kiosk's windows.
struct WindowPlace {
    std::size_t count = 0; ///< up to settings::max_windows
    glm::dvec2 size_m{0.0};
    bool live = false; ///< behaviours go on in windows
};

class WindowDesk {
public:
    static constexpr double comes_s = 0.5, goes_s = 0.5; ///< fade in, fade out
    static constexpr double under_sign_s = 0.25;         ///< to dim under a sign of the guidance, and back
    static constexpr double under_sign = 0.12;           ///< its light there
    static constexpr Nanoseconds covered = std::chrono::seconds(1);
    static constexpr Nanoseconds gives_up = std::chrono::seconds(4); ///< to look for a place
    static constexpr double title_gap_m = 0.003;                     ///< from a window to its title
    static constexpr double beside_m = 0.008;  ///< from captions, pictures and other windows
    static constexpr double pushed_m = 0.013;  ///< from the shadow of a prop that pushes
    static constexpr double max_push_m = 0.05; ///< in one step; more is a prop that was put down on it

    WindowDesk(const WindowPlace& place, std::span<const glm::dvec2> picture_m);

    struct Input {
        std::size_t artifact = 0; ///< in the prop
        bool pin = false;         ///< pressed
        bool shows = false;       ///< the prop shows the artifact, so that it can be pinned
        glm::dvec3 eye_m{0.0};
        geometry::RigidTransform table_from_prop;       ///< as drawn
        std::optional<ViewToPin> view{};                ///< of a press; none: as the prop shows it now
        glm::dvec2 title_m{0.0};                        ///< space for a title below a window of this artifact
        bool hold = false;                              ///< the button is held: the lens begins
        bool ends_lens = false;                         ///< another press, or the prop's pose is unknown
        std::optional<typography::TablePolygon> shadow; ///< hidden_by_prop from the lens
        std::optional<typography::TablePolygon> hidden; ///< hidden_by_prop from the eye
        std::optional<typography::TablePolygon> sign;   ///< advice as a picture; windows under it dim
        bool stands = false;                            ///< the prop stands on the table, and pushes
        glm::dvec2 prop_m{0.0};
        int quarter_turns = 0;                                 ///< the reader's side
        std::span<const typography::TableRectangle> obstacles; ///< everything else that lies on the table
        bool gone = false;                                     ///< no visitor is there
    };
    void step(MonotonicTime now, const Input& input);
    /// Undoes the latest press: the window that it pinned goes.
    void undo_pin();
    /// Makes the artifact's windows go: it cannot be drawn any more.
    void drop_artifact(std::size_t artifact);

    [[nodiscard]] const PresentedWindows& presented() const { return presented_; }
    /// True if a press would pin something, as of the latest step.
    [[nodiscard]] bool can_pin() const { return can_pin_; }
    /// True if the latest step pinned something.
    [[nodiscard]] bool has_pinned() const { return has_pinned_; }
    /// The windows' places, which captions and signs avoid.
    [[nodiscard]] std::span<const typography::TableRectangle> obstacles() const {
        return std::span(obstacles_).first(obstacle_count_);
    }
    /// True while a window's brightness changes without input.
    [[nodiscard]] bool changing() const { return changing_; }

private:
    struct Window {
        PresentedWindow pinned; ///< `rectangle` has space for the title
        glm::dvec2 title_m{0.0};
        bool lies = false;      ///< it has a place
        bool is_new = true;     ///< it has had none yet
        bool displaces = false; ///< another one goes for it
        bool goes = false;      ///< for good
        bool moves = false;     ///< it fades out to come again elsewhere
        double share = 0.0;     ///< of its fade
        double clear = 0.0;     ///< 0: something touches it, 1: nothing is near
        double signed_share = 0.0;
        bool pushed = false; ///< in this step
        std::optional<MonotonicTime> covered_since, signed_at;
        MonotonicTime looks_since, next_look;
    };
    /// The points x with dot(inward, x) >= offset.
    struct Edge {
        glm::dvec2 inward{0.0};
        double offset = 0.0;
    };
    [[nodiscard]] std::span<Window> all() { return std::span(windows_).first(count_); }
    [[nodiscard]] std::span<const Window> all() const { return std::span(windows_).first(count_); }
    [[nodiscard]] bool accepts(const Input& input) const;
    void pin(MonotonicTime now, const Input& input);
    /// Makes the oldest go that is not `except`; false: all go already.
    bool let_oldest_go(std::uint32_t except);
    void look_through(MonotonicTime now, const Input& input);
    void push(const Input& input);
    void push_each_other();
    void look_for_places(MonotonicTime now, const Input& input);
    [[nodiscard]] std::optional<typography::TableRectangle> free_place(const Window& window,
                                                                       const Input& input) const;
    [[nodiscard]] bool is_free(const Window& window, const typography::TableRectangle& place,
                               const Input& input) const;
    [[nodiscard]] double cost_of(const Window& window, const typography::TableRectangle& place,
                                 const Input& input) const;
    [[nodiscard]] bool lies_in_lit_part(const typography::TableRectangle& place) const;
    /// 0: something touches it, 1: nothing is near.
    [[nodiscard]] double clear_share_of(const Window& window, const Input& input) const;
    void cover(MonotonicTime now, const Input& input, double dt_s);
    void fade(MonotonicTime now, double dt_s);
    /// A window's place and its title's, both in the desk's place for it.
    [[nodiscard]] PresentedWindow shown(const Window& window) const;
    void present();

    WindowPlace place_;
    std::vector<glm::dvec2> picture_m_;
    std::vector<Edge> edges_;                                 ///< of the picture
    glm::dvec2 low_m_{0.0}, high_m_{0.0};                     ///< around the picture
    std::array<Window, settings::max_windows + 1> windows_{}; ///< oldest first
    std::size_t count_ = 0;
    std::uint32_t numbers_ = 0;  ///< so far
    std::uint32_t by_press_ = 0; ///< the window of the latest press; 0: none
    std::optional<MonotonicTime> last_;
    PresentedWindows presented_;
    std::array<typography::TableRectangle, settings::max_windows + 1> obstacles_{};
    std::size_t obstacle_count_ = 0;
    bool can_pin_ = false, changing_ = false, has_pinned_ = false;
    WindowLens lens_;
    std::uint32_t lens_window_ = 0; ///< number of the window that the lens is on
};

} // namespace frustumscreen::exhibit
