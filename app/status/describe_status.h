/// Every field of the exhibit's status, described once: its key, its sentence in docs/status.md, and its Prometheus
/// metric if it has one. The writer and the reader of the status file (status_fields.h), the page's table
/// (status_report.cpp) and the metrics for Prometheus walk this description, in this order. A reader has filled in
/// the earlier lines when it comes to a line.
///
/// Threads  pure; any.
#pragma once

#include "app/exhibit/states.h"
#include "app/status/describe_devices.h"
#include "app/status/metric.h"
#include "app/status/status_report.h"
#include "firmware_host/service/watchdog_policy.h"

#include <array>
#include <string_view>

namespace frustumscreen::status {

inline constexpr std::array all_healths{service::Health::Well, service::Health::NoPicture,
                                        service::Health::FrozenCode, service::Health::ThreadHangs,
                                        service::Health::Hangs};
/// Millimetres, to 0.1 micrometre: a finest level is off by less than a micrometre.
inline constexpr Digits error_digits{1.0, 1e4};
inline Metric share_of_frames(std::string_view share) {
    return {.name = "frame_time_seconds",
            .help = "The time within which this share of the latest pictures was drawn.",
            .scale = 1e-3,
            .label = "share",
            .of = share};
}

void set_fields(auto& fields, auto& set, bool library_hangs) {
    fields.field("number", set.shown, {}, Metric{"set_number", "Number of the installed set that is shown."});
    fields.objects("packs", set.packs, {}, Metric{}, [](auto& item, auto& pack) {
        item.field("file", pack.file);
        item.field("id", pack.id);
        item.field("title", pack.title);
        item.field("serial", pack.serial);
    });
    fields.object("newest", {}, [&](auto& newest) {
        newest.field("number", set.newest.number);
        newest.choice("verdict", set.newest.state, library::trial_state_names);
        newest.field("on_trial", set.on_trial);
        newest.field("starts", set.newest.starts);
        newest.field("reason", set.newest.reason);
    });
    fields.field("of_ended_keys", set.of_ended_keys);
    fields.field("trouble", trouble_of(set, library_hangs));
}

void written_fields(auto& fields, auto& status) {
    fields.field(
        "written_at", status.written.at,
        "when it was written, UTC; older than a few seconds: the exhibit does not run, or its disk is full");
    fields.field("monotonic_ns", status.written.monotonic,
                 "when it was written, nanoseconds of the machine's monotonic clock, which no one sets");
    fields.field("boot_id", status.written.boot_id,
                 "the kernel's name for the time since it was started: `monotonic_ns` counts from there");
    fields.object("versions",
                  "`program`, of the exhibit that runs; `pack_format`, the newest that it reads; `system`, "
                  "the operating system and its kernel",
                  [&](auto& versions) {
                      versions.field("program", status.versions.program, {},
                                     Metric{.name = "build_info",
                                            .help = "1; the label is the exhibit's version.",
                                            .scale = 1.0,
                                            .label = "version"});
                      versions.field("pack_format", status.versions.pack_format);
                      versions.field("system", status.versions.system);
                  });
    fields.word(
        "health", status.health,
        "`well`; `no_picture`: none is presented any more; `frozen`: what is shown is not what was drawn; "
        "`thread_hangs`: a device's thread broke its promise; `hangs`: the exhibit itself was not heard of "
        "for four seconds, and another thread wrote this",
        all_healths, [](service::Health health) { return service::word_of(health); },
        Metric{.name = "health",
               .help = "1 for the word that says how the exhibit is.",
               .scale = 1.0,
               .label = "health"});
}

void shown_fields(auto& fields, auto& status) {
    fields.object(
        "presented",
        "the picture that was handed to the display last: `code`, the number in its corner, which is another "
        "in every picture (`null`: the picture lights the corner); `prop_m`, `prop_wxyz`, the prop's pose "
        "that it was drawn for, and `eye_m`, the eye, in the table's frame; `settled`: nothing in it fades",
        [&](auto& picture) {
            picture.field("code", status.presented.code);
            picture.field("prop_m", status.presented.prop_m);
            picture.field("prop_wxyz", status.presented.prop_wxyz);
            picture.field("eye_m", status.presented.eye_m);
            picture.field("settled", status.presented.settled);
        });
    fields.field("shown_code", status.shown_code,
                 "the code that was read back last of what the display shows; `null`: none");
    fields.field("mode", status.mode,
                 "what is shown at all, as `--mode-file` said at the start: `normal`; `last_good_set`, the "
                 "set before the newest; `plain`, drawn with the least that a graphics driver does; "
                 "`built_in`, the artifact that comes with the program");
    fields.field("settings", status.settings,
                 "why others than those of `--config` are used, and which; empty: they are those. Others are "
                 "used in the mode `built_in` alone");
    fields.objects(
        "left_out", status.left_out,
        "the packs that were asked for and cannot be shown, each as `pack` and `reason`, also those that "
        "turned out bad later; empty while the alignment pattern says on the table that none can",
        Metric{"packs_left_out", "Packs that were asked for and cannot be shown."},
        [](auto& item, auto& pack) {
            item.field("pack", pack.pack);
            item.field("reason", pack.reason);
        });
    fields.object_or_null(
        "set", status.set,
        "the installed set of packs; `null` where none is looked for: no folder `exhibit.library`, "
        "`--packs`. `number`: of the set on show, 0 for the packs of the settings; `packs`: each `file`, "
        "`id`, `title`, `serial`, as they are shown; `newest`: the set that was installed last, with its "
        "`verdict`: `trying`, `good` (shown for 30 s without a fault) or `bad` with the `reason`; "
        "`on_trial`: there is a set to go back to; `starts` of the exhibit without a verdict; "
        "`of_ended_keys`: "
        "the packs that were signed with a key that is no longer trusted, by `id`; `trouble`: "
        "what is wrong with set.txt, the verdict's file, or the disk that both are on",
        Metric{}, [&](auto& inner, auto& set) { set_fields(inner, set, status.library_hangs); });
    fields.word(
        "state", status.state,
        "what the exhibit is doing, one of the states in [states.md](states.md), or `asleep`",
        exhibit::state_notes, [](const exhibit::StateNote& state) { return state.name; },
        Metric{.name = "state",
               .help = "1 for the state that the exhibit is in.",
               .scale = 1.0,
               .label = "state"});
    fields.field("asleep", status.hours.asleep,
                 "by its timetable: the projector is dark, nothing is drawn or said. `health` stays `well`, "
                 "and `frames` go on");
    fields.object("hours",
                  "the timetable: `state`, `open`, `closed`, `always` (there is none) or `clock_wrong` (the "
                  "machine's clock was never set, so the exhibit stays awake); `until`, when that changes, "
                  "in local time, `null` for long; `why`, a sentence on why it is awake or asleep; `clock`, "
                  "when the clock was last set and by how much, empty: never since the start",
                  [&](auto& hours) {
                      hours.field("state", status.hours.state);
                      hours.field("until", status.hours.until);
                      hours.field("why", status.hours.why);
                      hours.field("clock", status.hours.clock);
                  });
    fields.field("artifact", status.artifact, "title of what is shown; empty where nothing can be",
                 Metric{.name = "artifact_info",
                        .help = "1; the label is the title of the artifact that is shown.",
                        .scale = 1.0,
                        .label = "artifact"});
    fields.field("shown_since", status.shown_since,
                 "since when this artifact is shown, UTC, by the wall clock");
    fields.field("shown_for_s", status.shown_for_s,
                 "for how long, by the exhibit's own clock, which no one sets",
                 Metric{"shown_seconds", "How long this artifact has been shown."});
    fields.object("loaded",
                  "`artifacts`, how many can be shown at once; `bytes`, the memory that they take and what "
                  "is on its way, within `exhibit.memory_mb`",
                  [&](auto& loaded) {
                      loaded.field("artifacts", status.loaded, {},
                                   Metric{"artifacts_loaded", "Artifacts that can be shown at once."});
                      loaded.field("bytes", status.loaded_bytes, {},
                                   Metric{"artifacts_bytes", "Memory that they take."});
                  });
}

void drawing_fields(auto& fields, auto& status) {
    fields.field("technique", status.technique,
                 "as asked for: `auto`, `finest`, `level0`, ..., `relief`, `relief96`, ..., `relief-gpu`, "
                 "`relief96-gpu`, ...; `auto` chooses by itself");
    fields.field(
        "level", status.level,
        "what is drawn: `level0`, ..., or a relief: `relief96`, ..., rasterized on the processor, or "
        "`relief96-gpu`, ..., drawn by the GPU; `cells` while a behaviour moves the artifact's cells");
    fields.field("samples", status.samples, "samples a pixel: more make smoother outlines",
                 Metric{"samples_per_pixel", "Samples that are drawn for a pixel."});
    fields.field("language", status.language, "of the caption");
    fields.field(
        "estimated_error_mm", status.estimated_error_mm,
        "how far what the last picture shows lies from what the scan would show, along the eye's rays, on "
        "average: an estimate of that picture ([error_estimate.h](../app/scene/error_estimate.h)). `null` "
        "where it shows nothing of an artifact",
        Metric{.name = "estimated_error_meters",
               .help = "Mean distance of the drawn surface from the scan, on the prop.",
               .scale = 1e-3},
        error_digits);
    fields.field("p95_error_mm", status.p95_error_mm, "the same: 95 of 100 places lie nearer", {},
                 error_digits);
    fields.object(
        "frame_ms",
        "time that a drawn picture took: `p50` half of them, `p95` 95 of 100, `p99` 99 of 100 took no longer",
        [&](auto& times) {
            times.field("p50", status.frame_ms.p50, {}, share_of_frames("0.5"));
            times.field("p95", status.frame_ms.p95, {}, share_of_frames("0.95"));
            times.field("p99", status.frame_ms.p99, {}, share_of_frames("0.99"));
        });
    fields.field("missed_deadlines", status.missed_deadlines,
                 "pictures that took longer than one refresh of the projector",
                 Metric{"frames_slow_total", "Pictures that took longer than a refresh."});
    fields.field("level_switches", status.level_switches, "changes of level or of samples",
                 Metric{"level_switches_total", "Changes of level or of samples."});
    fields.field("ignored_times", status.ignored_times, "frame times that were left out as impossible");
    fields.field("frames", status.frames, "polls of the devices, one for each display time",
                 Metric{"frames_total", "Polls of the devices, one for each display time."});
    fields.field("drawn", status.drawn, "of these: something had changed, a picture was drawn",
                 Metric{"frames_drawn_total", "Display times for which a picture was drawn."});
    fields.field("unchanged", status.unchanged, "of these: nothing had changed, the picture stayed");
    fields.field("probes", status.probes, "of the unchanged: the picture was shown again, for the watchdog");
    fields.field("skipped", status.skipped,
                 "display times that passed without a look, because the machine was late",
                 Metric{"display_times_skipped_total", "Display times that passed without a look."});
    fields.field("device_errors", status.device_errors,
                 "samples that were no pose, and questions to a device that it answered with an error",
                 Metric{"device_errors_total", "Errors that devices answered with."});
}

void all_status_fields(auto& fields, auto& status) {
    written_fields(fields, status);
    shown_fields(fields, status);
    drawing_fields(fields, status);
    device_fields(fields, status);
}

} // namespace frustumscreen::status
