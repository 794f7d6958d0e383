// The description of the status: written fields are read back, and docs/status.md has them.
#include "app/status/describe_status.h"
#include "app/status/prometheus_text.h"
#include "app/status/status_fields.h"
#include "app/status/status_lines.h"
#include "app/status/status_report.h"
#include "app/status/watchdog_status.h"
#include "firmware_host/base/file.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

namespace frustumscreen::status {
namespace {

using std::chrono::seconds;

/// A report in which no field has its default.
StatusReport full_report() {
    StatusReport report;
    report.written = {std::chrono::system_clock::from_time_t(1777651200), MonotonicTime(seconds(999)),
                      Sentence("boot")};
    report.versions = {"1.2.3", 7, "Debian"};
    report.health = "frozen";
    report.presented = {std::uint8_t{7}, {0.1, 0.2, 0.3}, {0.5, -0.5, 0.5, 0.5}, {0.3, -0.5, 0.25}, true};
    report.shown_code = std::uint8_t{6};
    report.mode = "plain";
    report.settings = Sentence("others are used");
    report.left_out =
        std::make_shared<const std::vector<library::UnshownPack>>(std::vector<library::UnshownPack>{
            {"cat.fspack", "there is no such file"}, {"dog.fspack", "it is damaged"}});
    const auto set = std::make_shared<SetStatus>();
    set->shown = 7;
    set->packs = {{"a", "b", "A cat", 3, {}, 0, {}}};
    set->newest = {8, library::TrialState::Bad, 2, "dog.fspack: it is damaged"};
    set->on_trial = true;
    set->of_ended_keys = "vase, cup";
    set->trouble = "set.txt cannot be read";
    report.set = set;
    report.state = "view";
    report.hours = {"open", std::chrono::sys_seconds(seconds(1777655555)), Sentence("awake"),
                    Sentence("it was set"), true};
    report.artifact = "Amphora \"of\" Exekias \u00e4";
    report.shown_since = std::chrono::system_clock::from_time_t(1777640000);
    report.shown_for_s = 7200.5;
    report.loaded = 2;
    report.loaded_bytes = 1048576;
    report.technique = "auto";
    report.level = "level1";
    report.samples = 4;
    report.language = "en";
    report.estimated_error_mm = 0.2501;
    report.p95_error_mm = 0.5;
    report.frame_ms = {8.5, 12.0, 17.25};
    report.missed_deadlines = 3;
    report.level_switches = 5;
    report.ignored_times = 1;
    report.frames = 100000;
    report.drawn = 4000;
    report.unchanged = 96000;
    report.probes = 12;
    report.skipped = 6;
    report.device_errors = 9;
    for (DeviceReport* const device :
         {&report.devices.display, &report.devices.screen, &report.devices.tracker, &report.devices.camera,
          &report.devices.panel, &report.devices.sound}) {
        *device = DeviceReport({DeviceHealth::Impaired, "device.impaired"});
    }
    report.torch = TorchReport{"tag", "past", "x-ray"};
    report.visits = VisitsReport{34, 40, 7080.5, 8000.25, "the disk is full"};
    report.display = Sentence("lights HDMI-A-1");
    report.screen = Sentence("lights DP-1");
    report.screen_picture = ScreenReport{.health = "frozen",
                                         .code = std::uint8_t{7},
                                         .shown_code = std::uint8_t{6},
                                         .presented = 7000,
                                         .drawn = 600,
                                         .held_up = 5,
                                         .frame_ms = {4.5, 6.0, 9.25}};
    report.tracker = Sentence("a VIPER sends");
    report.tracker_hangs = true;
    report.tracker_counts = {2, 5000, 11, 1, 2, 3, 4, 5, 6, 25e-6};
    report.camera = Sentence("it sees");
    report.camera_hz = 29.97;
    report.camera_for = "the prop's tags";
    report.drift = Sentence("the picture has moved");
    report.drift_m = 0.003125;
    report.drifted = true;
    report.prop_by = "tags";
    report.source_changes = 5;
    report.panel = Sentence("its buttons are there");
    report.sound = Sentence("its sound goes to default");
    report.sound_underruns = 2;
    report.recording = Sentence("it is recorded");
    library::ImportReport import;
    import.import_id = "id";
    import.stick = "A stick";
    import.stage = library::ImportStage::Failed;
    import.reason = "it is full";
    import.packs = {
        { "a",
          "A",
          library::ImportOutcome::Refused,
          library::ImportRefusal::Older,
          "an older one" }};
    report.import = std::make_shared<const library::ImportReport>(import);
    report.prop_known = true;
    report.head_known = true;
    report.eye_by = "camera";
    report.eye_sd_m = 0.021;
    report.uptime_s = 36000.0;
    report.resident_mib = 181.5;
    return report;
}

nlohmann::ordered_json parsed(const StatusReport& report) {
    return nlohmann::ordered_json::parse(status_json(report));
}

/// Collects every value that is not an object or a list, by the keys that lead to it.
void collect(const nlohmann::ordered_json& json, const std::string& place,
             std::map<std::string, nlohmann::ordered_json>& values) {
    if (!json.is_structured()) {
        values[place] = json;
    }
    for (const auto& [key, value] : json.items()) {
        if (json.is_structured()) {
            collect(value, place + "/" + key, values);
        }
    }
}

TEST(StatusReport, RoundTrip) {
    const StatusReport report = full_report();
    const std::string json = status_json(report);
    const StatusReport read = read_status_report(nlohmann::json::parse(json));
    EXPECT_EQ(status_json(read), json);
    EXPECT_EQ(read.written.at, report.written.at);
    EXPECT_EQ(read.hours.until, report.hours.until);
    ASSERT_NE(read.set, nullptr);
    EXPECT_EQ(read.set->newest, report.set->newest);
    EXPECT_EQ(read.set->of_ended_keys, "vase, cup");
    ASSERT_NE(read.import, nullptr);
    EXPECT_EQ(*read.import, *report.import);
    EXPECT_DOUBLE_EQ(read.drift_m.value_or(0.0), 0.003125);
    EXPECT_DOUBLE_EQ(read.tracker_counts.clock_drift, 25e-6);
    const StatusReport usual = read_status_report(nlohmann::json::parse(status_json({})));
    EXPECT_EQ(status_json(usual), status_json({}));
}

TEST(StatusReport, ContainsTheImportReportUnchanged) {
    const StatusReport report = full_report();
    EXPECT_EQ(parsed(report).at("import").dump(),
              nlohmann::ordered_json::parse(library::write_import_report(*report.import)).dump());
}

/// Each key of the file has a member of the report, which full_report sets.
TEST(StatusReport, WritesEachKeyFromAMember) {
    std::map<std::string, nlohmann::ordered_json> usual;
    std::map<std::string, nlohmann::ordered_json> full;
    collect(parsed({}), "", usual);
    collect(parsed(full_report()), "", full);
    std::size_t compared = 0;
    for (const auto& [place, value] : usual) {
        const auto other = full.find(place);
        if (place.find("import/") == std::string::npos && other != full.end()) {
            ++compared;
            EXPECT_NE(other->second, value) << place << " has its default, or its member is not described";
        }
    }
    EXPECT_GT(compared, 60U);
}

TEST(StatusReport, LeavesUnusedDevicesWithoutHealth) {
    EXPECT_FALSE(DeviceReport(DeviceCondition{}).ok);
    EXPECT_EQ(DeviceReport({DeviceHealth::Well, "panel.well"}).ok, true);
    EXPECT_EQ(DeviceReport({DeviceHealth::Impaired, "panel.stuck"}).ok, true);
    EXPECT_EQ(DeviceReport({DeviceHealth::Away, "panel.lost"}).ok, false);
    EXPECT_EQ(DeviceReport({DeviceHealth::Away, "panel.lost"}).id, "panel.lost");
}

TEST(StatusReport, IgnoresMissingKeysAndKeysOfTheWrongType) {
    const nlohmann::json whole = nlohmann::json::parse(status_json(full_report()));
    for (const auto& [key, value] : whole.items()) {
        nlohmann::json less = whole;
        less.erase(key);
        less["of a later version"] = {{"a", 1}};
        nlohmann::json other = whole; // another type counts as missing
        other[key] = value.is_number() ? nlohmann::json("no number") : nlohmann::json(5);
        const nlohmann::json read = nlohmann::json::parse(status_json(read_status_report(less)));
        EXPECT_EQ(nlohmann::json::parse(status_json(read_status_report(other))), read) << key;
        EXPECT_NE(read.at(key), value) << key;
        for (const auto& [each, kept] : whole.items()) {
            EXPECT_TRUE(each == key || read.at(each) == kept) << each << " without " << key;
        }
    }
    EXPECT_FALSE(read_status_report(nullptr).uptime_s);
    EXPECT_FALSE(read_status_report({1, 2}).frame_ms.p50);
}

TEST(StatusReport, ClampsNumbersToTheirTypes) {
    const auto samples_of = [](const char* number) {
        return read_status_report(nlohmann::json::parse(std::string(R"({"samples": )") + number + "}"))
            .samples;
    };
    EXPECT_EQ(samples_of("4"), 4);
    EXPECT_EQ(samples_of("4.0"), 4);
    EXPECT_EQ(samples_of("1e300"), std::numeric_limits<int>::max());
    EXPECT_EQ(samples_of("18446744073709551615"), std::numeric_limits<int>::max());
    EXPECT_EQ(samples_of("-1e300"), std::numeric_limits<int>::min());
    EXPECT_EQ(read_status_report({{"frames", -3}}).frames, 0U);
    EXPECT_EQ(read_status_report({{"frames", ~std::uint64_t{0}}}).frames, ~std::uint64_t{0});
    EXPECT_FALSE(read_status_report({{"monotonic_ns", 1e300}}).written.monotonic);
}

TEST(StatusReport, CleansTextsToOnePrintableLine) {
    const StatusReport read =
        read_status_report({{"artifact", "a\nb\x1b[2J"}, {"language", std::string(1000, 'x')}});
    EXPECT_EQ(read.artifact, "a?b?[2J");
    EXPECT_LE(read.language.size(), 303U);
    StatusReport own;
    own.artifact = "a\nb";
    own.state = "view";
    EXPECT_EQ(status_lines(&own, 0.0, nullptr, 0).front().text.find('\n'), std::string::npos);
    own.artifact = "\xFF\xFE";
    EXPECT_TRUE(nlohmann::json::accept(status_json(own)));
}

/// The exhibit's own lines are those that `frustumscreen status` makes from its file.
TEST(StatusReport, GivesTheSameLinesAfterARoundTrip) {
    const StatusReport report = full_report();
    const StatusReport read = read_status_report(nlohmann::json::parse(status_json(report)));
    const std::vector<StatusLine> own = status_lines(&report, 0.0, nullptr, 1777651200);
    const std::vector<StatusLine> of_file = status_lines(&read, 0.0, nullptr, 1777651200);
    ASSERT_EQ(own.size(), of_file.size());
    EXPECT_GT(own.size(), 15U);
    for (std::size_t k = 0; k < own.size(); ++k) {
        EXPECT_EQ(own[k].name, of_file[k].name);
        EXPECT_EQ(own[k].text, of_file[k].text);
    }
}

TEST(StatusPage, ContainsTheTableOfFields) {
    const Result<Bytes> page = read_file(source_dir() + "/docs/status.md");
    ASSERT_TRUE(page) << page.error().message;
    EXPECT_TRUE(as_text(*page).ends_with("\n|---|---|\n" + status_field_table()))
        << "the page ends with this table's rows:\n"
        << status_field_table();
}

/// The row of a field describes its inner fields.
TEST(StatusPage, NamesTheInnerFieldsOfEachField) {
    const std::string table = "\n" + status_field_table();
    std::size_t inside = 0;
    const nlohmann::ordered_json json = parsed(full_report());
    for (const auto& [key, value] : json.items()) {
        const std::size_t row = table.find("\n| `" + key + "` | ");
        ASSERT_NE(row, std::string::npos) << key;
        const std::string said = table.substr(row + 1, table.find('\n', row + 1) - row);
        if (!value.is_object()) {
            continue;
        }
        for (const auto& [inner, each] : value.items()) {
            ++inside;
            EXPECT_NE(said.find("`" + inner + "`"), std::string::npos) << key << "." << inner;
        }
    }
    EXPECT_GT(inside, 35U);
}

TEST(Prometheus, LeavesOutMissingKeys) {
    const StatusClock clock{MonotonicTime(seconds(1000)), "boot"};
    const auto text_of = [&](const nlohmann::json& json) {
        return prometheus_text({parse_status(json.dump(), clock), {}});
    };
    const nlohmann::json whole = nlohmann::json::parse(status_json(full_report()));
    const auto has = [](const std::string& text, const char* sample) {
        return text.find("\nfrustumscreen_" + std::string(sample) + "\n") != std::string::npos;
    };
    const std::string all = text_of(whole);
    EXPECT_TRUE(has(all, "frames_total 100000")) << all;
    EXPECT_TRUE(has(all, "drift_meters 0.003125"));
    EXPECT_TRUE(has(all, "frame_time_seconds{share=\"0.99\"} 0.01725"));
    EXPECT_TRUE(has(all, "camera_frames_hertz 29.97"));
    EXPECT_TRUE(has(all, "set_number 7"));
    EXPECT_TRUE(has(all, "packs_left_out 2"));
    nlohmann::json less = whole;
    for (const char* key : {"frames", "drift_mm", "frame_ms", "set", "left_out"}) {
        less.erase(key);
    }
    less["camera"] = "";
    const std::string some = text_of(less);
    for (const char* name :
         {"frames_total", "drift_meters", "frame_time_seconds", "camera_frames_hertz", "set_number"}) {
        EXPECT_EQ(some.find("frustumscreen_" + std::string(name)), std::string::npos) << name;
    }
    EXPECT_TRUE(has(some, "packs_left_out 0"));
}

TEST(Prometheus, WritesEachFamilyOnce) {
    const std::string text = prometheus_text(
        {parse_status(status_json(full_report()), {MonotonicTime(seconds(1000)), "boot"}), {}});
    std::set<std::string> families;
    for (std::size_t at = text.find("# HELP "); at != std::string::npos; at = text.find("# HELP ", at + 1)) {
        EXPECT_TRUE(families.insert(text.substr(at, text.find(' ', at + 7) - at)).second);
    }
    EXPECT_GT(families.size(), 35U);
}

TEST(WatchdogStatus, IgnoresMissingAndMalformedKeys) {
    const WatchdogStatus nothing = read_watchdog_status(nullptr);
    EXPECT_TRUE(nothing.mode.empty() && !nothing.trouble && !nothing.step && nothing.faults.empty());
    const WatchdogStatus status = read_watchdog_status(
        {{"mode", "plain"},
         {"trouble", {{"sentence", "it is hot"}, {"since_s", 90}}},
         {"step", {{"name", "reboot"}}},
         {"notes", {"the disk is full", 3}},
         {"faults", {{{"at", "now"}, {"awake_s", 5}, {"helped", false}}, {{"helped", nullptr}}}}});
    EXPECT_EQ(status.mode, "plain");
    ASSERT_TRUE(status.trouble && status.step);
    EXPECT_EQ(status.trouble->sentence, "it is hot");
    EXPECT_EQ(status.trouble->since_s, 90.0);
    EXPECT_EQ(*status.step, "reboot");
    EXPECT_EQ(status.notes, std::vector<std::string>{"the disk is full"});
    ASSERT_EQ(status.faults.size(), 2U);
    EXPECT_EQ(status.faults[0].helped, false);
    EXPECT_FALSE(status.faults[1].helped);
}

} // namespace
} // namespace frustumscreen::status
