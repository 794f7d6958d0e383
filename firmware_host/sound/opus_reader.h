/// Reads an Ogg Opus recording (RFC 7845, RFC 6716; by libopusfile) into a prompt.
///
/// Input    bytes from outside: one recording of at most `OpusLimits::longest`, with one or two channels,
///          which are averaged. The claimed length is checked before memory is allocated, the real length
///          during decoding.
/// Errors   bad input, one sentence.
/// Memory   96 kB per second; during reading at most that of `longest`.
/// Threads  pure; any except the exhibit's in its frame: one second of sound takes some milliseconds.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/sound/prompt.h"

#include <cstddef>
#include <span>

namespace frustumscreen::sound {

struct OpusLimits {
    Nanoseconds longest = std::chrono::minutes(3);
};

/// Returns a prompt without marks; `find_pauses` finds them.
[[nodiscard]] Result<Prompt> read_opus(std::span<const std::byte> bytes, const OpusLimits& limits = {});

} // namespace frustumscreen::sound
