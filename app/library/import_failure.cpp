#include "app/library/import_failure.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace frustumscreen::library {

namespace {

ImportRefusal refusal_of(pack::SignatureFault fault) {
    switch (fault) {
    case pack::SignatureFault::Unsigned:
        return ImportRefusal::Unsigned;
    case pack::SignatureFault::UnknownKey:
    case pack::SignatureFault::KeyEnded:
        return ImportRefusal::WrongKey;
    case pack::SignatureFault::Malformed:
    case pack::SignatureFault::Altered:
        break;
    }
    return ImportRefusal::Altered;
}

} // namespace

ImportFailure stick_failure(std::string_view path, FileFault fault) {
    const std::string name = path.empty() ? "the stick" : printable(path);
    if (fault.number == EACCES || fault.number == EPERM) {
        return {.refusal = ImportRefusal::Unreadable,
                .reason = name + ": it may not be read; give everybody the right to read it",
                .whole = path.empty()};
    }
    if (fault.number == EINVAL || fault.number == ELOOP) {
        return {.refusal = ImportRefusal::NotAPack,
                .reason = name + ": it is not a regular file",
                .whole = false};
    }
    return {.refusal = ImportRefusal::Unreadable,
            .reason = fmt::format(
                "{}: it cannot be read ({}); the stick was pulled out or is damaged: put it in again", name,
                fault.number == ENODATA ? "it ended too soon" : std::strerror(fault.number)),
            .whole = true};
}

ImportFailure disk_failure(std::string_view path, FileFault fault) {
    if (fault.number == ENOSPC || fault.number == EDQUOT) {
        return {.refusal = ImportRefusal::NoRoom,
                .reason = "the kiosk's disk became full; make room on it, or put fewer packs on the stick",
                .whole = true};
    }
    return {.refusal = ImportRefusal::Unwritable,
            .reason = fmt::format(
                "{} on the kiosk's disk: {}; nothing was taken, call a technician", printable(path),
                fault.number == ENODATA ? "it ended too soon" : std::strerror(fault.number)),
            .whole = true};
}

ImportFailure failure_of(const pack::SignatureRefusal& refusal) {
    return {.refusal = refusal_of(refusal.fault), .reason = refusal.error.message, .whole = false};
}

ImportFailure failure_of(const pack::PackRefusal& refusal) {
    switch (refusal.why) {
    case pack::PackRefusal::Why::Unreadable:
        return {.refusal = ImportRefusal::Unreadable, .reason = refusal.error.message, .whole = true};
    case pack::PackRefusal::Why::Signature:
        return {.refusal = refusal_of(refusal.fault), .reason = refusal.error.message, .whole = false};
    case pack::PackRefusal::Why::NotAPack:
        break;
    }
    return {.refusal = ImportRefusal::NotAPack, .reason = refusal.error.message, .whole = false};
}

ImportFailure no_space(std::uint64_t wanted, std::uint64_t free, std::uint64_t margin) {
    constexpr std::uint64_t bytes_per_mb = 1000000;
    return {.refusal = ImportRefusal::NoRoom,
            .reason = fmt::format(
                "the packs need {} MB, {} MB of the kiosk's disk are free, and {} MB must stay free; "
                "remove packs, or put fewer on the stick",
                wanted / bytes_per_mb + 1, free / bytes_per_mb, margin / bytes_per_mb),
            .whole = true};
}

ImportFailure unsure_switch() {
    return {.refusal = ImportRefusal::Unwritable,
            .reason =
                "the new set is shown, but a power cut may bring the old one back, because the kiosk's disk "
                "fails; call a technician",
            .whole = true};
}

ImportFailure too_slow() {
    return too_much("the stick answers too slowly; try another one, or put fewer files on it");
}

ImportFailure too_much(std::string reason) {
    return {.refusal = ImportRefusal::TooMuch, .reason = std::move(reason), .whole = true};
}

} // namespace frustumscreen::library
