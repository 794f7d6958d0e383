#include "app/programs/frustumscreen/run_show.h"

#include "app/room/room_file.h"
#include "app/show/artifact_show.h"
#include "app/show/installed_show.h"
#include "app/show/kept_volume.h"
#include "app/show/library_watch.h"
#include "app/show/live_exhibit.h"
#include "app/show/pattern_show.h"
#include "app/show/room_taking.h"
#include "firmware_host/base/standard_error.h"

#include <string>
#include <utility>

namespace frustumscreen::programs {

namespace {

/// The screen's output reports a room that cannot be read; the artifacts are then only in the prop.
void take_from_room(const settings::Settings& settings, MonotonicTime start, show::LiveExhibit& live) {
    const Result<room::Room> room = room::read_room(settings.screen.room);
    if (!room) {
        return;
    }
    Result<std::unique_ptr<show::RoomTaking>> taking = show::RoomTaking::create(settings, *room, start);
    if (taking) {
        live.set_room(*std::move(taking));
    } else {
        say_line("frustumscreen", taking.error().message);
    }
}

} // namespace

Result<std::unique_ptr<show::Show>> make_show(const RunRequest& request, const settings::Settings& settings,
                                              const scene::DevicePlan& devices,
                                              const display::Display& display, MonotonicTime start) {
    if (request.pattern) {
        return show::PatternShow::create(settings);
    }
    show::ArtifactShowOptions options = request.show;
    options.waits = request.fast;
    const bool from_library = options.packs.empty();
    if (from_library) {
        options.packs = settings.exhibit.packs;
        options.packs_key = settings.exhibit.packs_key;
    }
    // Only a run in real time takes other sets, so that a run in simulated time is repeatable.
    const bool watches = from_library && !request.fast && show::library_is_there(settings);
    options.other_sets = watches;
    const auto create = [&](const show::ArtifactShowOptions& each) {
        return show::ArtifactShow::create(settings, devices, each, {display.framebuffer(), 0});
    };
    show::InstalledShow installed;
    if (from_library) {
        installed = show::show_installed_set(settings, options, request.trust, create);
    }
    TRY(std::unique_ptr<show::ArtifactShow> artifacts,
        installed.show ? std::move(installed.show) : create(options));
    for (const std::string& note : artifacts->notes()) {
        say_line("frustumscreen", note);
    }
    exhibit::Exhibit exhibit = show::make_exhibit(settings, *artifacts, start);
    exhibit.set_louder_db(show::read_kept_volume(request.places.volume_file(), settings.sound.gain_db));
    show::ArtifactShow& stage = *artifacts;
    auto live = std::make_unique<show::LiveExhibit>(
        settings, std::move(artifacts), std::move(exhibit), display.name(),
        request.fast ? residency::PromptReader::Answer::Always : residency::PromptReader::Answer::WhenReady);
    if (watches) {
        live->watch(stage, std::make_unique<show::LibraryWatch>(
                               settings, show::LibraryWatch::SetUp{.library = settings.exhibit.library,
                                                                   .options = stage.set_options(),
                                                                   .frames = stage.expected_frames(),
                                                                   .start = std::move(installed.start),
                                                                   .shown = stage.set().number}));
    }
    if (settings.screen.exists()) {
        take_from_room(settings, start, *live);
    }
    return live;
}

Result<std::unique_ptr<show::Show>> make_error_screen(const settings::Settings& settings,
                                                      const service::Journal& journal, const Error& why) {
    journal.note(service::LogPriority::Error, why.message, {{"DEVICE", "exhibit"}});
    Result<std::unique_ptr<show::PatternShow>> pattern = show::PatternShow::create(settings);
    if (!pattern) {
        return tl::unexpected<Error>(why);
    }
    (*pattern)->set_lines({why.message});
    (*pattern)->is_fault();
    return std::move(*pattern);
}

} // namespace frustumscreen::programs
