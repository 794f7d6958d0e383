// The reference as a file: a written file is read back, and an invalid one is reported in one line.
#include "app/drift/drift_reference.h"
#include "app/drift/mark_places.h"
#include "app/settings/calibration.h"
#include "app/settings/settings.h"

#include <gtest/gtest.h>

namespace frustumscreen::drift {
namespace {

DriftReference some_reference() {
    DriftReference reference{1280, 720, {}, {}, {}};
    reference.marks_m = {{-0.3, -0.2}, {0.3, 0.2}, {0.3, -0.2}};
    reference.marks_px = {glm::dvec2(100.25, 90.5), std::nullopt, glm::dvec2(1100.125, 600.0)};
    reference.anchors = {{7, {{{1.0, 2.0}, {3.0, 4.0}, {5.0, 6.0}, {7.0, 8.5}}}}};
    return reference;
}

TEST(DriftReference, RoundTrip) {
    const DriftReference written = some_reference();
    const Result<DriftReference> read = parse_drift_reference(drift_reference_text(written), "drift.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->fits(written.marks_m));
    EXPECT_EQ(read->marks_px, written.marks_px);
    EXPECT_EQ(read->anchors.at(0).corners_px, written.anchors[0].corners_px);
    EXPECT_EQ(drift_reference_text(*read), drift_reference_text(written));
}

TEST(DriftReference, FitsOnlyItsOwnMarks) {
    const DriftReference one = some_reference();
    EXPECT_FALSE(one.fits({{-0.3, -0.2}, {0.3, 0.2}}));
    EXPECT_FALSE(one.fits({{-0.3, -0.2}, {0.3, 0.2}, {0.3, -0.21}}));
    EXPECT_FALSE(one.fits({{-0.3, -0.2}, {0.3, 0.2}, {0.3, -0.200001}}))
        << "another calibration of the same table";
}

settings::Calibration some_calibration() {
    const settings::ProjectorSettings projector;
    settings::Calibration calibration;
    calibration.made = "2026-11-25 10:12 UTC";
    calibration.places = 9;
    calibration.pinhole = projector.pinhole;
    calibration.pinhole.fx = 3601.123456789;
    calibration.table_from_projector = {glm::normalize(glm::dquat(0.002, 0.9999, 0.003, -0.001)),
                                        {0.003, -0.004, 1.49}};
    calibration.registration.table_from_tracker = {glm::normalize(glm::dquat(0.7, 0.1, 0.2, 0.3)),
                                                   {0.1, 0.2, 0.3}};
    return calibration;
}

/// The positions lit by a calibration after it was written and read again.
std::vector<glm::dvec2> marks_by(settings::Calibration& calibration) {
    const Result<settings::Calibration> kept =
        settings::parse_calibration(settings::calibration_text(calibration), "kept.toml");
    EXPECT_TRUE(kept) << kept.error().message;
    calibration = *kept;
    settings::Settings settings;
    settings.projector.pinhole = calibration.pinhole;
    settings.projector.table_from_projector = calibration.table_from_projector;
    return mark_places(settings);
}

TEST(DriftReference, FitsUntilTheProjectorMoves) {
    settings::Calibration calibration = some_calibration();
    DriftReference reference;
    reference.marks_m = marks_by(calibration);
    ASSERT_EQ(reference.marks_m.size(), max_marks);
    calibration.made = "2026-11-26 09:00 UTC"; // the eye was measured, and the tracker's source moved
    calibration.registration.eye_in_sensor_m = {0.01, 0.05, -0.07};
    calibration.registration.table_from_tracker.translation.x += 0.02;
    EXPECT_TRUE(reference.fits(marks_by(calibration)));
    EXPECT_TRUE(reference.fits(marks_by(calibration))) << "and kept once more";
    calibration.table_from_projector.translation.x += 1e-5;
    EXPECT_FALSE(reference.fits(marks_by(calibration)));
}

TEST(DriftReference, RejectsMalformedText) {
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
        EXPECT_EQ(read.error().id, "drift.unreadable_reference");
        EXPECT_EQ(read.error().message.find("drift.json: "), 0U) << read.error().message;
    }
}

} // namespace
} // namespace frustumscreen::drift
