#include "app/library/import_report.h"

#include "app/library/json_document.h"
#include "firmware_host/base/printable.h"

#include <limits>

namespace frustumscreen::library {

namespace {

constexpr std::size_t max_report_bytes = 8U << 20U;
constexpr std::size_t max_reported_packs = 4000;
constexpr std::size_t max_text_bytes = 1000;
constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

void report_fields(auto& fields, auto& report) {
    fields.text("import_id", report.import_id);
    fields.text("stick", report.stick);
    fields.choice("stage", report.stage, import_stage_names);
    fields.whole("done_bytes", report.done_bytes, no_limit);
    fields.whole("total_bytes", report.total_bytes, no_limit);
    fields.choice("refusal", report.refusal, import_refusal_names);
    fields.text("reason", report.reason);
    fields.whole("set_number", report.set_number, no_limit);
    fields.objects("packs", report.packs, max_reported_packs, [](auto& item, auto& pack) {
        item.text("file", pack.file);
        item.text("title", pack.title);
        item.choice("outcome", pack.outcome, import_outcome_names);
        item.choice("refusal", pack.refusal, import_refusal_names);
        item.text("reason", pack.reason);
    });
}

/// The texts may come from any writer, and go to the table and the journal.
void make_printable(ImportReport& report) {
    for (std::string* text : {&report.import_id, &report.stick, &report.reason}) {
        *text = printable(*text, max_text_bytes);
    }
    for (ImportedPack& pack : report.packs) {
        for (std::string* text : {&pack.file, &pack.title, &pack.reason}) {
            *text = printable(*text, max_text_bytes);
        }
    }
}

} // namespace

Result<ImportReport> parse_import_report(std::string_view json) {
    Result<ImportReport> report =
        parse_document<ImportReport>(json, "the report", max_report_bytes,
                                     [](auto& fields, auto& value) { report_fields(fields, value); });
    if (report) {
        make_printable(*report);
    }
    return report;
}

std::string write_import_report(const ImportReport& report) {
    return write_document(report, [](auto& fields, auto& value) { report_fields(fields, value); });
}

} // namespace frustumscreen::library
