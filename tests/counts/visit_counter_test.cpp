// When a visit begins and ends, and to what its time is counted: every length is known beforehand.
#include "app/counts/visit_counter.h"

#include <gtest/gtest.h>

namespace frustumscreen::counts {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// An exhibit of 50 frames a second that rests after 60 s, as the settings have it.
class Exhibit {
public:
    void touch() {
        used_ = now_;
        rests_ = false;
    }
    void stand_idle(Nanoseconds length) {
        for (const MonotonicTime end = now_ + length; now_ < end;) {
            now_ += milliseconds(20);
            rests_ = rests_ || (used_ && now_ - *used_ >= seconds(60));
            frame();
        }
    }
    void frame() { counter_.step({now_, used_, rests_ && !staff, staff, artifact, language}, pieces); }
    void end() { counter_.end(now_, pieces); }

    [[nodiscard]] Nanoseconds length() const {
        Nanoseconds sum{0};
        for (const VisitPiece& piece : pieces) {
            sum += piece.length;
        }
        return sum;
    }
    [[nodiscard]] int count(bool VisitPiece::*which) const {
        int sum = 0;
        for (const VisitPiece& piece : pieces) {
            sum += piece.*which ? 1 : 0;
        }
        return sum;
    }

    std::vector<VisitPiece> pieces;
    std::string_view artifact = "Amphora", language = "en";
    bool staff = false;

private:
    VisitCounter counter_;
    MonotonicTime now_{seconds(1000)};
    std::optional<MonotonicTime> used_;
    bool rests_ = true;
};

TEST(VisitCounter, CountsAVisitFromFirstTouchUntilRest) {
    Exhibit exhibit;
    exhibit.stand_idle(seconds(300));
    EXPECT_TRUE(exhibit.pieces.empty()) << "no visitor was present";
    exhibit.touch();
    exhibit.stand_idle(seconds(30));
    exhibit.touch();
    exhibit.stand_idle(seconds(200));
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 1);
    EXPECT_NEAR(to_seconds(exhibit.length()), 90.0, 0.05) << "30 s of use, 60 s until it rests";
    for (const VisitPiece& piece : exhibit.pieces) {
        EXPECT_LE(piece.length, VisitCounter::longest_piece + milliseconds(20));
    }
    exhibit.touch();
    exhibit.stand_idle(seconds(100));
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 2);
    EXPECT_NEAR(to_seconds(exhibit.length()), 150.0, 0.1);
}

TEST(VisitCounter, AddsTimeToTheShownArtifactAndLanguage) {
    Exhibit exhibit;
    exhibit.touch();
    exhibit.stand_idle(seconds(10));
    exhibit.artifact = "Cup";
    exhibit.touch();
    exhibit.stand_idle(seconds(20));
    exhibit.artifact = "Amphora"; // again
    exhibit.language = "de";
    exhibit.touch();
    exhibit.stand_idle(seconds(100));
    double amphora_s = 0.0;
    double cup_s = 0.0;
    double german_s = 0.0;
    for (const VisitPiece& piece : exhibit.pieces) {
        (piece.artifact.view() == "Cup" ? cup_s : amphora_s) += to_seconds(piece.length);
        german_s += piece.language.view() == "de" ? to_seconds(piece.length) : 0.0;
    }
    EXPECT_NEAR(cup_s, 20.0, 0.1);
    EXPECT_NEAR(amphora_s, 70.0, 0.1);
    EXPECT_NEAR(german_s, 60.0, 0.1);
    EXPECT_EQ(exhibit.count(&VisitPiece::new_artifact), 2) << "the amphora was shown twice in one visit";
    EXPECT_EQ(exhibit.count(&VisitPiece::new_language), 2);
}

TEST(VisitCounter, IgnoresStaff) {
    Exhibit exhibit;
    exhibit.touch(); // both buttons: their presses are reported at once
    exhibit.artifact = "Cup";
    exhibit.stand_idle(seconds(3));
    exhibit.staff = true;
    exhibit.stand_idle(seconds(60));
    exhibit.staff = false;
    exhibit.touch(); // the press that ends their picture
    exhibit.stand_idle(seconds(100));
    EXPECT_TRUE(exhibit.pieces.empty());
    exhibit.touch();
    exhibit.stand_idle(seconds(100));
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 1) << "it has rested since";
}

TEST(VisitCounter, EndsAVisitWhenStaffInterrupt) {
    Exhibit exhibit;
    exhibit.touch();
    exhibit.stand_idle(seconds(40));
    exhibit.staff = true;
    exhibit.stand_idle(seconds(60));
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 1);
    EXPECT_NEAR(to_seconds(exhibit.length()), 40.0, 0.05);
}

TEST(VisitCounter, EndsAVisitAtTheEndOfTheRun) {
    Exhibit exhibit;
    exhibit.touch();
    exhibit.stand_idle(seconds(2));
    EXPECT_TRUE(exhibit.pieces.empty()) << "it may be the staff's yet";
    exhibit.end();
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 1);
    EXPECT_NEAR(to_seconds(exhibit.length()), 2.0, 0.05);
}

TEST(VisitCounter, LosesNoTimeUnderFrequentTouches) {
    Exhibit exhibit;
    exhibit.touch();
    for (int k = 0; k < 2000; ++k) {
        exhibit.artifact = k % 3 == 0 ? "Amphora" : k % 3 == 1 ? "Cup" : "Bust";
        exhibit.touch();
        exhibit.stand_idle(milliseconds(40));
    }
    exhibit.end();
    EXPECT_EQ(exhibit.length(), seconds(80) - milliseconds(20)) << "from the first frame that saw the touch";
    EXPECT_EQ(exhibit.count(&VisitPiece::begins), 1);
    EXPECT_EQ(exhibit.count(&VisitPiece::new_artifact), 3);
}

} // namespace
} // namespace frustumscreen::counts
