// A million random events (fewer under the sanitizers), with the exhibit's invariants checked after each.

#include "app/bench/truth/seeded_situations.h"
#include "tests/exhibit/walked_exhibit.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using namespace walked;

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool a_share(double value) {
    return value >= 0.0 && value <= 1.0; // false for NaN
}

class Walk {
public:
    explicit Walk(std::uint64_t seed) : random_(seed) { tracked_state_.eye_m = {0.0, -0.55, 0.5}; }

    /// One event, or only time passes.
    void step() {
        commands_.clear();
        const double dice = random_.between(0.0, 1.0);
        if (dice < 0.02) {
            commands_.push_back(
                settings::button_commands.at(static_cast<std::size_t>(random_.between(0.0, 6.999))));
        } else if (dice < 0.022) {
            commands_.push_back(settings::Command::StaffMode);
        } else if (dice < 0.03) {
            move_prop();
        } else if (dice < 0.045) {
            nudge_prop();
        } else if (dice < 0.064) {
            lost_ = lost_ ? std::nullopt : std::optional(now_);
        } else if (dice < 0.066) {
            tracked_state_.head_known = !tracked_state_.head_known;
        } else if (dice < 0.068) {
            look_from_elsewhere();
        } else if (dice < 0.069) {
            tracked_state_.tracker = random_.happens(0.6)   ? tracker::TrackerHealth::Well
                                     : random_.happens(0.5) ? tracker::TrackerHealth::MetalNear
                                                            : tracker::TrackerHealth::Away;
        } else if (dice < 0.07) {
            change_packs();
        }
        go_on(time_to_pass());
    }

    /// Without events, the exhibit ends in State::Attract.
    void rest() {
        commands_.clear();
        packs_.fill(ArtifactState::Ready);
        // A minute of the staff's picture, then the rest; narration counts as presence, until it reaches its longest
        // time.
        for (int k = 0; k < 95 || (k < 400 && shown_.state != State::Attract); ++k) {
            go_on(seconds(1));
        }
        EXPECT_EQ(shown_.state, State::Attract);
        EXPECT_EQ(shown_.language, languages.front());
        EXPECT_TRUE(shown_.windows.windows().empty());
    }

    std::array<long, state_count> visits{};
    long spoken = 0;
    long described = 0;
    long pointed_out = 0;
    long chosen = 0;
    long toggled = 0;
    long begun_or_ended = 0;
    long titled = 0;
    long pinned = 0;

private:
    Nanoseconds time_to_pass() {
        const double dice = random_.between(0.0, 1.0);
        const double ms = dice < 0.97    ? random_.between(1.0, 25.0)
                          : dice < 0.998 ? random_.between(25.0, 3000.0)
                                         : random_.between(3000.0, 150000.0);
        return milliseconds(static_cast<int>(ms));
    }

    /// Moves the prop to some place on the table, onto a picture, or sometimes to an odd pose.
    void move_prop() {
        moved_ = true;
        geometry::RigidTransform& pose = tracked_state_.table_from_prop;
        if (random_.happens(0.025)) {
            pose = bench::seeded_situation(*walked_.guidance, random_).table_from_prop;
        } else if (random_.happens(0.5) && shown_.table != nullptr && shown_.table->count > 0) {
            const auto which = static_cast<std::size_t>(
                random_.between(0.0, static_cast<double>(shown_.table->count) - 0.001));
            pose = {{1.0, 0.0, 0.0, 0.0},
                    glm::dvec3(shown_.table->pictures()[which].place.picture.centre_m, 0.0)};
        } else {
            pose = {{1.0, 0.0, 0.0, 0.0}, {random_.between(-0.1, 0.1), random_.between(-0.05, 0.05), 0.0}};
        }
    }
    /// One pack becomes bad or good again; sometimes all of them do.
    void change_packs() {
        const bool all = random_.happens(0.1);
        const auto which =
            static_cast<std::size_t>(random_.between(0.0, static_cast<double>(artifacts) - 0.001));
        const ArtifactState state = random_.happens(0.4) ? ArtifactState::Unusable : ArtifactState::Away;
        all ? packs_.fill(state) : void(packs_[which] = state);
    }
    /// Wanted packs are loaded after a while, and unwanted ones may be released.
    void load_packs() {
        for (const std::size_t wanted : shown_.wanted.artifacts()) {
            if (packs_[wanted] == ArtifactState::Away && random_.happens(0.02)) {
                packs_[wanted] = ArtifactState::Ready;
            }
        }
        const auto which =
            static_cast<std::size_t>(random_.between(0.0, static_cast<double>(artifacts) - 0.001));
        const auto wanted = shown_.wanted.artifacts();
        if (packs_[which] == ArtifactState::Ready && which != shown_.artifact &&
            std::find(wanted.begin(), wanted.end(), which) == wanted.end()) {
            packs_[which] = ArtifactState::Away;
        }
    }
    [[nodiscard]] std::ptrdiff_t offered() const {
        return std::count_if(packs_.begin(), packs_.end(),
                             [](ArtifactState state) { return state != ArtifactState::Unusable; });
    }
    void nudge_prop() {
        tracked_state_.table_from_prop.translation +=
            0.002 * glm::dvec3(random_.normal(), random_.normal(), 0.0);
    }
    void look_from_elsewhere() {
        const double azimuth = random_.happens(0.8) ? -1.57 : random_.between(-3.1, 3.1);
        tracked_state_.eye_m = {0.6 * std::cos(azimuth), 0.6 * std::sin(azimuth), 0.5};
    }

    void go_on(Nanoseconds time) {
        now_ += time;
        tracked_state_.time = now_;
        tracked_state_.prop_age = lost_ ? now_ - *lost_ : Nanoseconds(0);
        tracked_state_.prop_known = tracked_state_.prop_age <= seconds(1);
        if (sounds_ && now_ >= sound_ends_) {
            sounds_.reset();
        }
        load_packs();
        exhibit_.note(packs_);
        exhibit_.hear(sounds_ || narrator_.heard(), narrator_.narration());
        const std::size_t artifact = shown_.artifact;
        shown_ = exhibit_.step(now_, commands_, tracked_state_);
        chosen += commands_.empty() && shown_.state == State::View && shown_.artifact != artifact ? 1 : 0;
        ++visits.at(static_cast<std::size_t>(shown_.state));
        narrator_.step(now_, shown_, random_);
        const bool watched = time < milliseconds(100);
        check_description(watched);
        check_packs(watched);
        check_sound(watched);
        check_behaviours();
        check_picture(watched);
    }

    /// Behaviours are those of an artifact on show, and a press is the only thing that toggles one.
    void check_behaviours() {
        const std::vector<TriggeredBehaviour>& of_artifact = behaviours_.at(shown_.artifact);
        for (const BehaviourEvent& event : shown_.behaviours.events()) {
            ASSERT_LT(event.behaviour, of_artifact.size());
            EXPECT_TRUE(note_of(shown_.state).artifact) << name_of(shown_.state);
            const bool toggles = event.kind == BehaviourEvent::Kind::Toggle;
            EXPECT_EQ(toggles, of_artifact[event.behaviour].trigger == world::Trigger::Button);
            EXPECT_TRUE(!toggles ||
                        std::count(commands_.begin(), commands_.end(), settings::Command::Behaviour) == 1);
            ++(toggles ? toggled : begun_or_ended);
        }
        EXPECT_TRUE(!shown_.title || a_share(shown_.title->brightness));
        titled += shown_.title ? 1 : 0;
    }

    /// Spoken sentences are visible as words; when the words go, the speech ends.
    void check_sound(bool watched) {
        if (shown_.falls_silent) {
            sounds_.reset();
        }
        // Words fade in, and move when the prop was put on them.
        note_since(mute_since_, sounds_ && !shown_.advice && !moved_, watched);
        EXPECT_TRUE(!mute_since_ || now_ - *mute_since_ < milliseconds(500)) << "a voice without its words";
        moved_ = false;
        if (shown_.says) {
            ++spoken;
            EXPECT_FALSE(sounds_ || narrator_.heard()) << "two voices at once";
            sounds_ = shown_.says;
            sound_ends_ = now_ + milliseconds(static_cast<int>(random_.between(500.0, 5000.0)));
        }
        EXPECT_TRUE(!sounds_ || note_of(shown_.state).voice) << name_of(shown_.state) << " is not silent";
        EXPECT_TRUE(!sounds_ || !shown_.advice || shown_.advice->word == *sounds_)
            << "a voice under other words";
    }

    /// Since when a condition has held without a gap in the observation.
    using Since = std::optional<MonotonicTime>;
    void note_since(Since& since, bool is, bool watched) const {
        since = !is ? std::nullopt : since && watched ? since : Since(now_);
    }

    /// A description that is heard is also shown, and lasts no longer than allowed.
    void check_description(bool watched) {
        const bool read = shown_.caption && shown_.caption->portion;
        described += shown_.state == State::Describe && read && narrator_.heard() ? 1 : 0;
        pointed_out += shown_.hotspot ? 1 : 0;
        note_since(unread_since_, narrator_.heard() && !read && !moved_, watched);
        EXPECT_TRUE(!unread_since_ || now_ - *unread_since_ < seconds(2)) << "a voice without its text";
        note_since(elsewhere_since_, narrator_.heard() && shown_.state != State::Describe, watched);
        EXPECT_TRUE(!elsewhere_since_ || now_ - *elsewhere_since_ < milliseconds(100))
            << name_of(shown_.state);
        note_since(told_since_, shown_.tells || shown_.leaves, true);
        EXPECT_TRUE(!told_since_ ||
                    now_ - *told_since_ < NarrationSequencer::longest_description + seconds(160))
            << "a description that does not end";
    }

    /// Left-out artifacts are not shown, and if none is left, words say so.
    void check_packs(bool watched) {
        note_since(left_out_since_, packs_.at(shown_.artifact) == ArtifactState::Unusable && offered() > 0,
                   watched);
        EXPECT_TRUE(!left_out_since_ || now_ - *left_out_since_ < milliseconds(1200))
            << "a pack that is left out";
        const bool fault = shown_.state == State::Fault;
        EXPECT_TRUE(!fault || offered() == 0);
        EXPECT_TRUE(!fault || !shown_.tells);
        note_since(fault_since_, fault && !moved_, watched);
        // In another language they fade out and in again, dark for a moment between.
        const bool said = shown_.advice && keys[shown_.advice->word.text] == "fault.no_artifact";
        note_since(unsaid_since_, fault && !said && !moved_, watched);
        EXPECT_TRUE(!unsaid_since_ || now_ - *unsaid_since_ < milliseconds(500))
            << "a fault without its words";
        if (fault_since_ && now_ - *fault_since_ > seconds(2)) {
            EXPECT_LT(shown_.brightness, 0.05);
            EXPECT_FALSE(shown_.caption);
            EXPECT_FALSE(shown_.hotspot);
        }
    }

    void check_picture(bool watched) {
        EXPECT_EQ(shown_.staff, shown_.state == State::Staff);
        EXPECT_LT(shown_.artifact, artifacts);
        EXPECT_TRUE(a_share(shown_.brightness));
        EXPECT_TRUE(finite(shown_.table_from_prop.translation));
        EXPECT_NEAR(glm::length(shown_.table_from_prop.rotation), 1.0, 1e-6);
        // The artifact is dark for at most two fades, as far as it is observed without a gap.
        const bool dark =
            shown_.brightness + (shown_.placeholder ? shown_.placeholder->brightness : 0.0) < 0.05;
        note_since(dark_since_, dark && offered() > 0, watched);
        EXPECT_TRUE(!dark_since_ || now_ - *dark_since_ < milliseconds(1200)) << "no picture";
        EXPECT_TRUE(!shown_.sign || a_share(shown_.sign->brightness));
        EXPECT_TRUE(!shown_.sign || note_of(shown_.state).sign);
        if (shown_.advice) {
            EXPECT_TRUE(a_share(shown_.advice->brightness));
            EXPECT_TRUE(finite(glm::dvec3(shown_.advice->rectangle.centre_m, 0.0)));
            EXPECT_LT(shown_.advice->word.text, keys.size());
        }
        EXPECT_TRUE(!shown_.caption || a_share(shown_.caption->brightness));
        // On the staff's picture each button is tested.
        EXPECT_EQ(shown_.lamps & 7U, offered() > 1 || shown_.staff ? 7U : 4U);
        ASSERT_NE(shown_.table, nullptr);
        EXPECT_TRUE(a_share(shown_.table->ring_full));
        EXPECT_LE(shown_.windows.windows().size(), settings::max_windows + 1);
        for (const PresentedWindow& window : shown_.windows.windows()) {
            EXPECT_TRUE(a_share(window.brightness));
            EXPECT_LT(window.artifact, artifacts);
            EXPECT_TRUE(finite(glm::dvec3(window.rectangle.centre_m, 0.0)));
            pinned += window.brightness >= 1.0 ? 1 : 0;
        }
    }

    ExhibitPlace walked_ = walked_place();
    Exhibit exhibit_ = walked_exhibit();
    std::array<std::vector<TriggeredBehaviour>, artifacts> behaviours_{behaviours_of(0), behaviours_of(1),
                                                                       behaviours_of(2), behaviours_of(3)};
    bench::Seeded random_;
    tracking::TrackedState tracked_state_;
    MonotonicTime now_ = sample::start;
    std::optional<MonotonicTime> lost_;
    std::vector<settings::Command> commands_;
    Presentation shown_;
    std::optional<WordIndex> sounds_;
    MonotonicTime sound_ends_;
    bool moved_ = false;
    std::array<ArtifactState, artifacts> packs_{};
    PlayingNarrator narrator_;
    Since dark_since_, mute_since_, left_out_since_, fault_since_, unsaid_since_, unread_since_, told_since_,
        elsewhere_since_;
};

/// Sanitizers take ten times as long, and fewer events are sufficient for them.
constexpr int events = synthetic::allocations_are_counted ? 1'000'000 : 75'000;

TEST(Walk, InvariantsHoldForRandomEvents) {
    Walk walk(11);
    for (int k = 0; k < events && !::testing::Test::HasFailure(); ++k) {
        walk.step();
        if (k % 25'000 == 0) {
            walk.rest();
        }
        ASSERT_FALSE(::testing::Test::HasFailure()) << "at event " << k;
    }
    for (const StateNote& note : state_notes) {
        EXPECT_GT(walk.visits.at(static_cast<std::size_t>(note.state)), 100) << note.name;
    }
    EXPECT_GT(walk.spoken, 100);
    EXPECT_GT(walk.chosen, 100);
    EXPECT_GT(walk.described, 100);
    EXPECT_GT(walk.pointed_out, 100);
    EXPECT_GT(walk.toggled, 100);
    EXPECT_GT(walk.begun_or_ended, 100);
    EXPECT_GT(walk.titled, 100);
    EXPECT_GT(walk.pinned, 100);
}

/// Frames that fall anywhere in the fades find the words, or one frame between the two languages does not.
TEST(Walk, FaultTextIsDarkForOneFrameOnALanguageChange) {
    Exhibit exhibit = walked_exhibit();
    exhibit.note(std::array{ArtifactState::Unusable, ArtifactState::Unusable, ArtifactState::Unusable,
                            ArtifactState::Unusable});
    MonotonicTime now = sample::start;
    int dark = 0;
    std::size_t language = 0;
    for (int k = 0; k < 300; ++k) {
        now += milliseconds(17);
        std::vector<settings::Command> commands;
        if (k == 150) {
            commands.push_back(settings::Command::NextLanguage);
        }
        const Presentation shown = exhibit.step(now, commands, sample::tracked_state(now));
        if (k < 50) {
            continue; // the words come
        }
        ASSERT_EQ(shown.state, State::Fault);
        dark += shown.advice ? 0 : 1;
        language = shown.advice ? shown.advice->word.language : language;
    }
    EXPECT_EQ(dark, 1);
    EXPECT_EQ(language, 1U);
}

} // namespace
} // namespace frustumscreen::exhibit
