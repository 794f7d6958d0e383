// Reports from many drift measurements: a move of 2 mm is reported within minutes, and hands, objects on the
// table and light cause no report.
#include "app/drift/drift_check.h"
#include "tests/simulators/table/simulated_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace frustumscreen::drift {
namespace {

using std::chrono::minutes;

const std::vector<glm::dvec2> places_m{{-0.37, -0.22}, {0.37, 0.22}, {0.37, -0.22}, {-0.37, 0.22},
                                       {-0.12, -0.22}, {0.12, 0.22}, {0.12, -0.22}, {-0.12, 0.22},
                                       {-0.37, 0.0},   {0.37, 0.0}};

/// A camera at an angle above the table, 0.75 mm per pixel.
glm::dvec2 seen_at(const glm::dvec2& place_m) {
    const double depth = 1.0 + 0.15 * place_m.y - 0.05 * place_m.x;
    return glm::dvec2(640.0, 360.0) + glm::dvec2(1333.0 * place_m.x, -1300.0 * place_m.y) / depth;
}

DriftReference blank() {
    DriftReference blank;
    blank.marks_m = places_m;
    blank.marks_px.resize(places_m.size());
    return blank;
}

/// A measurement of all marks, each displaced by `way_m` and by noise.
MarkSet look(MonotonicTime time, const glm::dvec2& way_m, double noise_m,
             simulators::SeededNumbers& numbers) {
    MarkSet set{time, {}, {}};
    for (const glm::dvec2& place : places_m) {
        set.marks_px.emplace_back(
            seen_at(place + way_m + noise_m * glm::dvec2(numbers.normal(), numbers.normal())));
    }
    return set;
}

class Check : public ::testing::Test {
protected:
    /// One measurement per minute.
    void look_at(const glm::dvec2& way_m, int times, double noise_m = 1.5e-4) {
        for (int k = 0; k < times; ++k) {
            now += minutes(1);
            stored += check.take(look(now, way_m, noise_m, numbers)) ? 1 : 0;
        }
    }
    [[nodiscard]] DriftState state() const { return check.verdict().state; }

    DriftCheck check{blank()};
    simulators::SeededNumbers numbers{3};
    MonotonicTime now{};
    int stored = 0;
};

TEST_F(Check, LearnsFromTheFirstLooksThatAgree) {
    EXPECT_EQ(state(), DriftState::Learning);
    look_at({0.0, 0.0}, 2);
    look_at({0.01, 0.0}, 2); // a person is still at work
    EXPECT_EQ(stored, 0);
    look_at({0.01, 0.0}, 1);
    EXPECT_EQ(stored, 1);
    EXPECT_EQ(state(), DriftState::Well);
    look_at({0.01, 0.0}, 10);
    EXPECT_EQ(stored, 1);
    EXPECT_EQ(state(), DriftState::Well);
    EXPECT_LT(check.verdict().off_m, 4e-4);
}

TEST_F(Check, LeavesOutMarksThatWereDisplacedWhileLearning) {
    for (int k = 0; k < 3; ++k) {
        now += minutes(1);
        MarkSet set = look(now, {}, 1.5e-4, numbers);
        for (std::size_t mark = 0; mark < 3; ++mark) { // covered by the prop
            *set.marks_px[mark] += glm::dvec2(40.0, -25.0);
        }
        stored += check.take(set) ? 1 : 0;
    }
    ASSERT_EQ(stored, 1);
    for (std::size_t mark = 0; mark < places_m.size(); ++mark) {
        EXPECT_EQ(check.reference().marks_px[mark].has_value(), mark >= 3) << mark;
    }
    look_at({0.004, 0.0}, 5);
    EXPECT_EQ(state(), DriftState::Moved);
    EXPECT_NEAR(check.verdict().off_m, 0.004, 4e-4);
}

TEST_F(Check, ReportsAMoveAfterFiveLooksAndItsEnd) {
    look_at({}, 8);
    look_at({0.0025, 0.0}, 4);
    EXPECT_EQ(state(), DriftState::Well) << "four looks are not enough";
    look_at({0.0025, 0.0}, 1);
    EXPECT_EQ(state(), DriftState::Moved);
    EXPECT_NEAR(check.verdict().off_m, 0.0025, 3e-4);
    EXPECT_FALSE(check.verdict().anchored);
    look_at({0.0018, 0.0}, 10);
    EXPECT_EQ(state(), DriftState::Moved) << "between the limits nothing changes";
    look_at({0.0005, 0.0}, 6);
    EXPECT_EQ(state(), DriftState::Well);
}

TEST_F(Check, IgnoresAMoveOfOneMillimetre) {
    look_at({}, 8);
    look_at({0.0, 0.001}, 30);
    EXPECT_EQ(state(), DriftState::Well);
}

TEST_F(Check, IgnoresLooksThatDisagree) {
    look_at({}, 8);
    for (int k = 0; k < 20; ++k) {
        look_at({k % 2 == 0 ? 0.01 : -0.01, 0.0}, 1);
        EXPECT_EQ(state(), DriftState::Well);
    }
}

TEST_F(Check, ComparesWithTheStoredReferenceAfterARestart) {
    look_at({}, 8);
    DriftCheck after(blank());
    after.know(check.reference());
    EXPECT_EQ(after.verdict().state, DriftState::Looking);
    for (int k = 0; k < 5; ++k) {
        now += minutes(1);
        EXPECT_FALSE(after.take(look(now, {0.0, -0.003}, 1.5e-4, numbers)));
    }
    EXPECT_EQ(after.verdict().state, DriftState::Moved);
}

TEST_F(Check, ReportsInvisibleMarksAsBlind) {
    look_at({}, 8);
    for (int k = 0; k < 5; ++k) {
        now += minutes(1);
        MarkSet hidden = look(now, {}, 1e-4, numbers);
        for (std::size_t mark = 0; mark < 7; ++mark) {
            hidden.marks_px[mark].reset();
        }
        EXPECT_FALSE(check.take(hidden));
    }
    EXPECT_EQ(state(), DriftState::Blind);
    look_at({}, 5);
    EXPECT_EQ(state(), DriftState::Well);
}

/// Tags on the table: corners of three, seen by a camera that was pushed.
std::vector<AnchorTag> anchors(const glm::dvec2& camera_way_px, std::size_t count) {
    const std::vector<glm::dvec2> middles{{-0.42, -0.27}, {0.42, -0.27}, {0.0, 0.28}};
    std::vector<AnchorTag> tags;
    for (std::size_t k = 0; k < count; ++k) {
        AnchorTag tag{static_cast<int>(100 + k), {}};
        const std::array<glm::dvec2, 4> corners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            tag.corners_px.at(corner) = seen_at(middles[k] + 0.02 * corners.at(corner)) + camera_way_px;
        }
        tags.push_back(tag);
    }
    return tags;
}

/// The camera was pushed by 8 pixels, 6 mm; the projector by `projector_way_m`.
DriftMeasure pushed(const glm::dvec2& projector_way_m, std::size_t tags, simulators::SeededNumbers& numbers) {
    DriftCheck check(blank());
    for (int k = 0; k < 3; ++k) {
        MarkSet set = look(MonotonicTime(minutes(k)), {}, 1e-4, numbers);
        set.anchors = anchors({}, tags);
        static_cast<void>(check.take(set));
    }
    const glm::dvec2 camera_way_px(7.0, -4.0);
    MarkSet set = look(MonotonicTime(minutes(9)), projector_way_m, 1e-4, numbers);
    for (std::optional<glm::dvec2>& mark : set.marks_px) {
        *mark += camera_way_px;
    }
    set.anchors = anchors(camera_way_px, tags);
    return *measure_drift(check.reference(), set);
}

TEST(Anchors, SeparateMovesOfTheCameraFromThoseOfTheProjector) {
    simulators::SeededNumbers numbers(5);
    const DriftMeasure camera_alone = pushed({}, 3, numbers);
    EXPECT_TRUE(camera_alone.anchored);
    EXPECT_LT(camera_alone.off_m, 5e-4);
    EXPECT_NEAR(pushed({0.004, 0.0}, 3, numbers).off_m, 0.004, 5e-4);
    const DriftMeasure two_tags = pushed({}, 2, numbers);
    EXPECT_FALSE(two_tags.anchored) << "two tags are not enough";
    EXPECT_NEAR(two_tags.off_m, 0.006, 1e-3);
}

TEST(Anchors, IgnoreTagsThatWereMoved) {
    simulators::SeededNumbers numbers(6);
    DriftReference reference = blank();
    const MarkSet first = look({}, {}, 0.0, numbers);
    reference.marks_px = first.marks_px;
    reference.anchors = anchors({}, 3);
    MarkSet now = first;
    now.anchors = anchors({}, 3);
    EXPECT_TRUE(measure_drift(reference, now)->anchored);
    for (glm::dvec2& corner : now.anchors[1].corners_px) {
        corner += glm::dvec2(0.0, 30.0);
    }
    std::swap(now.anchors[2].corners_px[0], now.anchors[2].corners_px[2]); // and one was turned
    EXPECT_FALSE(measure_drift(reference, now)->anchored);
    EXPECT_LT(measure_drift(reference, now)->off_m, 1e-9);
}

// Days of a museum: 240 measurements per day, 300 days per year.

struct Days {
    int alarms = 0;
    int looks = 0;
};

/// Events on a table between the measurements: objects that lie there for a while, people, a table that is
/// leaned on (its light moves only by parallax), a projector that warms up.
class Museum {
public:
    explicit Museum(std::uint64_t seed) : numbers_(seed) {}
    MarkSet next(MonotonicTime time, int look_of_day) {
        const double warm_m = 6e-4 * (1.0 - std::exp(-look_of_day / 30.0));
        if (numbers_.between(0.0, 1.0) < 1.0 / 500.0) {
            leans_for_ = 1 + static_cast<int>(numbers_.below(10));
            lean_m_ = 3e-4 * glm::dvec2(numbers_.normal(), numbers_.normal());
        }
        const glm::dvec2 all_m = glm::dvec2(warm_m, 0.0) + (leans_for_-- > 0 ? lean_m_ : glm::dvec2(0.0)) +
                                 (numbers_.between(0.0, 1.0) < 1.0 / 1000.0
                                      ? 5e-3 * glm::dvec2(numbers_.normal(), numbers_.normal())
                                      : glm::dvec2(0.0)); // a bump against the table
        MarkSet set = look(time, all_m, 1.5e-4, numbers_);
        lay_things(set);
        disturb(set);
        return set;
    }

private:
    /// A leaflet, a bag, the prop: it covers up to three marks, or raises their light.
    void lay_things(MarkSet& set) {
        if (numbers_.between(0.0, 1.0) < 1.0 / 40.0 && thing_for_ <= 0) {
            thing_for_ = 1 + static_cast<int>(numbers_.below(120));
            first_ = numbers_.below(set.marks_px.size());
            count_ = 1 + numbers_.below(3);
            hides_ = numbers_.below(2) == 0;
            thing_px_ = 40.0 * glm::dvec2(numbers_.normal(), numbers_.normal());
        }
        for (std::size_t k = 0; thing_for_ > 0 && k < count_; ++k) {
            std::optional<glm::dvec2>& mark = set.marks_px[(first_ + k) % set.marks_px.size()];
            mark = hides_ ? std::nullopt : std::optional(*mark + thing_px_);
        }
        --thing_for_;
    }
    /// People pass: some marks are seen elsewhere, or not at all.
    void disturb(MarkSet& set) {
        if (numbers_.between(0.0, 1.0) < 0.02) {
            for (std::size_t k = numbers_.below(6); k > 0; --k) {
                std::optional<glm::dvec2>& mark = set.marks_px[numbers_.below(set.marks_px.size())];
                if (mark && numbers_.below(2) == 0) {
                    *mark += glm::dvec2(60.0 * numbers_.normal(), 60.0 * numbers_.normal());
                } else {
                    mark.reset();
                }
            }
        }
    }
    simulators::SeededNumbers numbers_;
    int leans_for_ = 0, thing_for_ = 0;
    glm::dvec2 lean_m_{0.0}, thing_px_{0.0};
    std::size_t first_ = 0, count_ = 0;
    bool hides_ = false;
};

Days days(int count, std::uint64_t seed) {
    Days out;
    Museum museum(seed);
    DriftCheck check(blank());
    MonotonicTime now{};
    DriftState before = DriftState::Learning;
    for (int day = 0; day < count; ++day) {
        for (int k = 0; k < 240; ++k) {
            now += minutes(2);
            static_cast<void>(check.take(museum.next(now, k)));
            out.alarms += check.verdict().state == DriftState::Moved && before != DriftState::Moved ? 1 : 0;
            before = check.verdict().state;
            ++out.looks;
        }
        now += std::chrono::hours(16);
    }
    return out;
}

TEST(MuseumDays, CauseNoFalseAlarm) {
    EXPECT_EQ(days(60, 1).alarms, 0);
}

TEST(MuseumDays, DISABLED_CauseFewFalseAlarmsOverManyYears) {
    Days all;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Days year = days(300, seed);
        all.alarms += year.alarms;
        all.looks += year.looks;
    }
    std::printf("20 years, %d looks: %d wrong alarms\n", all.looks, all.alarms);
    EXPECT_LE(all.alarms, 2);
    // A real move in equal days: the number of measurements until it is reported.
    for (const double way_m : {2.2e-3, 2.5e-3, 3e-3, 5e-3}) {
        int told = 0, most = 0;
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            Museum museum(seed);
            DriftCheck check(blank());
            MonotonicTime now{};
            for (int k = 0; k < 60; ++k) {
                now += minutes(1);
                static_cast<void>(check.take(museum.next(now, 200)));
            }
            for (int k = 1; k <= 120; ++k) {
                now += minutes(1);
                MarkSet set = museum.next(now, 200);
                for (std::size_t mark = 0; mark < set.marks_px.size(); ++mark) {
                    if (set.marks_px[mark]) {
                        *set.marks_px[mark] +=
                            seen_at(places_m[mark] + glm::dvec2(0.0, way_m)) - seen_at(places_m[mark]);
                    }
                }
                static_cast<void>(check.take(set));
                if (check.verdict().state == DriftState::Moved) {
                    ++told;
                    sum += k;
                    most = std::max(most, k);
                    break;
                }
            }
        }
        std::printf("moved by %.1f mm: told in %d of 100, after %.1f looks on average, %d at most\n",
                    1e3 * way_m, told, sum / std::max(1, told), most);
    }
}

} // namespace
} // namespace frustumscreen::drift
