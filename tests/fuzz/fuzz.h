/// The common part of the fuzz targets: libFuzzer's entry point, and the report of broken promises.
///
/// A target is pure functions over bytes: no files, no threads, no clock. `./test fuzz` builds it with
/// libFuzzer (https://llvm.org/docs/LibFuzzer.html); ./test builds it with corpus_main.cpp, which feeds it
/// its corpus.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace frustumscreen::fuzz {

/// Ends the program if the input breaks a promise.
inline void require(bool holds, std::string_view promise, std::string_view detail = "") {
    if (!holds) {
        std::fprintf(stderr, "broken promise: %.*s: %.*s\n", static_cast<int>(promise.size()), promise.data(),
                     static_cast<int>(detail.size()), detail.data());
        std::abort();
    }
}

/// An error message is for a person: one line, of limited length, without control characters.
inline void require_one_line(const std::string& message) {
    constexpr std::size_t longest = 600;
    require(!message.empty() && message.size() <= longest, "a message has a readable length", message);
    for (const char c : message) {
        const auto code = static_cast<unsigned char>(c);
        require(code >= 0x20 && code != 0x7f, "a message has no control characters", message);
    }
}

inline bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool is_unit(const glm::dquat& q) {
    return std::abs(std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z)) - 1.0) < 1e-9;
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return size == 0 ? std::string_view() : std::string_view(reinterpret_cast<const char*>(data), size);
}
inline std::span<const std::byte> bytes_of(const std::uint8_t* data, std::size_t size) {
    return std::as_bytes(std::span(data, size));
}

} // namespace frustumscreen::fuzz
