// A million things (fewer under the sanitizers) happen to the exhibit in any order; what must hold does, at each of them.

#include "app/bench/truth/seeded_situations.h"
#include "app/exhibit/guidance_setup.h"
#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace frustumscreen {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const std::vector<std::string> languages{"en", "de", "ar"};
constexpr std::size_t artifacts = 4;

const std::vector<std::string> keys{"attract_line",
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
                                    "show_your_head"};

ExhibitPlace walked_place() {
    const Settings shipped;
    ExhibitPlace place;
    place.prop = make_prop(shipped.prop);
    place.lens_m = shipped.projector.table_from_projector.translation;
    place.picture_m = picture_on_table(shipped, 0.0);
    place.guidance = guidance_setup(shipped);
    for (const std::string& language : languages) {
        AdviceLanguage words{language, {}};
        for (const std::string& key : keys) {
            words.texts.push_back({key, {{0.12, 0.02}}});
        }
        place.words.push_back(words);
    }
    place.table_pictures = true;
    place.buttons = button_commands.size();
    place.rest = seconds(20);
    return place;
}

Exhibit walked_exhibit() {
    const CatalogueEntry entry{languages, {languages.size(), {{0.14, 0.04}}}};
    return {Catalogue(artifacts, entry), walked_place(), "en", sample::start};
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool a_share(double value) {
    return value >= 0.0 && value <= 1.0; // and no NaN
}

class Walk {
public:
    explicit Walk(std::uint64_t seed) : random_(seed) { situation_.eye_m = {0.0, -0.55, 0.5}; }

    /// One thing happens, or only time passes.
    void step() {
        commands_.clear();
        const double dice = random_.between(0.0, 1.0);
        if (dice < 0.02) {
            commands_.push_back(button_commands.at(static_cast<std::size_t>(random_.between(0.0, 4.999))));
        } else if (dice < 0.022) {
            commands_.push_back(Command::StaffMode);
        } else if (dice < 0.03) {
            move_prop();
        } else if (dice < 0.045) {
            nudge_prop();
        } else if (dice < 0.064) {
            lost_ = lost_ ? std::nullopt : std::optional(now_);
        } else if (dice < 0.066) {
            situation_.head_known = !situation_.head_known;
        } else if (dice < 0.068) {
            look_from_elsewhere();
        } else if (dice < 0.069) {
            situation_.tracker = random_.happens(0.6)   ? TrackerHealth::Well
                                 : random_.happens(0.5) ? TrackerHealth::MetalNear
                                                        : TrackerHealth::Away;
        }
        go_on(time_to_pass());
    }

    /// Nobody does anything: in the end the exhibit attracts.
    void rest() {
        commands_.clear();
        for (int k = 0; k < 95; ++k) { // a minute of staff, then the rest
            go_on(seconds(1));
        }
        EXPECT_EQ(shown_.state, State::Attract);
        EXPECT_EQ(shown_.language, languages.front());
    }

    std::array<long, state_count> visits{};
    long spoken = 0;
    long chosen = 0;

private:
    Nanoseconds time_to_pass() {
        const double dice = random_.between(0.0, 1.0);
        const double ms = dice < 0.97    ? random_.between(1.0, 25.0)
                          : dice < 0.998 ? random_.between(25.0, 3000.0)
                                         : random_.between(3000.0, 150000.0);
        return milliseconds(static_cast<int>(ms));
    }

    /// Somewhere on the table, onto one of its pictures, or now and then as somebody may leave it.
    void move_prop() {
        moved_ = true;
        RigidTransform& pose = situation_.table_from_prop;
        if (random_.happens(0.025)) {
            pose = seeded_situation(*walked_.guidance, random_).table_from_prop;
        } else if (random_.happens(0.5) && shown_.table != nullptr && shown_.table->count > 0) {
            const auto which = static_cast<std::size_t>(
                random_.between(0.0, static_cast<double>(shown_.table->count) - 0.001));
            pose = {{1.0, 0.0, 0.0, 0.0},
                    glm::dvec3(shown_.table->pictures()[which].place.picture.centre_m, 0.0)};
        } else {
            pose = {{1.0, 0.0, 0.0, 0.0}, {random_.between(-0.1, 0.1), random_.between(-0.05, 0.05), 0.0}};
        }
    }
    void nudge_prop() {
        situation_.table_from_prop.translation += 0.002 * glm::dvec3(random_.normal(), random_.normal(), 0.0);
    }
    void look_from_elsewhere() {
        const double azimuth = random_.happens(0.8) ? -1.57 : random_.between(-3.1, 3.1);
        situation_.eye_m = {0.6 * std::cos(azimuth), 0.6 * std::sin(azimuth), 0.5};
    }

    void go_on(Nanoseconds time) {
        now_ += time;
        situation_.time = now_;
        situation_.prop_age = lost_ ? now_ - *lost_ : Nanoseconds(0);
        situation_.prop_known = situation_.prop_age <= seconds(1);
        if (sounds_ && now_ >= sound_ends_) {
            sounds_.reset();
        }
        exhibit_.hear(sounds_.has_value());
        const std::size_t artifact = shown_.artifact;
        shown_ = exhibit_.step(now_, commands_, situation_);
        chosen += commands_.empty() && shown_.state == State::View && shown_.artifact != artifact ? 1 : 0;
        ++visits.at(static_cast<std::size_t>(shown_.state));
        check_sound(time < milliseconds(100));
        check_picture(time < milliseconds(100));
    }

    /// What is said lies on the table in words; when these go, it is left.
    void check_sound(bool watched) {
        if (shown_.falls_silent) {
            sounds_.reset();
        }
        // Words that fade in are not seen in their first step, and not where the prop was just put on them or the sign made
        // them go elsewhere in a long pause.
        EXPECT_TRUE(!owed_ || !sounds_ || shown_.advice || moved_ || !watched) << "a voice without its words";
        owed_ = false;
        moved_ = false;
        if (shown_.says) {
            ++spoken;
            EXPECT_FALSE(sounds_) << "two sentences at once";
            owed_ = !shown_.advice || shown_.advice->word != *shown_.says;
            sounds_ = shown_.says;
            sound_ends_ = now_ + milliseconds(static_cast<int>(random_.between(500.0, 5000.0)));
        }
        EXPECT_TRUE(!sounds_ || note_of(shown_.state).voice) << name_of(shown_.state) << " is not silent";
        EXPECT_TRUE(!sounds_ || !shown_.advice || shown_.advice->word == *sounds_)
            << "a voice under other words";
    }

    void check_picture(bool watched) {
        EXPECT_EQ(shown_.staff, shown_.state == State::Staff);
        EXPECT_NE(shown_.state, State::Fault);
        EXPECT_LT(shown_.artifact, artifacts);
        EXPECT_TRUE(a_share(shown_.brightness));
        EXPECT_TRUE(finite(shown_.table_from_prop.translation));
        EXPECT_NEAR(glm::length(shown_.table_from_prop.rotation), 1.0, 1e-6);
        // The artifact is dark for no longer than two fades, as far as somebody watches without a pause.
        const bool dark = shown_.brightness < 0.05;
        dark_since_ = !dark ? std::nullopt : dark_since_ && watched ? dark_since_ : std::optional(now_);
        EXPECT_TRUE(!dark_since_ || now_ - *dark_since_ < milliseconds(1200)) << "no picture";
        EXPECT_TRUE(!shown_.sign || a_share(shown_.sign->brightness));
        EXPECT_TRUE(!shown_.sign || note_of(shown_.state).sign);
        if (shown_.advice) {
            EXPECT_TRUE(a_share(shown_.advice->brightness));
            EXPECT_TRUE(finite(glm::dvec3(shown_.advice->rectangle.centre_m, 0.0)));
            EXPECT_LT(shown_.advice->word.text, keys.size());
        }
        EXPECT_TRUE(!shown_.caption || a_share(shown_.caption->brightness));
        EXPECT_EQ(shown_.lamps & 7U, 7U);
        ASSERT_NE(shown_.table, nullptr);
        EXPECT_TRUE(a_share(shown_.table->ring_full));
    }

    ExhibitPlace walked_ = walked_place();
    Exhibit exhibit_ = walked_exhibit();
    Seeded random_;
    Situation situation_;
    MonotonicTime now_ = sample::start;
    std::optional<MonotonicTime> lost_;
    std::vector<Command> commands_;
    Presentation shown_;
    std::optional<WordIndex> sounds_;
    MonotonicTime sound_ends_;
    bool moved_ = false;
    bool owed_ = false; ///< words for what is said
    std::optional<MonotonicTime> dark_since_;
};

/// The sanitizers take ten times as long, and find what they look for in fewer.
constexpr int events = synthetic::allocations_are_counted ? 1'000'000 : 50'000;

TEST(Walk, EventsFindNothingThatMustNotBe) {
    Walk walk(11);
    for (int k = 0; k < events && !::testing::Test::HasFailure(); ++k) {
        walk.step();
        if (k % 25'000 == 0) {
            walk.rest();
        }
        ASSERT_FALSE(::testing::Test::HasFailure()) << "at event " << k;
    }
    for (const StateNote& note : state_notes) {
        const bool comes = note.state != State::Fault && note.state != State::Describe;
        EXPECT_EQ(walk.visits.at(static_cast<std::size_t>(note.state)) > 100, comes) << note.name;
    }
    EXPECT_GT(walk.spoken, 100);
    EXPECT_GT(walk.chosen, 100);
}

} // namespace
} // namespace frustumscreen
