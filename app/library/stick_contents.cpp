#include "app/library/stick_contents.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace frustumscreen {

std::vector<ImportedPack> lines_of(const StickContents& contents, const ImportRequest& request,
                                   const std::vector<InstalledPack>& removed) {
    std::vector<ImportedPack> lines;
    const auto add = [&](const std::optional<ImportedPack>& line) {
        if (line) {
            lines.push_back(*line);
        }
    };
    add(request.settings);
    lines.insert(lines.end(), request.kiosk.begin(), request.kiosk.end());
    lines.insert(lines.end(), request.stick_report.begin(), request.stick_report.end());
    add(contents.exhibit_line);
    for (const StickPack& pack : contents.packs) {
        lines.push_back(pack.told);
    }
    const StickFiles& files = contents.files;
    lines.insert(lines.end(), files.refused.begin(), files.refused.end());
    add(files.misnamed);
    if (request.takes_settings && !request.settings) {
        add(files.misnamed_settings);
    }
    if (request.writes_reports && request.stick_report.empty()) {
        add(files.misnamed_request);
    }
    if (request.takes_settings) {
        lines.insert(lines.end(), files.misnamed_copy.begin(), files.misnamed_copy.end());
    }
    for (const InstalledPack& pack : removed) {
        lines.push_back(removed_line(pack));
    }
    return lines;
}

void refuse_whole(StickContents& contents, const ImportFailure& failure) {
    std::optional<ImportedPack>& exhibit_line = contents.exhibit_line;
    const bool is_by_exhibit_file =
        exhibit_line && (exhibit_line->outcome == ImportOutcome::Refused || failure.by_set_file);
    std::string of_each =
        "nothing of this stick was taken" +
        (is_by_exhibit_file ? fmt::format(", because of {}", exhibit_file_name) : ": " + failure.reason);
    if (exhibit_line && exhibit_line->outcome != ImportOutcome::Refused) {
        refuse(*exhibit_line, is_by_exhibit_file ? failure : ImportFailure{failure.refusal, of_each, false});
    }
    refuse_all(contents.packs, {failure.refusal, std::move(of_each), false});
}

} // namespace frustumscreen
