/// The chosen artifact and language, and the brightness of both while they change.
///
/// A change of artifact fades the old one out and the new one in (app/exhibit/fade.h); a change of language fades
/// only the caption. A change requested during a fade-in begins after it, and a caption never fades in the middle of
/// an artifact's fade, nor an artifact in the middle of a caption's: changes are at least 0.5 s apart, whatever is
/// pressed. The picture therefore flashes at most twice a second, which leaves time for the staff picture to come and
/// go. WCAG 2.3.1 and ITU-R BT.1702 allow three flashes, to protect photosensitive people. A press still shows at
/// once: either the picture dims, or it is already changing.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. `at` is pure.
/// Errors   none. Without artifacts nothing is shown.
#pragma once

#include "app/exhibit/fade.h"
#include "app/settings/command.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::exhibit {

inline constexpr Nanoseconds fade_time = std::chrono::milliseconds(250); ///< fade out, or fade in

struct Shown {
    std::size_t artifact = 0;
    double brightness = 0.0;   ///< of the artifact: 0..1, a factor on linear light
    std::string_view language; ///< of the caption; valid as long as the selection
    double caption_brightness = 0.0;
    bool changing = false;            ///< a brightness changes, or is about to
    bool leaving = false;             ///< the artifact fades out
    double language_brightness = 1.0; ///< of texts in this language that stay when the artifact changes
};

class Selection {
public:
    /// How long each artifact is shown while they come in turn.
    static constexpr Nanoseconds turn_time = std::chrono::seconds(20);

    /// `languages` (BCP 47): those that some artifact has a caption in, in the order in which the button cycles
    /// through them.
    Selection(std::size_t artifact_count, std::vector<std::string> languages, std::string language,
              MonotonicTime now);

    /// Replaces the first artifact and the current language; the house's language remains the one that rest returns
    /// to. An unknown artifact or language changes nothing.
    void begin_with(std::size_t artifact, std::string_view language, MonotonicTime now);
    /// A command that is not accepted changes nothing.
    void take(settings::Command command, MonotonicTime now);
    /// Chooses an artifact; an index out of range changes nothing.
    void choose(std::size_t artifact, MonotonicTime now);
    /// Sets whether the artifact can be chosen. If the chosen one cannot, the next one that can is chosen.
    void offer(std::size_t artifact, bool offered, MonotonicTime now);
    /// The artifact that the button for the next or for the previous artifact leads to; the chosen one if there is no
    /// other.
    [[nodiscard]] std::size_t next() const { return neighbour(1); }
    [[nodiscard]] std::size_t previous() const { return neighbour(count_ - 1); }
    /// True if `turn_time` has passed since the beginning, the latest `rest` or the latest `turn`.
    [[nodiscard]] bool turn_is_due(MonotonicTime now) const { return now >= turned_ + turn_time; }
    /// Chooses the next artifact in turn.
    void turn(MonotonicTime now);
    /// Returns to the first language, and begins the turns; the artifact stays.
    void rest(MonotonicTime now);
    /// Undoes the latest command of this kind.
    void undo(settings::Command command, MonotonicTime now);
    /// True if the command has something to change to.
    [[nodiscard]] bool accepts(settings::Command command) const;
    [[nodiscard]] Shown at(MonotonicTime now) const;
    /// The chosen artifact; it may not be visible yet.
    [[nodiscard]] std::size_t artifact() const { return artifact_.goal(); }
    /// The chosen language; its caption may not be visible yet.
    [[nodiscard]] const std::string& language() const { return languages_[language_.goal()]; }
    [[nodiscard]] bool is_at_first_language() const { return language_.goal() == first_language_; }

private:
    void change_language(std::size_t which, MonotonicTime now);

    /// The nearest artifact that is not left out, in steps of `step` around the set.
    [[nodiscard]] std::size_t neighbour(std::size_t step) const;

    std::size_t count_;
    std::vector<bool> left_out_;
    std::vector<std::string> languages_; ///< with one more if the first language is none of them
    std::size_t language_count_;
    std::size_t first_language_;
    std::size_t language_before_; ///< the language before the latest command for another
    MonotonicTime turned_;
    Fade artifact_;
    Fade language_; ///< indices into `languages_`
};

} // namespace frustumscreen::exhibit
