#include "app/programs/frustumscreen/run_show.h"

#include "app/show/artifact_show.h"
#include "app/show/installed_show.h"
#include "app/show/kept_volume.h"
#include "app/show/library_watch.h"
#include "app/show/live_exhibit.h"
#include "app/show/pattern_show.h"
#include "firmware_host/base/standard_error.h"

#include <string>
#include <utility>

namespace frustumscreen {

Result<std::unique_ptr<Show>> make_show(const RunRequest& request, const Settings& settings,
                                        const DevicePlan& devices, const Display& display,
                                        MonotonicTime start) {
    if (request.pattern) {
        return PatternShow::create(settings);
    }
    ArtifactShowOptions options = request.show;
    options.waits = request.fast;
    const bool from_library = options.packs.empty();
    if (from_library) {
        options.packs = settings.exhibit.packs;
        options.packs_key = settings.exhibit.packs_key;
    }
    // Only a run in real time takes other sets, so that a run in simulated time is repeatable.
    const bool watches = from_library && !request.fast && library_is_there(settings);
    options.other_sets = watches;
    const auto create = [&](const ArtifactShowOptions& each) {
        return ArtifactShow::create(settings, devices, each, {display.framebuffer(), 0});
    };
    InstalledShow installed;
    if (from_library) {
        installed = show_installed_set(settings, options, request.trust, create);
    }
    TRY(std::unique_ptr<ArtifactShow> artifacts,
        installed.show ? std::move(installed.show) : create(options));
    for (const std::string& note : artifacts->notes()) {
        say_line("frustumscreen", note);
    }
    Exhibit exhibit = make_exhibit(settings, *artifacts, start);
    exhibit.set_louder_db(read_kept_volume(request.places.volume_file(), settings.sound.gain_db));
    ArtifactShow& stage = *artifacts;
    auto live = std::make_unique<LiveExhibit>(
        settings, std::move(artifacts), std::move(exhibit), display.name(),
        request.fast ? PromptReader::Answer::Always : PromptReader::Answer::WhenReady);
    if (watches) {
        live->watch(stage,
                    std::make_unique<LibraryWatch>(
                        settings, LibraryWatch::SetUp{settings.exhibit.library, stage.set_options(),
                                                      stage.expected_frames(), std::move(installed.start),
                                                      stage.set().number}));
    }
    return live;
}

Result<std::unique_ptr<Show>> make_error_screen(const Settings& settings, const Journal& journal,
                                                const Error& why) {
    journal.note(LogPriority::Error, why.message, {{"DEVICE", "exhibit"}});
    Result<std::unique_ptr<PatternShow>> pattern = PatternShow::create(settings);
    if (!pattern) {
        return tl::unexpected<Error>(why);
    }
    (*pattern)->set_lines({why.message});
    (*pattern)->is_fault();
    return std::move(*pattern);
}

} // namespace frustumscreen
