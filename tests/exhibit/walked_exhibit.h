/// The exhibit of the random walk: an exhibit of four artifacts with all that artifacts can have, and its narrator.
#pragma once

#include "app/bench/truth/seeded_situations.h"
#include "tests/exhibit/exhibits.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::exhibit::walked {

inline const std::vector<std::string> languages{"en", "de", "ar"};
inline constexpr std::size_t artifacts = 4;

inline const std::vector<std::string> keys{"attract_line",
                                           "slide_left",
                                           "slide_left_a_little",
                                           "slide_right",
                                           "slide_right_a_little",
                                           "slide_nearer",
                                           "slide_nearer_a_little",
                                           "slide_farther",
                                           "slide_farther_a_little",
                                           "slide_back_to_light",
                                           "turn_counter_clockwise",
                                           "turn_clockwise",
                                           "set_down",
                                           "stand_upright",
                                           "come_round_left",
                                           "come_round_right",
                                           "come_to_front",
                                           "uncover",
                                           "wait_tracker",
                                           "away_from_metal",
                                           "show_your_head",
                                           "fault.no_artifact"};

inline ExhibitPlace walked_place() {
    ExhibitPlace place = sample::shipped_place();
    for (const std::string& language : languages) {
        place.words.push_back(sample::words_of(language, keys, {0.12, 0.02}));
    }
    place.table_pictures = true;
    place.buttons = settings::button_commands.size();
    place.windows = {.count = 2, .size_m = {0.08, 0.08}};
    place.rest = std::chrono::seconds(20);
    return place;
}

/// The first has a behaviour for each trigger, the third two for the button.
inline std::vector<TriggeredBehaviour> behaviours_of(std::size_t artifact) {
    using enum world::Trigger;
    const std::vector<glm::dvec2> titles(languages.size(), {0.08, 0.01});
    std::vector<TriggeredBehaviour> behaviours;
    for (const world::Trigger trigger : {Button, Dwell, Hotspot, Narration, Arrival}) {
        if (artifact == 0) {
            behaviours.push_back({.trigger = trigger, .lasts = true, .title_sizes_m = titles});
        } else if (artifact == 2 && behaviours.size() < 2) {
            behaviours.push_back({.trigger = Button, .title_sizes_m = titles});
        }
    }
    return behaviours;
}

/// The first has a description and hotspots, the second a description, the third hotspots, the last nothing to tell.
inline Catalogue walked_catalogue() {
    CatalogueEntry entry{languages, {languages.size(), {{0.14, 0.04}}}};
    Catalogue catalogue(artifacts, entry);
    for (std::size_t k = 0; k < artifacts; ++k) {
        catalogue[k].behaviours = behaviours_of(k);
    }
    const std::vector<std::vector<glm::dvec2>> portions{{{0.14, 0.03}}, {{0.12, 0.04}}, {{0.13, 0.02}}};
    for (std::size_t k = 0; k < 3; ++k) {
        Tellable tellable;
        if (k < 2) {
            tellable.portions.assign(portions.size(), std::chrono::seconds(3));
            catalogue[k].descriptions.assign(languages.size(), {portions, largest_sizes(portions), false});
        }
        if (k != 1) {
            tellable.hotspots.assign(2, std::chrono::seconds(2));
            for (const double height_m : {0.01, 0.03}) {
                const Hotspot at{{0.0, -0.02, height_m}, {0.0, -1.0, 0.0}};
                catalogue[k].hotspots.hotspots.push_back({at, {languages.size(), {0.05, 0.01}}});
            }
        }
        catalogue[k].tellables.assign(languages.size(), tellable);
    }
    return catalogue;
}

inline Exhibit walked_exhibit() {
    return {walked_catalogue(), walked_place(), "en", sample::start};
}

/// Plays descriptions like a sound card, or plays nothing, or plays one that never ends.
class PlayingNarrator {
public:
    static constexpr Nanoseconds portion = std::chrono::seconds(4);

    void step(MonotonicTime now, const Presentation& shown, bench::Seeded& random) {
        if (shown.tells && shown.tells != told_) {
            const double dice = random.between(0.0, 1.0);
            silent_ = dice < 0.2;
            hangs_ = dice > 0.97;
            begins_ = now + std::chrono::milliseconds(static_cast<int>(random.between(0.0, 400.0)));
            narration_ = {silent_ ? SpeechProgress::State::Silent : SpeechProgress::State::Coming, 0};
        }
        told_ = shown.tells ? shown.tells : shown.leaves ? told_ : std::nullopt;
        if (!told_) {
            narration_ = {};
        }
        if (narration_.state == SpeechProgress::State::Coming && now >= begins_) {
            narration_.state = SpeechProgress::State::Heard;
        }
        if (narration_.state == SpeechProgress::State::Heard && !hangs_) {
            const auto gone = static_cast<std::size_t>((now - begins_) / portion);
            const bool at_pause = gone > narration_.portion;
            narration_.portion = gone;
            if (gone >= 3 || (at_pause && shown.leaves)) {
                narration_.state = SpeechProgress::State::Over;
            }
        }
    }
    [[nodiscard]] const SpeechProgress& narration() const { return narration_; }
    [[nodiscard]] bool heard() const { return narration_.state == SpeechProgress::State::Heard; }

private:
    std::optional<DescriptionIndex> told_;
    SpeechProgress narration_;
    MonotonicTime begins_;
    bool silent_ = false;
    bool hangs_ = false;
};

} // namespace frustumscreen::exhibit::walked
