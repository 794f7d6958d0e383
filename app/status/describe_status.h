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
    fields.field("written_at", status.written.at,
                 "time of writing, UTC; if it is older than a few seconds, the exhibit does not run, or its "
                 "disk is full");
    fields.field("monotonic_ns", status.written.monotonic,
                 "time of writing, nanoseconds of the machine's monotonic clock, which cannot be set");
    fields.field("boot_id", status.written.boot_id,
                 "the kernel's id of this boot, from which `monotonic_ns` counts");
    fields.object("versions",
                  "`program`: version of the running exhibit; `pack_format`: newest format that it reads; "
                  "`system`: operating system and kernel",
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
        "`well`; `no_picture`: no picture is presented any more; `frozen`: the display does not show "
        "the latest picture; `thread_hangs`: a device's thread missed its promised time; `hangs`: "
        "the exhibit's loop was silent for four seconds, and another thread wrote this",
        all_healths, [](service::Health health) { return service::word_of(health); },
        Metric{.name = "health",
               .help = "1 for the exhibit's current health.",
               .scale = 1.0,
               .label = "health"});
}

void shown_fields(auto& fields, auto& status) {
    fields.object(
        "presented",
        "the latest picture handed to the display: `code`: the number in its corner, which changes "
        "with each picture (`null`: the picture itself lights the corner); `prop_m`, `prop_wxyz`: "
        "the prop's pose that it was drawn for; `eye_m`: the eye, table frame; `settled`: nothing in "
        "it fades",
        [&](auto& picture) {
            picture.field("code", status.presented.code);
            picture.field("prop_m", status.presented.prop_m);
            picture.field("prop_wxyz", status.presented.prop_wxyz);
            picture.field("eye_m", status.presented.eye_m);
            picture.field("settled", status.presented.settled);
        });
    fields.field("shown_code", status.shown_code,
                 "the code last read back from what the display shows; `null`: none");
    fields.field(
        "mode", status.mode,
        "the mode that `--mode-file` set at the start: `normal`; `last_good_set`: the set before the "
        "newest; `plain`: drawn with the fewest features of the graphics driver; `built_in`: the "
        "built-in artifact");
    fields.field("settings", status.settings,
                 "which settings are used in place of those of `--config`, and why; empty: those of "
                 "`--config` are used. Others are used only in the mode `built_in`");
    fields.objects(
        "left_out", status.left_out,
        "the requested packs that cannot be shown, each with `pack` and `reason`, including packs "
        "that failed later; empty while the table shows the alignment pattern because no pack can be "
        "shown",
        Metric{"packs_left_out", "Packs that were asked for and cannot be shown."},
        [](auto& item, auto& pack) {
            item.field("pack", pack.pack);
            item.field("reason", pack.reason);
        });
    fields.object_or_null(
        "set", status.set,
        "the installed set of packs; `null`: no set is looked for (no folder `exhibit.library`, or "
        "`--packs` is given). `number`: of the set on show, 0 for the packs of the settings; "
        "`packs`: those on show, each with `file`, `id`, `title`, `serial`; `newest`: the set "
        "installed last, with its `verdict`: `trying`, `good` (shown for 30 s without a fault) or "
        "`bad` with the `reason`; `on_trial`: there is a set to return to; `starts`: of the exhibit "
        "without a verdict; `of_ended_keys`: `id`s of packs whose key is no longer trusted; "
        "`trouble`: a fault of set.txt, of the verdict's file, or of their disk",
        Metric{}, [&](auto& inner, auto& set) { set_fields(inner, set, status.library_hangs); });
    fields.word(
        "state", status.state, "the exhibit's state, one of those in [states.md](states.md), or `asleep`",
        exhibit::state_notes, [](const exhibit::StateNote& state) { return state.name; },
        Metric{
            .name = "state", .help = "1 for the exhibit's current state.", .scale = 1.0, .label = "state"});
    fields.field(
        "asleep", status.hours.asleep,
        "true while the timetable keeps the projector dark: nothing is drawn or said. `health` stays "
        "`well`, and `frames` goes on");
    fields.object(
        "hours",
        "the timetable: `state`: `open`, `closed`, `always` (there is none) or `clock_wrong` (the "
        "machine's clock was never set, so the exhibit stays awake); `until`: the next change, local "
        "time, `null` if it is far away; `why`: a sentence on why it is awake or asleep; `clock`: "
        "when the clock was last set and by how much, empty: never since the start",
        [&](auto& hours) {
            hours.field("state", status.hours.state);
            hours.field("until", status.hours.until);
            hours.field("why", status.hours.why);
            hours.field("clock", status.hours.clock);
        });
    fields.field("artifact", status.artifact, "title of the artifact on show; empty if none can be shown",
                 Metric{.name = "artifact_info",
                        .help = "1; the label is the title of the artifact that is shown.",
                        .scale = 1.0,
                        .label = "artifact"});
    fields.field("shown_since", status.shown_since,
                 "when this artifact came on show, UTC, by the wall clock");
    fields.field("shown_for_s", status.shown_for_s, "how long it has been on show, by the monotonic clock",
                 Metric{"shown_seconds", "How long this artifact has been shown."});
    fields.object(
        "loaded",
        "`artifacts`: number that can be shown at once; `bytes`: memory of these and of those being "
        "loaded, within `exhibit.memory_mb`",
        [&](auto& loaded) {
            loaded.field("artifacts", status.loaded, {},
                         Metric{"artifacts_loaded", "Artifacts that can be shown at once."});
            loaded.field("bytes", status.loaded_bytes, {},
                         Metric{"artifacts_bytes", "Memory that they take."});
        });
}

void drawing_fields(auto& fields, auto& status) {
    fields.field("technique", status.technique,
                 "the requested technique: `auto`, `finest`, `level0`, ..., `relief`, `relief96`, ..., "
                 "`relief-gpu`, `relief96-gpu`, ...; with `auto` the governor chooses");
    fields.field("level", status.level,
                 "the level drawn: `level0`, ..., or a relief: `relief96`, ..., rasterized on the processor, "
                 "or `relief96-gpu`, ..., drawn by the GPU; `cells` while a behaviour moves the artifact's "
                 "cells");
    fields.field("samples", status.samples, "samples per pixel; more make smoother outlines",
                 Metric{"samples_per_pixel", "Samples that are drawn for a pixel."});
    fields.field("language", status.language, "language of the caption");
    fields.field("estimated_error_mm", status.estimated_error_mm,
                 "mean distance, along the eye's rays, between the last picture's surface and the scan; an "
                 "estimate ([error_estimate.h](../app/scene/error_estimate.h)). `null`: the picture shows no "
                 "artifact",
                 Metric{.name = "estimated_error_meters",
                        .help = "Mean distance of the drawn surface from the scan, on the prop.",
                        .scale = 1e-3},
                 error_digits);
    fields.field("p95_error_mm", status.p95_error_mm, "as `estimated_error_mm`, the 95th percentile", {},
                 error_digits);
    fields.object("frame_ms",
                  "time of a drawn picture: `p50`: median; `p95`, `p99`: 95th and 99th percentile",
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
    fields.field("ignored_times", status.ignored_times, "frame times discarded as impossible");
    fields.field("frames", status.frames, "polls of the devices, one per display time",
                 Metric{"frames_total", "Polls of the devices, one for each display time."});
    fields.field("drawn", status.drawn, "frames in which something had changed, so a picture was drawn",
                 Metric{"frames_drawn_total", "Display times for which a picture was drawn."});
    fields.field("unchanged", status.unchanged, "frames in which nothing had changed, so the picture stayed");
    fields.field("probes", status.probes, "unchanged pictures that were presented again, for the watchdog");
    fields.field("skipped", status.skipped, "display times missed because the machine was late",
                 Metric{"display_times_skipped_total", "Display times missed because the machine was late."});
    fields.field("device_errors", status.device_errors,
                 "samples without a valid pose, and requests that a device answered with an error",
                 Metric{"device_errors_total", "Errors that devices answered with."});
}

void all_status_fields(auto& fields, auto& status) {
    written_fields(fields, status);
    shown_fields(fields, status);
    drawing_fields(fields, status);
    device_fields(fields, status);
}

} // namespace frustumscreen::status
