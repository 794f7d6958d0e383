/// Reads an Ogg Opus recording (RFC 7845, RFC 6716; by libopusfile) into a prompt.
///
/// Input    outside bytes: one recording of at most `OpusLimits::longest`, of one or two channels, which are
///          averaged. What is claimed is checked before memory is taken, what is decoded while it is.
/// Errors   bad input, one sentence.
/// Memory   96 kB for a second; while it is read, for as long as `longest` at most.
/// Threads  pure; any but the exhibit's in its frame: a second takes some milliseconds.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/sound/prompt.h"

#include <cstddef>
#include <span>

namespace frustumscreen {

struct OpusLimits {
    Nanoseconds longest = std::chrono::minutes(3);
};

/// Without marks; `find_pauses` finds them.
[[nodiscard]] Result<Prompt> read_opus(std::span<const std::byte> bytes, const OpusLimits& limits = {});

} // namespace frustumscreen
