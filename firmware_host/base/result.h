/// Result<T>: a value, or an Error that names who must act.
///
/// Errors that a person can cause (files, settings, devices) are values with one sentence for that person:
/// what, where, what is allowed, what to do next. Programming errors assert.
///
/// Each sentence has an id that stays when the wording changes: tests, the guide and other programs use the
/// id. Programs print it in brackets after the sentence.
///
/// TRY(const X x, f()); declares `const X x` with the value of f(), or returns f()'s error from the function.
/// TRY_VOID(g()); does so without a value. The compiler rejects TRY_VOID for a value that owns something,
/// such as a context or a lock: name it with TRY, or drop it with TRY_VOID(without_value(g())).
#pragma once

#include <fmt/format.h>
#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace frustumscreen {

/// The person who must act on an error.
enum class ErrorKind {
    BadInput,         ///< bad bytes from outside: refuse them, keep running
    DeviceLost,       ///< a device went away: reconnect
    BadConfiguration, ///< a person must change something; a service is restarted until then
    Internal,         ///< this program cannot continue: the service manager restarts it
};

/// `subject.problem`, in small letters, digits and `_`; a literal next to its sentence, checked at compile
/// time.
class MessageId {
public:
    /// Implicit, so a literal converts to an id wherever one is expected.
    consteval MessageId(const char* id) : id_(id) {
        if (!is_well_formed(id_)) {
            throw "a message's id is subject.problem, in small letters, digits and _"; // stops the compilation
        }
    }
    [[nodiscard]] constexpr std::string_view view() const { return id_; }
    constexpr operator std::string_view() const { return id_; }
    friend constexpr bool operator==(const MessageId& id, std::string_view other) { return id.id_ == other; }

private:
    static constexpr bool is_well_formed(std::string_view id) {
        const std::size_t dot = id.find('.');
        return dot != std::string_view::npos && dot > 0 && dot + 1 < id.size() &&
               id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.") == std::string_view::npos &&
               id.find('.', dot + 1) == std::string_view::npos;
    }
    std::string_view id_;
};

struct Error {
    ErrorKind kind;
    MessageId id;
    std::string message; ///< one line, no trailing full stop or line break
};

template <typename T> using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> fail(ErrorKind kind, MessageId id, std::string message) {
    return tl::unexpected<Error>(Error{kind, id, std::move(message)});
}
template <typename First, typename... Others>
[[nodiscard]] tl::unexpected<Error> fail(ErrorKind kind, MessageId id,
                                         fmt::format_string<First, Others...> sentence, First&& first,
                                         Others&&... others) {
    return fail(kind, id, fmt::format(sentence, std::forward<First>(first), std::forward<Others>(others)...));
}
[[nodiscard]] inline tl::unexpected<Error> bad_input(MessageId id, std::string message) {
    return fail(ErrorKind::BadInput, id, std::move(message));
}
template <typename First, typename... Others>
[[nodiscard]] tl::unexpected<Error> bad_input(MessageId id, fmt::format_string<First, Others...> sentence,
                                              First&& first, Others&&... others) {
    return fail(ErrorKind::BadInput, id, sentence, std::forward<First>(first),
                std::forward<Others>(others)...);
}
/// The error with another kind, because another person must act on it here.
[[nodiscard]] inline tl::unexpected<Error> as_kind(ErrorKind kind, Error error) {
    error.kind = kind;
    return tl::unexpected<Error>(std::move(error));
}

/// Puts `place` (a file, or a part of it) in front of an error's message.
[[nodiscard]] inline tl::unexpected<Error> at(const std::string& place, Error error) {
    error.message = place + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
}
/// As above, for a result that is an error.
template <typename T> [[nodiscard]] Result<T> at(const std::string& place, Result<T> result) {
    if (!result) {
        result.error().message = place + ": " + result.error().message;
    }
    return result;
}

/// A result without its value, which is destroyed here.
template <typename T, typename E>
[[nodiscard]] tl::expected<void, E> without_value(tl::expected<T, E> result) {
    return std::move(result).map([](T&&) {});
}

/// Whether TRY_VOID may drop a result's value: it has none, the value owns nothing, or the result is an
/// lvalue and keeps it.
template <typename ResultReference>
inline constexpr bool may_be_dropped =
    std::is_lvalue_reference_v<ResultReference> ||
    std::is_void_v<typename std::remove_reference_t<ResultReference>::value_type> ||
    std::is_trivially_destructible_v<typename std::remove_reference_t<ResultReference>::value_type>;

} // namespace frustumscreen

/// Moves the value out of its result; both live to the end of the scope. `variable` is a declaration without
/// a comma (auto if the type has one) or an assignable expression; the function may return a Result of any
/// type.
#define TRY(variable, ...) FRUSTUMSCREEN_TRY_COUNTED(__COUNTER__, variable, __VA_ARGS__)
#define FRUSTUMSCREEN_TRY_COUNTED(count, variable, ...) FRUSTUMSCREEN_TRY_NAMED(count, variable, __VA_ARGS__)
#define FRUSTUMSCREEN_TRY_NAMED(count, variable, ...)                                                        \
    auto result_of_try_##count = __VA_ARGS__;                                                                \
    if (!result_of_try_##count) {                                                                            \
        return tl::unexpected(std::move(result_of_try_##count).error());                                     \
    }                                                                                                        \
    variable = *std::move(result_of_try_##count)

/// A named result keeps its value.
#define TRY_VOID(...)                                                                                        \
    if (auto&& result_of_try = __VA_ARGS__; !result_of_try) {                                                \
        static_assert(frustumscreen::may_be_dropped<decltype(result_of_try)>,                                \
                      "TRY_VOID drops what the value holds; name it with TRY");                              \
        return tl::unexpected(std::forward<decltype(result_of_try)>(result_of_try).error());                 \
    }
