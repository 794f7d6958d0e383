#include "app/status/status_report.h"

#include "app/status/describe_status.h"
#include "app/status/status_fields.h"

#include <fmt/format.h>

namespace frustumscreen::status {

namespace {

/// Walks the description and writes a row for each field that has a sentence; fields within another one have none.
class FieldTable {
public:
    void field(const char* key, const auto& /*value*/, std::string_view said, const Metric& /*metric*/ = {},
               Digits /*digits*/ = {}) {
        row(key, said);
    }
    void word(const char* key, const auto& /*value*/, std::string_view said, const auto& /*all*/,
              const auto& /*word_for*/, const Metric& /*metric*/) {
        row(key, said);
    }
    void object(const char* key, std::string_view said, const auto& /*describe*/) { row(key, said); }
    void objects(const char* key, const auto& /*values*/, std::string_view said, const Metric& /*metric*/,
                 const auto& /*describe*/) {
        row(key, said);
    }
    void object_or_null(const char* key, const auto& /*value*/, std::string_view said,
                        const Metric& /*metric*/, const auto& /*describe*/) {
        row(key, said);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void row(const char* key, std::string_view said) { text_ += fmt::format("| `{}` | {} |\n", key, said); }

    std::string text_;
};

} // namespace

std::string status_json(const StatusReport& report) {
    StatusWriter fields;
    all_status_fields(fields, report);
    return fields.text();
}

StatusReport read_status_report(const nlohmann::json& document) {
    StatusReader fields(document);
    StatusReport report;
    all_status_fields(fields, report);
    return report;
}

std::string status_field_table() {
    FieldTable fields;
    const StatusReport report;
    all_status_fields(fields, report);
    return fields.text();
}

} // namespace frustumscreen::status
