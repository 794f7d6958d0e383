#include "firmware_host/display/kms_commit.h"

#include "firmware_host/display/kms_handles.h"

namespace frustumscreen::display {

KmsCommit::KmsCommit(int file) : file_(file), request_(drmModeAtomicAlloc(), drmModeAtomicFree) {}

void KmsCommit::set(const KmsProperties& object, std::string_view name, std::uint64_t value) {
    if (const KmsProperty* property = object.find(name); property != nullptr && !property->immutable) {
        set(object.object(), property->id, value);
    }
}

void KmsCommit::reset(const KmsProperties& object, std::string_view name, std::uint64_t value) {
    if (object.value(name) != value) {
        set(object, name, value);
    }
}

void KmsCommit::set(std::uint32_t object, std::uint32_t property, std::uint64_t value) {
    if (count_ >= 0) {
        count_ = drmModeAtomicAddProperty(request_.get(), object, property, value);
    }
}

void KmsCommit::turn_off_plane(const KmsProperties& plane) {
    set(plane, "FB_ID", 0);
    set(plane, "CRTC_ID", 0);
}

void KmsCommit::turn_off_crtc(const KmsProperties& crtc) {
    set(crtc, "ACTIVE", 0);
    set(crtc, "MODE_ID", 0);
}

KmsAnswer KmsCommit::send(std::uint32_t flags, std::uint64_t ticket) const {
    if (count_ <= 0) {
        return answer_for_missing_object(file_);
    }
    return kms_answer(
        drmModeAtomicCommit(file_, request_.get(), flags | DRM_MODE_ATOMIC_NONBLOCK, user_data_of(ticket)));
}

} // namespace frustumscreen::display
