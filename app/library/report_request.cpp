#include "app/library/report_request.h"

#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen {

namespace {

/// No key is allowed yet.
std::optional<std::string> fault_of_request(std::string_view text) {
    ReadState state{std::string(report_request_name), {}, {}, std::nullopt};
    read_toml(state, text, max_report_request_bytes, [&](const toml::table& root) {
        TableReader keys(state, &root, "");
        keys.finish();
    });
    return state.error ? std::optional(state.error->message + "; the file may be empty") : std::nullopt;
}

ImportedPack refused_request(std::string_view name, std::string reason) {
    ImportedPack line{std::string(name), "", {}, {}, ""};
    refuse(line, {ImportRefusal::NotAPack, std::move(reason), false});
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
        return std::string("it is no ordinary file; make an empty file of this name");
    }
    return std::nullopt;
}

bool are_about(std::span<const ImportedPack> lines, std::string_view name) {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const ImportedPack& line) { return line.file == name; });
}

} // namespace

std::vector<ImportedPack> lines_of_stick_report(FileTree& stick,
                                                std::optional<std::vector<ImportedPack>> outcome) {
    const bool has_word = outcome.has_value();
    static_assert(max_report_request_bytes == max_copy_request_bytes);
    const FileResult<std::string> report = read_text(stick, report_request_name, max_report_request_bytes);
    const FileResult<std::string> copy = read_text(stick, copy_request_name, max_copy_request_bytes);
    std::vector<ImportedPack> written = std::move(outcome).value_or(std::vector<ImportedPack>());
    if (!has_word && (report || copy)) {
        written.push_back({std::string(report ? report_request_name : copy_request_name), "",
                           ImportOutcome::NotWritten, ImportRefusal::Unwritable,
                           "the kiosk stopped before the report was written; put the stick in again"});
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

} // namespace frustumscreen
