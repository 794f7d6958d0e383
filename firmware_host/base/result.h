/// Result<T>: a value, or an Error that says who must act.
///
/// Errors that a person can cause (files, settings, devices) travel as values with one sentence for that
/// person: what, where, what is allowed, what to do next. Programming errors assert.
///
/// Each sentence has an id, which stays when its wording changes: tests, the guide and other programs go by the id. Programs print it
/// in brackets behind the sentence.
///
/// TRY(const X x, f()); is `const X x` with the value of f(), or ends the function with f()'s error.
/// TRY_VOID(g()); is the same where there is no value. The compiler refuses a value that holds something, such as a context or
/// a lock: name it with TRY, or drop it with TRY_VOID(without_value(g())).
#pragma once

#include <fmt/format.h>
#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace frustumscreen {

/// Who acts on an error.
enum class ErrorKind {
    BadInput,         ///< outside bytes are wrong: refuse them, keep running
    DeviceLost,       ///< a device went away: reconnect
    BadConfiguration, ///< a person must change something; a service is restarted until that is done
    Internal,         ///< this program cannot go on: the service manager restarts it
};

/// `subject.problem`, in small letters, digits and `_`; written as a literal beside its sentence, and checked when it is compiled.
class MessageId {
public:
    /// Implicit: a literal is an id wherever one is asked for.
    consteval MessageId(const char* id) : id_(id) {
        if (!is_well_formed(id_)) {
            throw "a message's id is subject.problem, in small letters, digits and _"; // ends the compilation
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
/// Another kind of the same error, since another person acts on it here.
[[nodiscard]] inline tl::unexpected<Error> as_kind(ErrorKind kind, Error error) {
    error.kind = kind;
    return tl::unexpected<Error>(std::move(error));
}

/// Puts `place` (a file, a part of it) in front of an error's message.
[[nodiscard]] inline tl::unexpected<Error> at(const std::string& place, Error error) {
    error.message = place + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
}
/// The same for a result, if it is an error.
template <typename T> [[nodiscard]] Result<T> at(const std::string& place, Result<T> result) {
    if (!result) {
        result.error().message = place + ": " + result.error().message;
    }
    return result;
}

/// A result without its value, which ends here.
template <typename T, typename E>
[[nodiscard]] tl::expected<void, E> without_value(tl::expected<T, E> result) {
    return std::move(result).map([](T&&) {});
}

/// Whether nothing ends with a result's value: there is none, it holds nothing, or the result has a name and keeps it.
template <typename ResultReference>
inline constexpr bool may_be_dropped =
    std::is_lvalue_reference_v<ResultReference> ||
    std::is_void_v<typename std::remove_reference_t<ResultReference>::value_type> ||
    std::is_trivially_destructible_v<typename std::remove_reference_t<ResultReference>::value_type>;

} // namespace frustumscreen

/// The value is moved out of its result; both live to the end of the scope. `variable` is a declaration without a
/// comma (auto, where the type has one) or something to assign to; the function may return a Result of any type.
#define TRY(variable, ...) FRUSTUMSCREEN_TRY_COUNTED(__COUNTER__, variable, __VA_ARGS__)
#define FRUSTUMSCREEN_TRY_COUNTED(count, variable, ...) FRUSTUMSCREEN_TRY_NAMED(count, variable, __VA_ARGS__)
#define FRUSTUMSCREEN_TRY_NAMED(count, variable, ...)                                                        \
    auto result_of_try_##count = __VA_ARGS__;                                                                \
    if (!result_of_try_##count) {                                                                            \
        return tl::unexpected(std::move(result_of_try_##count).error());                                     \
    }                                                                                                        \
    variable = *std::move(result_of_try_##count)

/// A result that has a name keeps its value.
#define TRY_VOID(...)                                                                                        \
    if (auto&& result_of_try = __VA_ARGS__; !result_of_try) {                                                \
        static_assert(frustumscreen::may_be_dropped<decltype(result_of_try)>,                                \
                      "TRY_VOID drops what the value holds; name it with TRY");                              \
        return tl::unexpected(std::forward<decltype(result_of_try)>(result_of_try).error());                 \
    }
