// The exhibit writes its status once a second. Other programs read it and derive a verdict.
#include "app/status/exhibit_verdict.h"
#include "app/status/status_report.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Status) {
    // example
    status::StatusReport report; // by the exhibit
    report.written = {{}, MonotonicTime(std::chrono::seconds(100)), Sentence("boot")};
    report.state = "view";
    report.tracker = Sentence("no tracker is connected; plug it in");
    report.devices.tracker = status::DeviceReport({DeviceHealth::Away, "tracker.none"});
    const std::string file = status::status_json(report);

    status::KnownExhibit known; // by another program, two seconds later
    known.status = status::parse_status(file, {MonotonicTime(std::chrono::seconds(102)), "boot"});
    EXPECT_EQ(known.status.age_s, 2.0);
    const status::ExhibitVerdict verdict = status::verdict_of(known);
    EXPECT_TRUE(verdict.runs && !verdict.well);
    EXPECT_EQ(verdict.id, "tracker.none");
    // end
}

} // namespace
} // namespace frustumscreen::example
