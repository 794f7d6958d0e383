// An exhibit that presents pictures of 1280 x 800 to a fake card.
#pragma once

#include "firmware_host/display/presenter.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace frustumscreen::display {

inline OutputRequest wish_for_the_preferred() {
    OutputRequest request;
    request.picture_width = 1280;
    request.picture_height = 800;
    return request;
}

class PresentedExhibit {
public:
    explicit PresentedExhibit(const OutputRequest& request = wish_for_the_preferred())
        : presenter(kms, memory.maker(), request) {}

    /// One 60 Hz frame: 5 ms of drawing, then the picture is presented.
    MonotonicTime frame(const PixelRectangle& changed = {0, 0, 1280, 800}) {
        const MonotonicTime begin = kms.time;
        kms.time += std::chrono::milliseconds(5);
        const MonotonicTime called = kms.time;
        const Result<MonotonicTime> shown = presenter.present(changed, true);
        EXPECT_TRUE(shown) << shown.error().message;
        EXPECT_LE(kms.time - called, flip_timeout) << "present held up the exhibit";
        kms.time = std::max(kms.time, presenter.next_frame(begin, one_refresh));
        return shown.value_or(MonotonicTime{});
    }
    void frames(int count) {
        for (int k = 0; k < count; ++k) {
            frame();
        }
    }
    bool says(const std::string& words) const {
        return std::string(presenter.state()).find(words) != std::string::npos;
    }

    FakeKms kms;
    FakeMemory memory;
    Presenter presenter;
};

/// One that has shown five pictures on a projector.
class LitExhibit : public PresentedExhibit {
public:
    LitExhibit() {
        presenter.connected(a_card({a_projector()}));
        frames(5);
    }
};

} // namespace frustumscreen::display
