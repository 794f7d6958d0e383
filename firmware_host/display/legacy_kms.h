/// KMS without atomic commits, for drivers that lack them (nouveau in Debian, radeon, gma500).
///
/// Setting a mode blocks until it is set, up to some 100 ms; `light` then reports the flip itself.
///
/// Threads  the render thread.
/// Source   the kernel's userspace API for KMS: SETCRTC, PAGE_FLIP; libdrm.
#pragma once

#include "firmware_host/display/flip_events.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/kms_device.h"

namespace frustumscreen::display {

class LegacyKms final : public KmsDevice {
public:
    /// `card` must outlive the result.
    explicit LegacyKms(const KmsCard& card) : card_(card), file_(card.file()), flips_(file_) {}

    [[nodiscard]] KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                                  std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer darken() override;
    [[nodiscard]] bool become_master() override { return card_.become_master(); }
    [[nodiscard]] std::optional<Flipped> wait_flip(Nanoseconds at_most) override {
        return flips_.wait(at_most);
    }
    [[nodiscard]] bool flips_keep_time() const override { return flips_.keep_time(); }
    [[nodiscard]] std::string_view shortcoming() const override { return shortcoming_; }
    [[nodiscard]] std::string_view card() const override { return card_.path(); }
    [[nodiscard]] MonotonicTime now() const override { return monotonic_now(); }

private:
    const KmsCard& card_;
    int file_;
    FlipEvents flips_;
    std::uint32_t crtc_ = 0; ///< feeds the lit output; 0 = nothing is lit
    std::string_view shortcoming_;
};

} // namespace frustumscreen::display
