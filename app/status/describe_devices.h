/// The fields of the status that tell of devices, described once (describe_status.h), and the fields behind them: the
/// latest stick, visits and memory.
///
/// Threads  pure; any.
#pragma once

#include "app/status/metric.h"
#include "app/status/status_report.h"

namespace frustumscreen::status {

/// Metres in the report, millimetres in the file.
inline constexpr Digits thousandths{1e3, 1e3};
/// Parts of one in the report, of a million in the file.
inline constexpr Digits millionths{1e6, 1e3};

void tracker_fields(auto& fields, auto& counts) {
    fields.field("connections", counts.connections, {},
                 Metric{"tracker_connections_total", "How often a tracker was opened."});
    fields.field("frames", counts.frames, {},
                 Metric{"tracker_samples_total", "Samples of the tracker that were taken."});
    fields.field("lost", counts.lost, {},
                 Metric{"tracker_samples_lost_total", "Samples lost, by their numbers."});
    fields.field("duplicated", counts.duplicated);
    fields.field("reordered", counts.reordered);
    fields.field("strange", counts.implausible);
    fields.field("unusable", counts.unusable);
    fields.field("broken", counts.broken, {},
                 Metric{"tracker_samples_broken_total", "How often bytes were discarded."});
    fields.field("clock_restarts", counts.clock_restarts);
    fields.field("clock_drift_ppm", counts.clock_drift, {},
                 Metric{"tracker_clock_drift_ratio", "How much slower the tracker's clock runs."},
                 millionths);
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

void device_fields(auto& fields, auto& status) {
    fields.object("devices",
                  "`display`, `screen`, `tracker`, `camera`, `panel` and `sound`, each with `ok`: it can be "
                  "used (`null`: the settings have none); `impaired`: it can be used, but needs attention; "
                  "`id`: message id of its sentence below",
                  [&](auto& devices) {
                      condition_fields(devices, "display", status.devices.display);
                      condition_fields(devices, "screen", status.devices.screen);
                      condition_fields(devices, "tracker", status.devices.tracker);
                      condition_fields(devices, "camera", status.devices.camera);
                      condition_fields(devices, "panel", status.devices.panel);
                      condition_fields(devices, "sound", status.devices.sound);
                  });
    fields.field("display", status.display, "state of the projector, one sentence; empty: nothing to report");
    fields.field(
        "screen", status.screen,
        "state of the screen behind the table, one sentence; empty: no screen, or nothing to report");
    fields.object_or_null(
        "screen_picture", status.screen_picture,
        "the screen's pictures: `health`: as above, for this output alone; `code`, `shown_code`: as "
        "for the projector; `presented`: number of pictures; `drawn`: of these, pictures that had "
        "changed; `held_up`: display times at which the screen had not yet shown the previous "
        "picture; `frame_ms`: as above. `null`: the settings have no screen",
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
                 "state of the tracker, or what moves the prop instead; empty: the prop stands");
    fields.field("tracker_hangs", status.tracker_hangs,
                 "the tracker is plugged in but does not work: it is silent, refuses its set-up, cannot be "
                 "opened, or reports a fault. A reset of its USB port may help");
    fields.object("tracker_counts",
                  "since the start: `connections`: how often a tracker was opened; `frames`: samples taken; "
                  "`lost`, `duplicated`, `reordered`: frames, by their numbers; `strange`: numbers far from "
                  "the expected one; `unusable`: invalid poses; `broken`: how often bytes were discarded, "
                  "mostly for a wrong checksum; `clock_restarts`: jumps of the tracker's clock; "
                  "`clock_drift_ppm`: how much slower that clock runs than the machine's",
                  [&](auto& counts) { tracker_fields(counts, status.tracker_counts); });
    fields.field("camera", status.camera,
                 "state of the camera that looks at the table; empty: there is none");
    fields.field("camera_hz", status.camera_hz, "recent frames per second of the camera",
                 status.camera.view().empty()
                     ? Metric{}
                     : Metric{"camera_frames_hertz", "Frames a second that come from the camera."});
    fields.field("camera_for", status.camera_for,
                 "uses of the camera: `the prop's tags` ([tags.md](tags.md)), `the picture's place` "
                 "([calibration.md](calibration.md#drift)), `the visitor's eye` "
                 "([visitor_eye.md](visitor_eye.md)), or several of them; empty: none");
    fields.field("drift", status.drift,
                 "whether the picture is where it was calibrated, by the camera, one sentence; empty: not "
                 "measured (`camera.drift`)");
    fields.field("drift_mm", status.drift_m,
                 "its distance from there, median of the latest measurements; `null`: not measured",
                 Metric{"drift_meters", "Distance of the picture from where it was calibrated."},
                 thousandths);
    fields.field("drifted", status.drifted,
                 "the picture must be calibrated again: more than 2 mm off in five measurements",
                 status.drift.view().empty() ? Metric{}
                                             : Metric{"drifted", "1: the picture must be calibrated again."});
    fields.field("prop_by", status.prop_by,
                 "source of the prop's pose: `tracker` or `tags`; empty: none, the prop stands");
    fields.field("hand_overs", status.source_changes,
                 "how often the source changed between tracker and tags");
    fields.object_or_null(
        "torch", status.torch,
        "the torch that was taken last ([torch.md](torch.md)): `by`: `tracker` (its station 3) or "
        "`tag` (a lamp that a camera sees), empty: none is seen; `state`: `lit`; `past`: it points "
        "past the object; `too_far`: it points at the object from beyond its reach; `dark`: no "
        "artifact is shown that it could light; `laid_down`; `lost`: its pose is unknown; `content`: "
        "name of the content of the torch in the hand, or `white`. `null`: the settings have no torch",
        Metric{}, [](auto& inner, auto& torch) {
            inner.field("by", torch.by);
            inner.field("state", torch.state);
            inner.field("content", torch.content);
        });
    fields.field("panel", status.panel,
                 "state of the buttons, or what presses them instead; empty: there are none");
    fields.field("sound", status.sound, "state of the loudspeaker; empty: no sound is used");
    fields.field("sound_underruns", status.sound_underruns,
                 "underruns: how often the sound card had nothing to play",
                 Metric{"sound_underruns_total", "How often the sound card had nothing to play."});
    fields.field("recording", status.recording,
                 "state of `--record`, or why nothing is recorded; empty: not requested");
    fields.object_or_null(
        "import", status.import,
        "the importer's report on the latest stick since the machine's start: `import_id`: differs "
        "for each stick; `stick`: its label; `stage`: `found`, `copying`, `may_take_out`, `done` or "
        "`failed`; `done_bytes` of `total_bytes`; `refusal`, `reason`: of the stick as a whole; "
        "`set_number`: the set that was installed; `packs`: each with `file`, `title`, `outcome` "
        "(`pending`, `taken`, `already_there`, `refused`, `removed`; for a report on the kiosk "
        "`written`, `not_written`), `refusal` and `reason`. `null`: there was none",
        Metric{}, [](auto& inner, auto& report) { import_fields(inner, report); });
    fields.object_or_null(
        "visits", status.visits,
        "counts of visits ([counts.md](counts.md)): `today`, `since_start`: visits begun; `today_s`, "
        "`since_start_s`: their total duration; `trouble`: why the numbers cannot be stored. `null`: "
        "visits are not counted",
        Metric{}, [](auto& inner, auto& visits) {
            inner.field("today", visits.today);
            inner.field("since_start", visits.since_start, {},
                        Metric{"visits_total", "Visits since the exhibit was started."});
            inner.field("today_s", visits.today_s);
            inner.field("since_start_s", visits.since_start_s, {},
                        Metric{"visits_seconds_total", "Time of these visits, in all."});
            inner.field("trouble", visits.trouble);
        });
    fields.field("prop_known", status.prop_known, "the prop's pose is known now",
                 Metric{"prop_known", "1: the prop's place is known."});
    fields.field("head_known", status.head_known,
                 "a sensor on the visitor's head gives its pose now; otherwise see `eye_by`",
                 Metric{"head_known", "1: the visitor's head is known."});
    fields.field("eye_by", status.eye_by,
                 "source of the visitor's eye: `sensor` on the head, `camera`, or `settings`: "
                 "none, it is `eye.default_m`");
    fields.field("eye_sd_mm", status.eye_sd_m,
                 "standard deviation of an eye measured by the camera, across its line to the prop, RMS of "
                 "both axes; `null`: another source",
                 {}, thousandths);
    fields.field("uptime_s", status.uptime_s, "seconds since everything was loaded",
                 Metric{"uptime_seconds", "Time since everything was loaded."});
    fields.field("resident_mib", status.resident_mib, "memory that the program takes, MiB",
                 Metric{.name = "resident_memory_bytes",
                        .help = "Memory that the exhibit takes.",
                        .scale = 1024.0 * 1024.0});
}

} // namespace frustumscreen::status
