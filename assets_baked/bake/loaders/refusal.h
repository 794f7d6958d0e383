/// How the readers of this room give up on a file: one sentence, thrown, and turned into an Error at the
/// room's door (load_mesh.cpp). A reader makes hundreds of checks in nested places; a throw keeps each of
/// them one line. Nothing leaves the room by exception.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen {

struct Refusal {
    std::string message; ///< place inside the file, what was found, what is allowed
};

template <typename... Arguments>
[[noreturn]] void refuse(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    throw Refusal{fmt::format(format, std::forward<Arguments>(arguments)...)};
}

} // namespace frustumscreen
