/// KMS by atomic commits that do not block: the kernel's answer comes at once, the work is done behind it.
///
/// Threads  the render thread.
/// Source   the kernel's userspace API for KMS, "Atomic Mode Setting"; libdrm.
#pragma once

#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/kms_device.h"

#include <optional>
#include <vector>

namespace frustumscreen {

class AtomicKms final : public KmsDevice {
public:
    explicit AtomicKms(const KmsCard& card);
    ~AtomicKms() override;
    AtomicKms(const AtomicKms&) = delete;
    AtomicKms& operator=(const AtomicKms&) = delete;

    [[nodiscard]] KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, FramebufferId shown,
                                  std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer darken() override;
    [[nodiscard]] bool become_master() override;
    [[nodiscard]] std::optional<Flipped> wait_flip(Nanoseconds at_most) override;
    [[nodiscard]] bool flips_keep_time() const override { return flips_keep_time_; }
    [[nodiscard]] MonotonicTime now() const override { return monotonic_now(); }

private:
    /// From a framebuffer to a connector.
    struct Route {
        std::uint32_t connector = 0;
        std::uint32_t crtc = 0;
        std::uint32_t plane = 0;
        std::uint32_t plane_framebuffer = 0; ///< the property's number
    };
    [[nodiscard]] std::optional<Route> route_to(std::uint32_t connector) const;
    void read_flips();
    void forget_mode();

    int file_;
    bool monotonic_flips_ = false;
    bool flips_keep_time_ = false;
    std::optional<Route> route_;
    std::uint32_t mode_blob_ = 0;
    std::vector<Flipped> flips_; ///< read and not handed out yet
};

} // namespace frustumscreen
