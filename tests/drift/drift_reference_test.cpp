// The reference as a file: what was written is read back, and what is no reference is said in one line.
#include "app/drift/drift_reference.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

DriftReference some_reference() {
    DriftReference reference{"calibration-0003.toml", "2026-11-25 10:12 UTC", 1280, 720, {}, {}, {}};
    reference.marks_m = {{-0.3, -0.2}, {0.3, 0.2}, {0.3, -0.2}};
    reference.marks_px = {glm::dvec2(100.25, 90.5), std::nullopt, glm::dvec2(1100.125, 600.0)};
    reference.anchors = {{7, {{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}, {7.0, 8.5}}}}};
    return reference;
}

TEST(DriftReference, IsReadBackAsItWasWritten) {
    const DriftReference written = some_reference();
    const Result<DriftReference> read = parse_drift_reference(drift_reference_text(written), "drift.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->fits(written.calibration, written.made, written.marks_m));
    EXPECT_EQ(read->marks_px, written.marks_px);
    EXPECT_EQ(read->anchors.at(0).corners_px, written.anchors[0].corners_px);
    EXPECT_EQ(drift_reference_text(*read), drift_reference_text(written));
}

TEST(DriftReference, FitsItsOwnCalibrationAlone) {
    const DriftReference one = some_reference();
    EXPECT_FALSE(one.fits("calibration-0004.toml", one.made, one.marks_m));
    EXPECT_FALSE(one.fits(one.calibration, "2026-11-26 10:12 UTC", one.marks_m));
    EXPECT_FALSE(one.fits(one.calibration, one.made, {{-0.3, -0.2}, {0.3, 0.2}}));
    EXPECT_FALSE(one.fits(one.calibration, one.made, {{-0.3, -0.2}, {0.3, 0.2}, {0.3, -0.21}}));
}

TEST(DriftReference, WhatIsNoneIsSaid) {
    const std::string good = drift_reference_text(some_reference());
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    for (const std::string& bad :
         {std::string(), std::string("{}"), std::string("[1, 2]"), std::string("nothing"),
          good.substr(0, good.size() / 2), with("\"version\": 1", "\"version\": 2"), with("1280", "-1280"),
          with("100.25", "\"a\""), with("100.25", "1e999"), with("\"anchors\"", "\"anchor\"")}) {
        const Result<DriftReference> read = parse_drift_reference(bad, "drift.json");
        ASSERT_FALSE(read) << bad;
        EXPECT_NE(read.error().message.find("drift.json: no places of marks can be read"), std::string::npos);
    }
}

} // namespace
} // namespace frustumscreen
