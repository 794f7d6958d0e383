/// Refusals of a file by the readers of this module: they throw one sentence, which load_mesh.cpp turns into an
/// Error. A reader makes hundreds of checks in nested places; a throw keeps each of them one line. No
/// exception leaves the module.
///
/// The sentence is for a curator: the problem and the remedy. Details that only the file's makers understand,
/// the place and the numbers, are in brackets.
#pragma once

#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen::bake {

struct Refusal {
    Error error;
};

/// Passes on an error from a place inside the file.
[[noreturn]] inline void refuse(Error error) {
    throw Refusal{std::move(error)};
}

/// Refuses with a complete sentence.
template <typename... Arguments>
[[noreturn]] void refuse(MessageId id, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    throw Refusal{{ErrorKind::BadInput, id, fmt::format(format, std::forward<Arguments>(arguments)...)}};
}

// The following take the text in the brackets: the place inside the file and the value found.

/// The parts are valid but contradict each other.
template <typename... Arguments>
[[noreturn]] void refuse_contradiction(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    refuse("mesh.contradiction", "the file's own numbers contradict each other ({}): export it again",
           fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// A part violates its format.
template <typename... Arguments>
[[noreturn]] void refuse_damage(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    refuse("mesh.damaged",
           "the file is damaged or not written as its format says ({}): copy it again, or export it again",
           fmt::format(format, std::forward<Arguments>(arguments)...));
}

template <typename... Arguments>
[[noreturn]] void refuse_cut_short(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    refuse("mesh.cut_short", "the file ends too early ({}): copy it again, or export it again",
           fmt::format(format, std::forward<Arguments>(arguments)...));
}

} // namespace frustumscreen::bake
