/// Fixture for the bench's tests that draw: the picture of near_settings.h's small projector.
#pragma once

#include "app/bench/measures/measure.h"
#include "app/bench/techniques/technique.h"
#include "app/bench/truth/truth.h"
#include "app/render/read_back.h"
#include "firmware_host/display/surfaceless_display.h"
#include "tests/bench/near_settings.h"

#include <gtest/gtest.h>

#include <memory>

namespace frustumscreen::bench {

class DrawnNear : public ::testing::Test {
protected:
    [[nodiscard]] TruthPicture ray_cast(const Truth& truth, const BenchPose& pose) const {
        return truth.cast(kiosk_.prop, view_of(kiosk_.settings, pose), true);
    }
    /// The error of the picture drawn by `technique` for `pose`.
    [[nodiscard]] PictureError error_of(Technique& technique, const BenchPose& pose,
                                        const TruthPicture& truth) const {
        technique.draw(pose);
        image::Image8 colour = render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
        auto points = technique.hit_points(pose);
        return measure(truth, {std::move(colour), std::move(points).value()});
    }

    std::unique_ptr<display::SurfacelessDisplay> display_ =
        display::SurfacelessDisplay::create(640, 400).value();
    Kiosk kiosk_{near_settings(), geometry::make_frustum({}), display_->framebuffer()};
};

} // namespace frustumscreen::bench
