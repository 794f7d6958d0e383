#include "app/library/import_failure.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace frustumscreen {

namespace {

ImportRefusal refusal_of(SignatureFault fault) {
    switch (fault) {
    case SignatureFault::Unsigned:
        return ImportRefusal::Unsigned;
    case SignatureFault::UnknownKey:
    case SignatureFault::KeyEnded:
        return ImportRefusal::WrongKey;
    case SignatureFault::Malformed:
    case SignatureFault::Altered:
        break;
    }
    return ImportRefusal::Altered;
}

} // namespace

ImportFailure stick_failure(std::string_view path, FileFault fault) {
    const std::string name = path.empty() ? "the stick" : printable(path);
    if (fault.number == EACCES || fault.number == EPERM) {
        return {ImportRefusal::Unreadable, name + ": it may not be read; give everybody the right to read it",
                path.empty()};
    }
    if (fault.number == EINVAL || fault.number == ELOOP) {
        return {ImportRefusal::NotAPack, name + ": it is not a regular file", false};
    }
    return {ImportRefusal::Unreadable,
            fmt::format("{}: it cannot be read ({}); the stick was pulled out or is damaged: put it in again",
                        name, fault.number == ENODATA ? "it ended too soon" : std::strerror(fault.number)),
            true};
}

ImportFailure disk_failure(std::string_view path, FileFault fault) {
    if (fault.number == ENOSPC || fault.number == EDQUOT) {
        return {ImportRefusal::NoRoom,
                "the kiosk's disk became full; make room on it, or put fewer packs on the stick", true};
    }
    return {ImportRefusal::Unwritable,
            fmt::format("{} on the kiosk's disk: {}; nothing was taken, call a technician", printable(path),
                        fault.number == ENODATA ? "it ended too soon" : std::strerror(fault.number)),
            true};
}

ImportFailure failure_of(const SignatureRefusal& refusal) {
    return {refusal_of(refusal.fault), refusal.error.message, false};
}

ImportFailure failure_of(const PackRefusal& refusal) {
    switch (refusal.why) {
    case PackRefusal::Why::Unreadable:
        return {ImportRefusal::Unreadable, refusal.error.message, true};
    case PackRefusal::Why::Signature:
        return {refusal_of(refusal.fault), refusal.error.message, false};
    case PackRefusal::Why::NotAPack:
        break;
    }
    return {ImportRefusal::NotAPack, refusal.error.message, false};
}

ImportFailure no_room(std::uint64_t wanted, std::uint64_t free, std::uint64_t margin) {
    constexpr std::uint64_t bytes_per_mb = 1000000;
    return {ImportRefusal::NoRoom,
            fmt::format("the packs need {} MB, {} MB of the kiosk's disk are free, and {} MB must stay free; "
                        "remove packs, or put fewer on the stick",
                        wanted / bytes_per_mb + 1, free / bytes_per_mb, margin / bytes_per_mb),
            true};
}

ImportFailure unsure_switch() {
    return {ImportRefusal::Unwritable,
            "the new set is shown, but a power cut may bring the old one back, because the kiosk's disk "
            "fails; call a technician",
            true};
}

ImportFailure too_slow() {
    return too_much("the stick answers too slowly; try another one, or put fewer files on it");
}

ImportFailure too_much(std::string reason) {
    return {ImportRefusal::TooMuch, std::move(reason), true};
}

} // namespace frustumscreen
