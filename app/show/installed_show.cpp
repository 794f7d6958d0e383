#include "app/show/installed_show.h"

#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <utility>

namespace frustumscreen::show {

bool library_is_there(const settings::Settings& settings) {
    std::error_code failed;
    return !settings.exhibit.library.empty() &&
           std::filesystem::is_directory(settings.exhibit.library, failed);
}

InstalledShow show_installed_set(
    const settings::Settings& settings, const ArtifactShowOptions& options, Trust trust,
    const std::function<Result<std::unique_ptr<ArtifactShow>>(const ArtifactShowOptions&)>& create) {
    InstalledShow installed;
    if (!library_is_there(settings)) {
        return installed;
    }
    const std::filesystem::path& library = settings.exhibit.library;
    const auto options_for = [&](const library::InstalledSet& set) {
        const SetRequest request = request_of(set, library, settings);
        ArtifactShowOptions own = options;
        own.packs = request.packs;
        own.packs_key = request.packs_key;
        own.set_number = request.number;
        own.attract = request.attract;
        return own;
    };
    installed.start = start_library(library, trust);
    if (!installed.start.trouble.empty()) {
        say_line(options.program, installed.start.trouble);
    }
    std::optional<SetTrial>& trial = installed.start.trial;
    const std::optional<SetTrial> before = trial;
    for (int step = 0; step < 2 && trial && !installed.show; ++step) { // a bad set leads to the previous one
        const library::InstalledSet target = trial->target();
        Result<std::unique_ptr<ArtifactShow>> show = create(options_for(target));
        if (!show && target.packs.empty()) { // the new set without its bad packs is better than nothing
            show = create(options_for(trial->choice().set));
        }
        const std::string fault = show ? fault_of((*show)->left_out(), false) : show.error().message;
        if (!fault.empty()) {
            say_line(options.program, fmt::format("set {}: {}", target.number, fault));
            trial->refuse(target.number, fault);
        }
        if (show && trial->target().number == target.number) {
            installed.show = std::move(*show);
        }
    }
    if (!installed.show) {
        trial = before; // if the previous set cannot be shown either, the cause may be the driver
    }
    if (trial && trial->verdict() != before->verdict()) {
        const Result<void> kept = keep_verdict(library, trial->verdict());
        trial->note_kept(kept.has_value());
        installed.start.trouble = kept ? "" : kept.error().message;
    }
    return installed;
}

} // namespace frustumscreen::show
