// A graphics card with a projector, and an exhibit that shows pictures on it with the display's own code, on
// the fake kernel.
#pragma once

#include "firmware_host/display/dumb_buffer.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/kms_handles.h"
#include "firmware_host/display/presenter.h"
#include "tests/display/fake_kernel.h"
#include "tests/display/fake_kms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

namespace frustumscreen::display {

inline drmModeModeInfo kernel_mode(int width, int height, double hz, bool preferred = false) {
    drmModeModeInfo mode = mode_info(a_mode(width, height, hz));
    mode.type = preferred ? DRM_MODE_TYPE_DRIVER | DRM_MODE_TYPE_PREFERRED : DRM_MODE_TYPE_DRIVER;
    return mode;
}

/// The same mode as HDMI's 3D; `layout`: DRM_MODE_FLAG_3D_...
inline drmModeModeInfo in_3d(drmModeModeInfo mode, std::uint32_t layout) {
    mode.flags |= layout;
    return mode;
}

inline std::vector<drmModeModeInfo> projector_modes() {
    return {kernel_mode(320, 200, 60.0, true), kernel_mode(256, 192, 60.0), kernel_mode(160, 120, 60.0)};
}

/// Two CRTCs with a primary plane each, an overlay, HDMI and DisplayPort; an earlier program has left state
/// in their properties.
struct CardOnDesk {
    explicit CardOnDesk(FakeCard& made) : card(made) {
        crtcs = {made.add_crtc(), made.add_crtc()};
        planes = {made.add_plane(DRM_PLANE_TYPE_PRIMARY, 1), made.add_plane(DRM_PLANE_TYPE_PRIMARY, 2)};
        overlay = made.add_plane(DRM_PLANE_TYPE_OVERLAY, 3);
        const std::uint32_t hdmi_encoder = made.add_encoder(3);
        const std::uint32_t other_encoder = made.add_encoder(2);
        hdmi = made.add_connector(DRM_MODE_CONNECTOR_HDMIA, 1, {hdmi_encoder}).id;
        other = made.add_connector(DRM_MODE_CONNECTOR_DisplayPort, 1, {other_encoder}).id;
        made.add_property(hdmi,
                          {0,
                           "Broadcast RGB",
                           DRM_MODE_PROP_ENUM,
                           {},
                           {{"Automatic", 0}, {"Full", 1}, {"Limited 16:235", 2}}},
                          0);
        made.set(planes[0], "rotation", DRM_MODE_ROTATE_180);
        made.set(planes[0], "alpha", 0x8000);
        made.plug(hdmi, projector_modes());
    }

    FakeCard& card;
    std::array<std::uint32_t, 2> crtcs{};
    std::array<std::uint32_t, 2> planes{};
    std::uint32_t overlay = 0, hdmi = 0, other = 0;
};

inline constexpr const char* card_path = "/dev/dri/fake0";

class Desk : public testing::Test {
protected:
    ~Desk() override {
        EXPECT_EQ(kernel.alive(), "");
        EXPECT_EQ(kernel.wrongs(), "");
    }
    FakeKernel kernel;
    CardOnDesk desk{kernel.add_card(card_path)};
};

/// Two dumb buffers without contents.
class UndrawnPair final : public ScanoutPair {
public:
    static Result<std::unique_ptr<ScanoutPair>> make(int card, PixelSize size) {
        auto pair = std::make_unique<UndrawnPair>();
        pair->size_ = size;
        for (std::optional<DumbBuffer>& buffer : pair->buffers_) {
            buffer = DumbBuffer::create(card, size);
            if (!buffer || !buffer->map()) {
                return fail(ErrorKind::BadConfiguration, "test.device", "the graphics card has no memory");
            }
        }
        return pair;
    }
    [[nodiscard]] PixelSize size() const override { return size_; }
    [[nodiscard]] FramebufferId fill(int which, const PixelRectangle& /*part*/) override {
        return buffers_.at(static_cast<std::size_t>(which))->shown();
    }

private:
    PixelSize size_;
    std::array<std::optional<DumbBuffer>, 2> buffers_;
};

/// The device on the test's clock: waiting for a flip advances the clock and takes no real time.
class OnTestClock final : public KmsDevice {
public:
    explicit OnTestClock(KmsDevice& device) : device_(device) {}
    KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                    std::uint64_t ticket) override {
        return device_.light(connector, mode, shown, ticket);
    }
    KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override { return device_.flip(shown, ticket); }
    KmsAnswer flip_from(int first_row, FramebufferId shown, std::uint64_t ticket) override {
        return device_.flip_from(first_row, shown, ticket);
    }
    KmsAnswer darken() override { return device_.darken(); }
    bool become_master() override { return device_.become_master(); }
    std::optional<Flipped> wait_flip(Nanoseconds at_most) override {
        std::optional<Flipped> flipped = device_.wait_flip(Nanoseconds(0));
        time += flipped ? Nanoseconds(0) : at_most;
        return flipped;
    }
    [[nodiscard]] bool flips_keep_time() const override { return device_.flips_keep_time(); }
    [[nodiscard]] std::string_view shortcoming() const override { return device_.shortcoming(); }
    [[nodiscard]] std::string_view card() const override { return device_.card(); }
    [[nodiscard]] MonotonicTime now() const override { return time; }

    MonotonicTime time = from_microseconds(1'000'000);

private:
    KmsDevice& device_;
};

} // namespace frustumscreen::display
