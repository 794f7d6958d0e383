/// Looks into a JSON document that another program wrote: what is missing or of another type is nothing.
///
/// Threads  pure; any. The document outlives its fields.
/// Errors   none. Texts come as one printable line.
#pragma once

#include "firmware_host/base/json.h"

#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

class JsonFields {
public:
    explicit JsonFields(const nlohmann::json& value) : value_(&value) {}

    /// It is an object, perhaps an empty one.
    [[nodiscard]] bool there() const { return value_ != nullptr && value_->is_object(); }
    [[nodiscard]] JsonFields at(const char* key) const { return JsonFields(find(key)); }
    /// Empty where it is no text.
    [[nodiscard]] std::string text(const char* key) const;
    [[nodiscard]] std::optional<double> number(const char* key) const;
    [[nodiscard]] std::optional<bool> flag(const char* key) const;
    [[nodiscard]] std::vector<JsonFields> list(const char* key) const;
    /// Those of a list that are texts.
    [[nodiscard]] std::vector<std::string> texts(const char* key) const;

private:
    explicit JsonFields(const nlohmann::json* value) : value_(value) {}
    [[nodiscard]] const nlohmann::json* find(const char* key) const;

    const nlohmann::json* value_; ///< null: nothing
};

} // namespace frustumscreen
