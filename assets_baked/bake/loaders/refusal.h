/// How the readers of this room refuse a file: they throw one sentence, which load_mesh.cpp turns into an
/// Error. A reader makes hundreds of checks in nested places; a throw keeps each of them one line. No
/// exception leaves the room.
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
