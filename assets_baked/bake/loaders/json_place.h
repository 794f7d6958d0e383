/// A JSON value with its place, so that every refusal names the place: `accessors[3].bufferView: 7 is out of range, the
/// file has 4`.
///
/// Lifetime  a JsonPlace points into the document it came from.
/// Errors    throws Refusal for a missing member, a wrong type, a number outside the allowed range.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::bake {

class JsonPlace {
public:
    JsonPlace(const nlohmann::json& value, std::string path) : value_(&value), path_(std::move(path)) {}

    [[nodiscard]] const std::string& path() const { return path_; }

    /// A member of an object.
    [[nodiscard]] std::optional<JsonPlace> find(std::string_view key) const;
    [[nodiscard]] JsonPlace at(std::string_view key) const;
    /// Names of an object's members.
    [[nodiscard]] std::vector<std::string> keys() const;

    /// Names of the members of every "extensions" object inside, in the alphabet's order.
    [[nodiscard]] std::set<std::string> extensions_inside() const;

    /// Elements of an array.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] JsonPlace operator[](std::size_t i) const;

    [[nodiscard]] std::uint64_t whole(std::uint64_t least = 0, std::uint64_t most = largest_whole) const;
    /// A reference into an array of `size` elements.
    [[nodiscard]] std::size_t index_into(std::size_t size) const;
    [[nodiscard]] double number() const;
    /// Exactly `count` numbers (any count if 0).
    [[nodiscard]] std::vector<double> numbers(std::size_t count = 0) const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool truth() const;

    [[nodiscard]] std::uint64_t whole_or(std::string_view key, std::uint64_t fallback,
                                         std::uint64_t most = largest_whole) const;
    [[nodiscard]] double number_or(std::string_view key, double fallback) const;
    [[nodiscard]] std::string text_or(std::string_view key, std::string_view fallback) const;
    [[nodiscard]] bool truth_or(std::string_view key, bool fallback) const;
    [[nodiscard]] std::optional<std::size_t> index_or_none(std::string_view key, std::size_t size) const;
    /// Length of the array under `key`, 0 if there is none.
    [[nodiscard]] std::size_t size_of(std::string_view key) const;

    /// Integers above 2^53 are not exact in JSON.
    static constexpr std::uint64_t largest_whole = std::uint64_t{1} << 53;

private:
    [[noreturn]] void refuse_type(const char* expected) const;

    const nlohmann::json* value_;
    std::string path_;
};

} // namespace frustumscreen::bake
