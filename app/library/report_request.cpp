#include "app/library/report_request.h"

#include "app/library/import_failure.h"
#include "app/library/stick_pack.h"
#include "app/settings/toml_file.h"
#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <optional>
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

ImportedPack refused_request(const ImportFailure& failure) {
    ImportedPack line{std::string(report_request_name), "", {}, {}, ""};
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
                {ImportRefusal::NotAPack,
                 fmt::format("it is too large; allowed are at most {} bytes, and it may be empty",
                             max_report_request_bytes),
                 false}));
        } else if (number == EINVAL || number == ELOOP) {
            written.push_back(refused_request(
                {ImportRefusal::NotAPack, "it is no ordinary file; make an empty file of this name", false}));
        }
        return written; // none, or the stick fails, which the import tells
    }
    if (written.empty()) {
        written.push_back({std::string(report_request_name), "", ImportOutcome::NotWritten,
                           ImportRefusal::Unwritable,
                           "the kiosk stopped before the report was written; put the stick in again"});
    }
    if (const std::optional<std::string> fault = fault_of_request(*request)) {
        written.push_back(refused_request({ImportRefusal::NotAPack, *fault, false}));
    }
    return written;
}

} // namespace frustumscreen
