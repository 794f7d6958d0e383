/// Signed packs, and helpers for their tests.
#pragma once

#include "app/pack/sign_pack.h"
#include "app/pack/signature/secret_key.h"
#include "app/pack/signed_pack.h"
#include "tests/pack/samples.h"

#include <fmt/format.h>

namespace frustumscreen::testing {

inline std::string comment_of(std::uint64_t serial) {
    return fmt::format("serial:{}\tfile:a.fspack\thashed", serial);
}

inline Bytes manifest_of(const Bytes& pack) {
    auto zip = pack::ZipReader::open(pack);
    return zip->read(zip->entries().front()).value();
}

inline Bytes signed_pack(const pack::Pack& pack, const pack::SecretKey& key, std::uint64_t serial) {
    const Bytes bytes = samples::bytes_of(pack);
    return pack::with_signature(bytes, key.sign(manifest_of(bytes), comment_of(serial))).value();
}

inline pack::TrustedKey trusted(const pack::SecretKey& key, std::string name = "House") {
    return {std::move(name), key.public_key(), std::nullopt};
}

inline std::chrono::sys_days day(int year, unsigned month, unsigned of_month) {
    return std::chrono::sys_days(std::chrono::year(year) / std::chrono::month(month) /
                                 std::chrono::day(of_month));
}

} // namespace frustumscreen::testing
