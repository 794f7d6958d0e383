/// A codec's result for a whole stream of bytes, for the codecs' tests.
#pragma once

#include "firmware_host/tracker/viper_codec.h" // NeedMore

#include <gtest/gtest.h>

#include <span>
#include <variant>
#include <vector>

namespace frustumscreen::tracker {

struct ParsedStream {
    std::vector<DeviceFrame> frames;
    int others = 0; ///< messages other than frames
    int refusals = 0;
    std::size_t left = 0; ///< bytes that wait for more
};

/// Parses all bytes and checks the invariants of each step of `parse`.
template <typename Parse> ParsedStream parsed_stream(std::span<const std::byte> stream, Parse parse) {
    ParsedStream parsed;
    while (true) {
        const auto step = parse(stream);
        const bool waits = std::holds_alternative<NeedMore>(step.message);
        EXPECT_EQ(step.consumed == 0, waits);
        EXPECT_LE(step.consumed, stream.size());
        if (step.consumed == 0 || step.consumed > stream.size()) {
            parsed.left = stream.size();
            return parsed;
        }
        if (const auto* frame = std::get_if<DeviceFrame>(&step.message)) {
            parsed.frames.push_back(*frame);
        } else if (std::holds_alternative<DiscardReason>(step.message)) {
            ++parsed.refusals;
        } else {
            ++parsed.others;
        }
        stream = stream.subspan(step.consumed);
    }
}

} // namespace frustumscreen::tracker
