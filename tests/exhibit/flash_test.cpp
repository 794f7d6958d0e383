// The picture never flashes more than is safe for photosensitive people, whatever is pressed.

#include "tests/exhibit/exhibits.h"
#include "tests/exhibit/flash_counter.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

using sample::start;
constexpr Nanoseconds frame = std::chrono::nanoseconds(1'000'000'000 / 120);

std::vector<Luminance> wave(const std::function<double(double)>& value_at) {
    std::vector<Luminance> samples;
    for (MonotonicTime now = start; now < start + seconds(3); now += milliseconds(2)) {
        samples.push_back({now, value_at(to_seconds(now - start))});
    }
    return samples;
}

TEST(FlashCounter, CountsPairsOfOpposingChanges) {
    const auto square = [](double hz, double low, double high) {
        return wave([=](double t) { return std::fmod(hz * t, 1.0) < 0.5 ? high : low; });
    };
    const auto sine = [](double hz, double low, double high) {
        return wave([=](double t) {
            return low + 0.5 * (high - low) * (1.0 - std::cos(2.0 * std::numbers::pi * hz * t));
        });
    };
    for (int hz = 1; hz <= 9; ++hz) {
        EXPECT_EQ(max_flashes_per_second(square(hz, 0.0, 1.0)), hz);
        EXPECT_EQ(max_flashes_per_second(sine(hz, 0.0, 1.0)), hz);
        EXPECT_EQ(max_flashes_per_second(sine(hz, 0.0, 0.11)), hz);
        EXPECT_EQ(max_flashes_per_second(sine(hz, 0.0, 0.09)), 0) << "too small a change";
        EXPECT_EQ(max_flashes_per_second(square(hz, 0.81, 1.0)), 0) << "the darker one is bright";
        EXPECT_EQ(max_flashes_per_second(square(hz, 0.79, 0.9)), hz);
    }
    EXPECT_EQ(max_flashes_per_second(wave([](double t) { return t / 3.0; })), 0) << "one change is no pair";
    const auto trembling = wave([](double t) {
        return 0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * t) + 0.04 * std::sin(100.0 * t);
    });
    EXPECT_EQ(max_flashes_per_second(trembling), 1);
}

/// A pixel of an artifact and a pixel of its caption, both white in the picture, as a visitor sees them.
class Watched {
public:
    explicit Watched(std::size_t artifacts) : exhibit_(sample::exhibit(artifacts, {"en", "de", "fr"})) {}
    explicit Watched(Exhibit exhibit) : exhibit_(std::move(exhibit)) {}

    /// `lost`: since when the prop's pose is unknown.
    void look(MonotonicTime now, std::span<const settings::Command> commands,
              std::optional<MonotonicTime> lost = {}) {
        const Presentation shown = exhibit_.step(now, commands, sample::tracked_state(now, lost));
        artifact.push_back({now, shown.brightness});
        caption.push_back({now, shown.caption ? shown.caption->brightness : 0.0});
    }

    std::vector<Luminance> artifact;
    std::vector<Luminance> caption;

private:
    Exhibit exhibit_;
};

/// A press; or the staff's chord, twice at once, which undoes presses and shows no pattern.
void press(std::vector<settings::Command>& commands, std::mt19937& random) {
    if (random() % 8 == 0) {
        commands.insert(commands.end(), 2, settings::Command::StaffMode);
    } else {
        commands.push_back(settings::button_commands.at(random() % settings::button_commands.size()));
    }
}

/// With the prop at rest there are at most two flashes a second; a prop that is lost and found adds one.
TEST(Flashes, AtMostTwoPerSecondOrThreeIfThePropIsLost) {
    int most = 0;
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        Watched watched(2 + random() % 3);
        const bool loses_prop = seed % 2 == 1;
        MonotonicTime next = start;
        std::optional<MonotonicTime> lost;
        MonotonicTime turn = start + seconds(1);
        const unsigned slowest_ms = 1U << (1 + seed % 11); // 2 ms to 2 s
        for (MonotonicTime now = start; now < start + seconds(30); now += frame) {
            std::vector<settings::Command> commands;
            while (next <= now) {
                press(commands, random);
                next += milliseconds(1 + random() % slowest_ms);
            }
            if (loses_prop && now >= turn) {
                lost = lost ? std::nullopt : std::optional(now);
                turn += milliseconds(random() % (lost ? 4000 : 500));
            }
            watched.look(now, commands, lost);
        }
        for (const auto* samples : {&watched.artifact, &watched.caption}) {
            const int found = max_flashes_per_second(*samples);
            EXPECT_LE(found, loses_prop ? 3 : 2) << seed;
            most = std::max(most, found);
        }
    }
    EXPECT_GE(most, 2) << "nothing was seen of the presses";
}

/// Three artifacts with a description and two hotspots each.
Exhibit narration_exhibit() {
    const std::vector<std::vector<glm::dvec2>> sizes{{{0.2, 0.03}}, {{0.2, 0.06}}};
    CatalogueEntry entry{{"en", "de"}, {2, {{0.2, 0.05}}}};
    entry.tellables.assign(2, {{seconds(1), seconds(1)}, {seconds(1), seconds(1)}});
    entry.descriptions.assign(2, {sizes, largest_sizes(sizes), false});
    ExhibitPlace place = sample::place();
    place.buttons = settings::button_commands.size();
    return {Catalogue(3, entry), place, "en", start};
}

/// The caption's text has its own fades, which a change of artifact or language may interrupt.
TEST(Flashes, AtMostThreePerSecondDuringNarration) {
    int most = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        Watched watched(narration_exhibit());
        MonotonicTime next = start;
        const unsigned slowest_ms = 1U << (1 + seed % 11);
        for (MonotonicTime now = start; now < start + seconds(30); now += frame) {
            std::vector<settings::Command> commands;
            while (next <= now) {
                press(commands, random);
                next += milliseconds(1 + random() % slowest_ms);
            }
            watched.look(now, commands);
        }
        EXPECT_LE(max_flashes_per_second(watched.artifact), 2) << seed;
        EXPECT_LE(max_flashes_per_second(watched.caption), 3) << seed;
        most = std::max(most, max_flashes_per_second(watched.caption));
    }
    EXPECT_GE(most, 2) << "nothing was seen of the presses";
    // Choose and another button in turn, each at various brightnesses while fading in or out.
    for (const settings::Command other :
         {settings::Command::NextArtifact, settings::Command::NextLanguage, settings::Command::Help}) {
        for (int k = 0; k < 400; k += 3) {
            Watched watched(narration_exhibit());
            double before = 0.0;
            bool chooses = true;
            bool presses = false;
            for (MonotonicTime now = start; now < start + seconds(8); now += frame) {
                const settings::Command command = chooses ? settings::Command::Choose : other;
                watched.look(now, std::span(&command, presses ? 1 : 0));
                chooses = presses ? !chooses : chooses;
                const double seen = watched.caption.back().value;
                const int level = chooses ? k / 20 : k % 20;
                const bool rises = level < 10;
                presses = rises ? seen >= 0.1 * level && seen >= before
                                : seen <= 2.0 - 0.1 * level && seen < before;
                before = seen;
            }
            ASSERT_LE(max_flashes_per_second(watched.caption), 3) << k;
        }
    }
}

/// The worst case: presses at any brightness on its way up.
TEST(Flashes, AtMostTwoPerSecondForPressesAtTheWorstBrightness) {
    for (const settings::Command command : settings::button_commands) {
        const bool is_language = command == settings::Command::NextLanguage;
        int most = 0;
        for (int percent = 1; percent <= 100; percent += 3) {
            Watched watched(3);
            double before = 0.0;
            bool presses = false;
            for (MonotonicTime now = start; now < start + seconds(10); now += frame) {
                watched.look(now, std::span(&command, presses ? 1 : 0));
                const double seen =
                    is_language ? watched.caption.back().value : watched.artifact.back().value;
                presses = seen >= 0.01 * percent && seen >= before;
                before = seen;
            }
            const int artifact = max_flashes_per_second(watched.artifact);
            const int caption = max_flashes_per_second(watched.caption);
            EXPECT_LE(artifact, 2) << percent;
            EXPECT_LE(caption, 2) << percent;
            most = std::max(most, is_language ? caption : artifact);
        }
        const bool changes = is_language || command == settings::Command::NextArtifact ||
                             command == settings::Command::PreviousArtifact;
        EXPECT_EQ(most, changes ? 2 : 0) << "out and in again take half a second";
    }
}

} // namespace
} // namespace frustumscreen::exhibit
