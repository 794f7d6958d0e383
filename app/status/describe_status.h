/// Every field of the exhibit's status, described once: its key, its sentence in docs/status.md, and its Prometheus
/// metric if it has one. The writer and the reader of the status file (status_fields.h), the page's table
/// (status_report.cpp) and the metrics for Prometheus walk this description, in this order. A reader has filled in
/// the earlier lines when it comes to a line.
///
/// Threads  pure; any.
#pragma once

#include "app/exhibit/states.h"
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
/// Metres in the report, millimetres in the file.
inline constexpr Digits thousandths{1e3, 1e3};
/// Parts of one in the report, of a million in the file.
inline constexpr Digits millionths{1e6, 1e3};

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

/// The same fields as in the importer's own file.
void import_fields(auto& fields, auto& report) {
    fields.field("import_id", report.import_id);
    fields.field("stick", report.stick);
    fields.choice("stage", report.stage, library::import_stage_names);
    fields.field("done_bytes", report.done_bytes);
    fields.field("total_bytes", report.total_bytes);
    fields.choice("refusal", report.refusal, library::import_refusal_names);
    fields.field("reason", report.reason);
    fields.field("set_number", report.set_number);
    fields.objects("packs", report.packs, {}, Metric{}, [](auto& item, auto& pack) {
        item.field("file", pack.file);
        item.field("title", pack.title);
        item.choice("outcome", pack.outcome, library::import_outcome_names);
        item.choice("refusal", pack.refusal, library::import_refusal_names);
        item.field("reason", pack.reason);
    });
}

void tracker_fields(auto& fields, auto& counts) {
    fields.field("connections", counts.connections, {},
                 Metric{"tracker_connections_total", "How often a tracker was opened."});
    fields.field("frames", counts.frames, {},
                 Metric{"tracker_samples_total", "Samples of the tracker that were taken."});
    fields.field("lost", counts.lost, {},
                 Metric{"tracker_samples_lost_total", "Samples that never came, by their numbers."});
    fields.field("duplicated", counts.duplicated);
    fields.field("reordered", counts.reordered);
    fields.field("strange", counts.strange);
    fields.field("unusable", counts.unusable);
    fields.field("broken", counts.broken, {},
                 Metric{"tracker_samples_broken_total", "How often bytes were thrown away."});
    fields.field("clock_restarts", counts.clock_restarts);
    fields.field("clock_drift_ppm", counts.clock_drift, {},
                 Metric{"tracker_clock_drift_ratio", "How much slower the tracker's clock runs."},
                 millionths);
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

/// `device`: the key, a literal.
void condition_fields(auto& fields, const char* device, auto& report) {
    fields.object(device, {}, [&](auto& inner) {
        inner.field("ok", report.ok, {},
                    Metric{.name = "device_ok",
                           .help = "1: this device, which the settings ask for, can be used.",
                           .scale = 1.0,
                           .label = "device",
                           .of = device});
        inner.field("impaired", report.impaired);
        inner.field("id", report.id);
    });
}

void device_fields(auto& fields, auto& status) {
    fields.object(
        "devices",
        "`display`, `screen`, `tracker`, `camera`, `panel` and `sound`, of each `ok`, whether it can be used "
        "(`null`: "
        "the "
        "settings ask for none); `impaired`, it can, and something about it is to be put right; `id`, the "
        "short name of the sentence that it says below",
        [&](auto& devices) {
            condition_fields(devices, "display", status.devices.display);
            condition_fields(devices, "screen", status.devices.screen);
            condition_fields(devices, "tracker", status.devices.tracker);
            condition_fields(devices, "camera", status.devices.camera);
            condition_fields(devices, "panel", status.devices.panel);
            condition_fields(devices, "sound", status.devices.sound);
        });
    fields.field("display", status.display,
                 "how the projector is, in one sentence; empty: there is nothing to say");
    fields.field(
        "screen", status.screen,
        "how the screen behind the table is, in one sentence; empty: there is none, or nothing to say");
    fields.object_or_null(
        "screen_picture", status.screen_picture,
        "what the screen shows: `health`, as above, of this output alone; `code` and `shown_code`, as of the "
        "projector's picture; pictures `presented`, and of these `drawn` anew; `held_up`, display times at "
        "which it had "
        "not shown the picture before; `frame_ms`, as above. `null`: the settings have no screen",
        Metric{}, [](auto& inner, auto& picture) {
            inner.field("health", picture.health);
            inner.field("code", picture.code);
            inner.field("shown_code", picture.shown_code);
            inner.field(
                "presented", picture.presented, {},
                Metric{"screen_pictures_total", "Pictures presented to the screen behind the table."});
            inner.field("drawn", picture.drawn);
            inner.field("held_up", picture.held_up, {},
                        Metric{"screen_held_up_total", "Display times at which the screen was not ready."});
            inner.object("frame_ms", {}, [&](auto& times) {
                times.field("p50", picture.frame_ms.p50);
                times.field("p95", picture.frame_ms.p95);
                times.field("p99", picture.frame_ms.p99);
            });
        });
    fields.field("tracker", status.tracker,
                 "how the tracker is, or what moves the prop in its place; empty: the prop stands");
    fields.field("tracker_hangs", status.tracker_hangs,
                 "the tracker is plugged in and does not do what it should: it is silent, refuses its "
                 "set-up, cannot be opened, or reports a fault of its own. A reset of its port may help");
    fields.object("tracker_counts",
                  "since the start: `connections`, how often a tracker was opened; `frames` taken; `lost`, "
                  "`duplicated`, `reordered` frames, by their numbers; `strange`, numbers far from what was "
                  "due; `unusable` poses; `broken`, how often bytes were thrown away, mostly for a wrong "
                  "checksum; `clock_restarts`, jumps of the tracker's clock; and `clock_drift_ppm`, how much "
                  "slower it runs than ours",
                  [&](auto& counts) { tracker_fields(counts, status.tracker_counts); });
    fields.field("camera", status.camera, "how the camera is that looks at the table; empty: none does");
    fields.field("camera_hz", status.camera_hz, "frames a second that came from it of late",
                 status.camera.view().empty()
                     ? Metric{}
                     : Metric{"camera_frames_hertz", "Frames a second that come from the camera."});
    fields.field("camera_for", status.camera_for,
                 "what it is used for: `the prop's tags` ([tags.md](tags.md)), `the picture's place` "
                 "([calibration.md](calibration.md#drift)), `the visitor's eye` "
                 "([visitor_eye.md](visitor_eye.md)), or several of them; empty: nothing");
    fields.field("drift", status.drift,
                 "whether the picture lies where it was calibrated, as the camera sees it, in one sentence; "
                 "empty: nothing looks (`camera.drift`)");
    fields.field("drift_mm", status.drift_m,
                 "how far it lies beside that: median of the latest looks; `null`: nothing looks",
                 Metric{"drift_meters", "How far the picture lies beside where it was calibrated."},
                 thousandths);
    fields.field("drifted", status.drifted, "it is to be put right: by more than 2 mm, over five looks",
                 status.drift.view().empty() ? Metric{}
                                             : Metric{"drifted", "1: the picture is to be put right."});
    fields.field("prop_by", status.prop_by,
                 "whose pose of the prop is shown: `tracker` or `tags`; empty: the prop stands");
    fields.field("hand_overs", status.hand_overs,
                 "how often the tags took over from the tracker, or it from them");
    fields.object_or_null("torch", status.torch,
                          "the torch that was taken last ([torch.md](torch.md)): `by`, `tracker` (its "
                          "station 3) or `tag` (a lamp that a camera "
                          "sees), empty: neither is seen; `state`: `lit`; `past`, it points past the object; "
                          "`too_far`, it points at it from "
                          "beyond its reach; `dark`, nothing is shown that it could light; `laid_down`; "
                          "`lost`, its place is not known; `content`, "
                          "what the one in the hand throws, by its name in the pack, or `white`. `null`: the "
                          "settings have no torch",
                          Metric{}, [](auto& inner, auto& torch) {
                              inner.field("by", torch.by);
                              inner.field("state", torch.state);
                              inner.field("content", torch.content);
                          });
    fields.field("panel", status.panel,
                 "how the buttons are, or what presses in their place; empty: there are none");
    fields.field("sound", status.sound, "how the loudspeaker is; empty: there is nothing to say aloud");
    fields.field("sound_underruns", status.sound_underruns, "how often the sound card had nothing to play",
                 Metric{"sound_underruns_total", "How often the sound card had nothing to play."});
    fields.field("recording", status.recording,
                 "how `--record` fares, or why nothing is recorded; empty: nothing was asked for");
    fields.object_or_null(
        "import", status.import,
        "what was done with the latest stick since the machine was started, as the importer's "
        "report has it: `import_id`, another one for each stick; `stick`, its label; `stage`, one "
        "of `found`, `copying`, `may_take_out`, `done`, `failed`; `done_bytes` of `total_bytes`; "
        "`refusal` and `reason` of the stick as a whole; `set_number`, the set that is installed; "
        "`packs`, each with `file`, `title`, `outcome` (`pending`, `taken`, `already_there`, "
        "`refused`, `removed`; of a report on the kiosk `written`, `not_written`), `refusal` and `reason`. "
        "`null`: there was none",
        Metric{}, [](auto& inner, auto& report) { import_fields(inner, report); });
    fields.object_or_null("visits", status.visits,
                          "of visitors, numbers alone ([counts.md](counts.md)): visits that began `today` "
                          "and `since_start`, and how long they "
                          "lasted, `today_s`, `since_start_s`; `trouble`, why the numbers cannot be kept. "
                          "`null`: they are not counted",
                          Metric{}, [](auto& inner, auto& visits) {
                              inner.field("today", visits.today);
                              inner.field("since_start", visits.since_start, {},
                                          Metric{"visits_total", "Visits since the exhibit was started."});
                              inner.field("today_s", visits.today_s);
                              inner.field("since_start_s", visits.since_start_s, {},
                                          Metric{"visits_seconds_total", "How long they lasted together."});
                              inner.field("trouble", visits.trouble);
                          });
    fields.field("prop_known", status.prop_known, "the prop's place is known now",
                 Metric{"prop_known", "1: the prop's place is known."});
    fields.field("head_known", status.head_known,
                 "a sensor on the visitor's head says where it is now; else see `eye_by`",
                 Metric{"head_known", "1: the visitor's head is known."});
    fields.field("eye_by", status.eye_by,
                 "source of the visitor's eye: `sensor` on the head, `camera`, or `settings`: "
                 "none, it is `eye.default_m`");
    fields.field("eye_sd_mm", status.eye_sd_m,
                 "how far an eye by the camera may be off across its line to the prop, RMS on each axis; "
                 "`null`: it is by another",
                 {}, thousandths);
    fields.field("uptime_s", status.uptime_s, "seconds since everything was loaded",
                 Metric{"uptime_seconds", "Time since everything was loaded."});
    fields.field("resident_mib", status.resident_mib, "memory that the program takes, MiB",
                 Metric{.name = "resident_memory_bytes",
                        .help = "Memory that the exhibit takes.",
                        .scale = 1024.0 * 1024.0});
}

void all_status_fields(auto& fields, auto& status) {
    written_fields(fields, status);
    shown_fields(fields, status);
    drawing_fields(fields, status);
    device_fields(fields, status);
}

} // namespace frustumscreen::status
