#include "app/library/report_request.h"

#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "app/pack/container/limits.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <span>
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

ImportedPack refused_request(std::string_view name, std::string reason) {
    ImportedPack line{.file = std::string(name), .title = "", .outcome = {}, .refusal = {}, .reason = ""};
    refuse(line, {.refusal = ImportRefusal::NotAPack, .reason = std::move(reason), .whole = false});
    return line;
}

/// Why a file of a request's name is none; nothing: it is one, is missing, or the stick fails, which the import tells.
std::optional<std::string> fault_of_file(const FileResult<std::string>& file, std::string_view allowed) {
    const int number = file ? 0 : file.error().number;
    if (number == EFBIG) {
        return fmt::format("it is too large; allowed are at most {} bytes, and {}", max_report_request_bytes,
                           allowed);
    }
    if (number == EINVAL || number == ELOOP) {
        return std::string("it is not a regular file; make an empty file of this name");
    }
    return std::nullopt;
}

bool are_about(std::span<const ImportedPack> lines, std::string_view name) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const ImportedPack& line) { return line.file == name; });
}

bool is_pending_request(const ImportedPack& line, ImportRefusal refusal) {
    return line.file == copy_request_name && line.outcome == ImportOutcome::Pending &&
           line.refusal == refusal;
}

} // namespace

bool waits_for_staff(FileTree& stick) {
    const FileResult<std::string> request = read_text(stick, copy_request_name, max_copy_request_bytes);
    const FileResult<std::string> signature =
        read_text(stick, copy_request_signature, pack::max_signature_bytes);
    return request && request->empty() && !signature && signature.error().number == ENOENT;
}

ImportedPack copy_offer() {
    return {.file = std::string(copy_request_name),
            .title = "",
            .outcome = ImportOutcome::Pending,
            .refusal = ImportRefusal::Unsigned,
            .reason =
                "it waits for the staff; to copy settings, calibration, visits and packs to the stick, "
                "leave it in, show the staff's picture within ten minutes, turn to its page Copy to the "
                "stick, and hold the first button for two seconds"};
}

bool offers_copy(const ImportedPack& line) {
    return is_pending_request(line, ImportRefusal::Unsigned);
}

bool offers_reset(const ImportedPack& line) {
    return is_pending_request(line, ImportRefusal::None);
}

std::vector<ImportedPack>
lines_of_stick_report(FileTree& stick, std::optional<std::vector<ImportedPack>> outcome, bool is_confirmed) {
    const bool has_word = outcome.has_value();
    static_assert(max_report_request_bytes == max_copy_request_bytes);
    const FileResult<std::string> report = read_text(stick, report_request_name, max_report_request_bytes);
    const FileResult<std::string> copy = read_text(stick, copy_request_name, max_copy_request_bytes);
    std::vector<ImportedPack> written = std::move(outcome).value_or(std::vector<ImportedPack>());
    const bool asks_for_copy = copy && (is_confirmed || !waits_for_staff(stick));
    if (!has_word && (report || asks_for_copy)) {
        written.push_back(
            {.file = std::string(report ? report_request_name : copy_request_name),
             .title = "",
             .outcome = ImportOutcome::NotWritten,
             .refusal = ImportRefusal::Unwritable,
             .reason = "the kiosk stopped before the report was written; put the stick in again"});
    }
    if (std::optional<std::string> fault = fault_of_file(report, "it may be empty")) {
        written.push_back(refused_request(report_request_name, *std::move(fault)));
    }
    if (std::optional<std::string> fault = fault_of_file(copy, "it is signed");
        fault && !are_about(written, copy_request_name)) {
        written.push_back(refused_request(copy_request_name, *std::move(fault)));
    }
    if (std::optional<std::string> fault = report ? fault_of_request(*report) : std::nullopt) {
        written.push_back(refused_request(report_request_name, *std::move(fault)));
    }
    return written;
}

} // namespace frustumscreen::library
