/// An atomic commit: properties of a card's objects that change together.
///
/// Threads  one.
/// Source   the kernel's userspace API for KMS, "Atomic Mode Setting"; libdrm.
#pragma once

#include "firmware_host/display/kms_device.h"
#include "firmware_host/display/kms_properties.h"

#include <cstdint>
#include <memory>
#include <string_view>

struct _drmModeAtomicReq;

namespace frustumscreen::display {

/// Properties that an object lacks are skipped; `reset` also skips those that already have their value.
class KmsCommit {
public:
    explicit KmsCommit(int file);

    void set(const KmsProperties& object, std::string_view name, std::uint64_t value);
    void reset(const KmsProperties& object, std::string_view name, std::uint64_t value);
    void set(std::uint32_t object, std::uint32_t property, std::uint64_t value);
    void turn_off_plane(const KmsProperties& plane);
    void turn_off_crtc(const KmsProperties& crtc);
    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// Sends only a complete request; libdrm would report success for an empty one. The kernel answers at once.
    [[nodiscard]] KmsAnswer send(std::uint32_t flags, std::uint64_t ticket) const;

private:
    int file_;
    int count_ = 0; ///< number of properties; negative: one could not be added
    std::unique_ptr<_drmModeAtomicReq, void (*)(_drmModeAtomicReq*)> request_;
};

} // namespace frustumscreen::display
