/// How the readers of this room refuse a file: they throw one sentence, which load_mesh.cpp turns into an
/// Error. A reader makes hundreds of checks in nested places; a throw keeps each of them one line. No
/// exception leaves the room.
///
/// The sentence is for a curator: what is the matter and what to do. Where only the file's own makers can say
/// more, the place and the numbers stand in brackets.
#pragma once

#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen {

struct Refusal {
    Error error;
};

/// Another's error as it is, from a place inside the file.
[[noreturn]] inline void refuse(Error error) {
    throw Refusal{std::move(error)};
}

/// The whole sentence.
template <typename... Arguments>
[[noreturn]] void refuse(MessageId id, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    throw Refusal{{ErrorKind::BadInput, id, fmt::format(format, std::forward<Arguments>(arguments)...)}};
}

// For the others the arguments are what stands in the brackets: the place inside the file and what was found.

/// Each part can be read, but they do not fit together.
template <typename... Arguments>
[[noreturn]] void refuse_contradiction(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    refuse("mesh.contradiction", "the file's own numbers contradict each other ({}): export it again",
           fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// A part is not what its format has there.
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

} // namespace frustumscreen
