/// A small JSON document of the project, read and written by the same description (JsonReader, JsonWriter).
///
/// Errors   the first one, as one line.
/// Threads  pure; any.
#pragma once

#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace frustumscreen::library {

/// `name` is used in messages, such as "the verdict". `describe(fields, value)` names the fields.
template <typename Value>
[[nodiscard]] Result<Value> parse_document(std::string_view json, const std::string& name,
                                           std::size_t max_bytes, const auto& describe) {
    if (json.size() > max_bytes) {
        return bad_input("library.document_too_long", "{} has {} bytes; allowed are {}", name, json.size(),
                         max_bytes);
    }
    pack::Refusal refusal{{}, name};
    const nlohmann::json document = pack::parse_json(refusal, json);
    Value value;
    if (!refusal.error) {
        pack::JsonReader fields(refusal, &document, "");
        describe(fields, value);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    return value;
}

template <typename Value> [[nodiscard]] std::string write_document(const Value& value, const auto& describe) {
    pack::JsonWriter fields;
    describe(fields, value);
    // Invalid UTF-8 is replaced: a name on a stick must not make a report fail.
    return fields.document().dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace frustumscreen::library
