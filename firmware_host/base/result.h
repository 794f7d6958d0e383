/// Result<T>: a value, or an Error that says who must act.
///
/// Errors that a person can cause (files, settings, devices) travel as values with one sentence for that
/// person: what, where, what is allowed, what to do next. Programming errors assert.
#pragma once

#include <tl/expected.hpp>

#include <string>
#include <utility>

namespace frustumscreen {

/// Who acts on an error.
enum class ErrorKind {
    BadInput,         ///< outside bytes are wrong: refuse them, keep running
    DeviceLost,       ///< a device went away: reconnect
    BadConfiguration, ///< a person must change something; a service is restarted until that is done
    Internal,         ///< this program cannot go on: the service manager restarts it
};

struct Error {
    ErrorKind kind = ErrorKind::BadInput;
    std::string message; ///< one line, no trailing full stop or line break
};

template <typename T> using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> fail(ErrorKind kind, std::string message) {
    return tl::unexpected<Error>(Error{kind, std::move(message)});
}
[[nodiscard]] inline tl::unexpected<Error> bad_input(std::string message) {
    return fail(ErrorKind::BadInput, std::move(message));
}

/// Puts `place` (a file, a part of it) in front of an error's message.
[[nodiscard]] inline tl::unexpected<Error> at(const std::string& place, Error error) {
    error.message = place + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
}

} // namespace frustumscreen
