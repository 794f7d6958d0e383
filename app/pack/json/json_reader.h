/// Reads one JSON object field by field: requested fields are consumed, remaining fields are refused.
///
/// Errors   the first one is kept in `Refusal`, as one line: the field's place, the value found, the allowed
///          values. After it every call does nothing, so callers need not check each call.
/// Threads  one caller.
#pragma once

#include "app/pack/container/limits.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

struct Refusal {
    std::optional<Error> error;
    std::string document = "the manifest"; ///< document being read, for messages
    void refuse(MessageId id, const std::string& place, std::string_view what);
};

class JsonReader {
public:
    /// `object` may be null or not an object: both are refused.
    JsonReader(Refusal& refusal, const nlohmann::json* object, std::string place);

    /// A field whose value was checked before.
    void fixed(const char* key, const auto& /*value*/) { static_cast<void>(take(key)); }
    void text(const char* key, std::string& value);
    void texts(const char* key, std::vector<std::string>& values, std::size_t most);
    void flag(const char* key, bool& value);
    /// An optional field.
    void flag_or(const char* key, bool& value, bool left_out);
    template <typename Whole> void whole(const char* key, Whole& value, std::uint64_t most) {
        value = static_cast<Whole>(whole_of(key, most));
    }
    /// As above, or null: none.
    template <typename Whole>
    void whole_or_null(const char* key, std::optional<Whole>& value, std::uint64_t most) {
        if (const nlohmann::json* read = take(key); read != nullptr && !read->is_null()) {
            whole(key, value.emplace(), most);
        }
    }
    void number(const char* key, float& value);
    void number(const char* key, double& value);
    /// An optional field.
    void number_or(const char* key, double& value, double left_out);
    /// Exactly `values.size()` numbers.
    void numbers(const char* key, std::span<double> values);
    /// Lists of exactly three numbers each.
    void triples(const char* key, std::vector<glm::dvec3>& values, std::size_t most);
    /// The value whose number is the index of the word found.
    template <typename Choice>
    void choice(const char* key, Choice& value, std::span<const std::string_view> words) {
        value = static_cast<Choice>(word_of(key, words));
    }
    /// Index of the name found; an unknown name is refused with `otherwise`.
    void name_in(const char* key, std::uint32_t& index, std::span<const std::string> names,
                 std::string_view otherwise);
    void object(const char* key, const auto& describe) {
        JsonReader inner(*refusal_, take(key), place_of(key));
        describe(inner);
        inner.finish();
    }
    /// A field that may be null.
    template <typename Value>
    void object_or_null(const char* key, std::optional<Value>& value, const auto& describe) {
        if (const nlohmann::json* found = take(key); found != nullptr && !found->is_null()) {
            JsonReader inner(*refusal_, found, place_of(key));
            describe(inner, value.emplace());
            inner.finish();
        }
    }
    template <typename Value>
    void objects(const char* key, std::vector<Value>& values, std::size_t most, const auto& describe) {
        const nlohmann::json* list = take_list(key, most);
        for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
            JsonReader item(*refusal_, &(*list)[k], place_of(key, k));
            describe(item, values.emplace_back());
            item.finish();
        }
    }
    /// One value for each field of the object `key`, with the field's name, in the names' order. The object
    /// is optional.
    template <typename Value>
    void members_or_none(const char* key, std::vector<Value>& values, std::size_t most,
                         const auto& describe) {
        const nlohmann::json* object = take_members(key, most);
        if (object == nullptr) {
            return;
        }
        for (const auto& [name, value] : object->items()) {
            JsonReader item(*refusal_, &value, place_of(key) + "." + printable_name(name));
            describe(item, values.emplace_back());
            values.back().name = name;
            item.finish();
        }
    }
    /// An object with any fields, as text: keys in order, without white space.
    void free_object(const char* key, std::string& text);
    /// Refuses fields that were not requested. Call once, last.
    void finish();

    void refuse(MessageId id, const char* key, std::string_view what) {
        refusal_->refuse(id, place_of(key), what);
    }

private:
    [[nodiscard]] const nlohmann::json* take(const char* key);
    [[nodiscard]] const nlohmann::json* take_list(const char* key, std::size_t most);
    [[nodiscard]] const nlohmann::json* take_members(const char* key, std::size_t most);
    [[nodiscard]] static std::string printable_name(const std::string& name);
    [[nodiscard]] std::uint64_t whole_of(const char* key, std::uint64_t most);
    [[nodiscard]] std::size_t word_of(const char* key, std::span<const std::string_view> words);
    [[nodiscard]] std::string place_of(const char* key) const;
    [[nodiscard]] std::string place_of(const char* key, std::size_t item) const;

    Refusal* refusal_;
    const nlohmann::json* object_;
    std::string place_;
    std::set<std::string> known_;
};

/// Parses the document. It refuses text that is not JSON (with the position in bytes), a field that occurs
/// twice, and objects and lists nested too deeply.
[[nodiscard]] nlohmann::json parse_json(Refusal& refusal, std::string_view text,
                                        std::size_t max_depth = max_manifest_depth);

} // namespace frustumscreen::pack
