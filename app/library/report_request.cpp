#include "app/library/report_request.h"

#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <optional>
#include <utility>

namespace frustumscreen::library {

namespace {

/// No key is allowed yet.
std::optional<std::string> fault_of_request(std::string_view text) {
    settings::ReadState state{
        .file = std::string(report_request_name), .folder = {}, .lines = {}, .error = std::nullopt};
    settings::read_toml(state, text, max_report_request_bytes, [&](const toml::table& root) {
        settings::TableReader keys(state, &root, "");
        keys.finish();
    });
    return state.error ? std::optional(state.error->message + "; the file may be empty") : std::nullopt;
}

ImportedPack refused_request(const ImportFailure& failure) {
    ImportedPack line{
        .file = std::string(report_request_name), .title = "", .outcome = {}, .refusal = {}, .reason = ""};
    refuse(line, failure);
    return line;
}

} // namespace

std::vector<ImportedPack> lines_of_stick_report(FileTree& stick, std::vector<ImportedPack> written) {
    const FileResult<std::string> request = read_text(stick, report_request_name, max_report_request_bytes);
    if (!request) {
        const int number = request.error().number;
        if (number == EFBIG) {
            written.push_back(refused_request(
                {.refusal = ImportRefusal::NotAPack,
                 .reason = fmt::format("it is too large; allowed are at most {} bytes, and it may be empty",
                                       max_report_request_bytes),
                 .whole = false}));
        } else if (number == EINVAL || number == ELOOP) {
            written.push_back(
                refused_request({.refusal = ImportRefusal::NotAPack,
                                 .reason = "it is no ordinary file; make an empty file of this name",
                                 .whole = false}));
        }
        return written; // none, or the stick fails, which the import tells
    }
    if (written.empty()) {
        written.push_back(
            {.file = std::string(report_request_name),
             .title = "",
             .outcome = ImportOutcome::NotWritten,
             .refusal = ImportRefusal::Unwritable,
             .reason = "the kiosk stopped before the report was written; put the stick in again"});
    }
    if (const std::optional<std::string> fault = fault_of_request(*request)) {
        written.push_back(
            refused_request({.refusal = ImportRefusal::NotAPack, .reason = *fault, .whole = false}));
    }
    return written;
}

} // namespace frustumscreen::library
