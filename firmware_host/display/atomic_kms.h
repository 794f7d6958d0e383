/// KMS by non-blocking atomic commits: the kernel answers at once and does the work afterwards.
///
/// Threads  the render thread.
/// Source   the kernel's userspace API for KMS, "Atomic Mode Setting"; libdrm.
#pragma once

#include "firmware_host/display/flip_events.h"
#include "firmware_host/display/kms_card.h"
#include "firmware_host/display/kms_device.h"
#include "firmware_host/display/output_properties.h"

#include <optional>

namespace frustumscreen::display {

class AtomicKms final : public KmsDevice {
public:
    /// `card` must outlive the result.
    explicit AtomicKms(const KmsCard& card) : card_(card), file_(card.file()), flips_(file_) {}
    ~AtomicKms() override;
    AtomicKms(const AtomicKms&) = delete;
    AtomicKms& operator=(const AtomicKms&) = delete;

    [[nodiscard]] KmsAnswer light(std::uint32_t connector, const ModeTiming& mode, const ScannedOut& shown,
                                  std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer flip(FramebufferId shown, std::uint64_t ticket) override;
    [[nodiscard]] KmsAnswer flip_from(int first_row, FramebufferId shown, std::uint64_t ticket) override;
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
    /// From a framebuffer to a connector.
    struct Route {
        std::uint32_t connector = 0;
        std::uint32_t crtc = 0;
        std::uint32_t plane = 0;
        std::uint32_t plane_framebuffer = 0; ///< the property's number
        std::uint32_t plane_row = 0;         ///< the same, of the first row that is shown
    };
    [[nodiscard]] std::optional<Route> route_to(std::uint32_t connector) const;
    /// One commit that lights `route` and turns off everything else that is not leased; `settings` are the connector's.
    [[nodiscard]] KmsAnswer light(const Route& route, const ScannedOut& shown, std::uint64_t ticket,
                                  std::span<const PropertySetting> settings) const;
    void forget_mode();

    const KmsCard& card_;
    int file_;
    FlipEvents flips_;
    std::optional<Route> route_;
    std::uint32_t mode_blob_ = 0;
    std::string_view shortcoming_;
};

} // namespace frustumscreen::display
