// The exhibit writes its status once a second. Other programs read it and derive a verdict.
#include "app/status/exhibit_verdict.h"
#include "app/status/status_report.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

TEST(RoomExample, Status) {
    // example
    StatusReport report; // by the exhibit
    report.written = {{}, MonotonicTime(std::chrono::seconds(100)), Sentence("boot")};
    report.state = "view";
    report.tracker = Sentence("no tracker is connected; plug it in");
    report.devices.tracker = DeviceReport({DeviceHealth::Away, "tracker.none"});
    const std::string file = status_json(report);

    KnownExhibit known; // by whoever asks, two seconds later
    known.status = parse_status(file, {MonotonicTime(std::chrono::seconds(102)), "boot"});
    EXPECT_EQ(known.status.age_s, 2.0);
    const ExhibitVerdict verdict = verdict_of(known);
    EXPECT_TRUE(verdict.runs && !verdict.well);
    EXPECT_EQ(verdict.id, "tracker.none");
    // end
}

} // namespace
} // namespace frustumscreen
