/// Reads one JSON object field by field: what is asked for is consumed, what is left over is refused.
///
/// Errors   the first one is kept in `Refusal`, as one line: the field's place, what was found, what is
///          allowed. After it every call returns without effect, so callers read on without asking.
/// Threads  one caller.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack_format {

struct Refusal {
    std::optional<std::string> message;
    void refuse(const std::string& place, std::string_view what);
};

class JsonFields {
public:
    /// `object` may be null or no object: that is refused.
    JsonFields(Refusal& refusal, const nlohmann::json* object, std::string place);

    [[nodiscard]] std::string text(const char* key);
    [[nodiscard]] std::vector<std::string> texts(const char* key, std::size_t most);
    [[nodiscard]] bool flag(const char* key);
    [[nodiscard]] std::uint64_t whole(const char* key, std::uint64_t most);
    [[nodiscard]] double number(const char* key);
    /// Exactly `values.size()` numbers.
    void numbers(const char* key, std::span<double> values);
    /// Lists of exactly three numbers each.
    [[nodiscard]] std::vector<std::array<double, 3>> triples(const char* key, std::size_t most);
    [[nodiscard]] JsonFields object(const char* key);
    [[nodiscard]] std::vector<JsonFields> objects(const char* key, std::size_t most);
    /// A field that may be null; nothing if it is.
    [[nodiscard]] std::optional<JsonFields> object_or_null(const char* key);
    /// Refuses fields that nobody asked for. Call once, last.
    void finish();

    void refuse(const char* key, std::string_view what) { refusal_->refuse(place_of(key), what); }

private:
    [[nodiscard]] const nlohmann::json* take(const char* key);
    [[nodiscard]] const nlohmann::json* take_list(const char* key, std::size_t most);
    [[nodiscard]] std::string place_of(const char* key) const;

    Refusal* refusal_;
    const nlohmann::json* object_;
    std::string place_;
    std::set<std::string> known_;
};

/// The document. Refused: what is not JSON (with the byte where that shows), a field that stands twice.
[[nodiscard]] nlohmann::json parse_json(Refusal& refusal, std::string_view text);

} // namespace frustumscreen::pack_format
